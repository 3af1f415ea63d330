"""`campaign --print-completion`: what a shell needs to complete the command line."""

import argparse
from typing import Any

SHELLS = ("bash", "zsh")

HELP = 'completion for a shell; for bash: eval "$(campaign --print-completion bash)"'


class PrintCompletion(argparse.Action):
    """Prints the completion script of a shell."""

    def __call__(self, parser: argparse.ArgumentParser, _options: object, shell: Any, *_: object) -> None:
        """Print it and end."""
        import shtab

        print(shtab.complete(parser, shell))
        parser.exit()
