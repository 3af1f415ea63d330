"""The door: `campaign` and its commands, a file each in `campaign.commands`."""

import argparse
import os
import sys
from collections.abc import Sequence
from importlib import import_module

from campaign.commands.completion import HELP, SHELLS, PrintCompletion
from campaign.commands.version import PrintVersion
from campaign.errors import CampaignError
from campaign.exit_codes import ExitCode
from campaign.running.launcher import refuse_several
from campaign.terminal import complain, let_go, show_all

THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")

DEFAULT = ["run", "ma2023"]
"""What is done without arguments."""

SHARED = ("run", "tradeoff", "screen")
"""The commands that several processes carry out together."""

DESCRIPTION = """\
How far will this slope run, and how sure are we? Without a command, "campaign" computes the built-in scene ma2023
("campaign run ma2023"), which takes minutes."""

COMMANDS = ("run", "new", "validate", "draw", "status", "report", "replay", "compare", "tradeoff", "screen", "scenes")
"""Modules of `campaign.commands`, in the order of the help."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Carry out one command and return its exit code; without arguments that is `run ma2023`."""
    _pin_threads()
    show_all()
    os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")  # files appear whole; not every file system has locks
    given = sys.argv[1:] if arguments is None else list(arguments)
    try:
        return _carry_out(parser().parse_args(given or DEFAULT))
    except BrokenPipeError:  # whoever watched has seen enough
        return ExitCode.DONE
    except KeyboardInterrupt:  # as long as a campaign does not listen to it, which then ends in order
        complain("Interrupted.")
        return ExitCode.INTERRUPTED
    finally:
        let_go()


def _carry_out(options: argparse.Namespace) -> ExitCode:
    try:
        if options.command not in SHARED:
            refuse_several(options.command, os.environ)
        code: ExitCode = options.carry_out(options)
    except CampaignError as refusal:
        if str(refusal):
            complain(refusal)
        return ExitCode.REFUSED
    return code


def _pin_threads() -> None:
    """Give each rank one thread, before NumPy is imported.

    One realization is one core, and the results of BLAS depend on its threads: a user's own setting must not win.
    """
    for name in THREADS:
        os.environ[name] = "1"


def parser() -> argparse.ArgumentParser:
    """Return what understands the command line."""
    top = argparse.ArgumentParser(prog="campaign", description=DESCRIPTION)
    top.add_argument("--version", action=PrintVersion, nargs=0, help="versions of all that takes part in a result")
    top.add_argument("--print-completion", action=PrintCompletion, choices=SHELLS, help=HELP)
    commands = top.add_subparsers(required=True, metavar="COMMAND")
    for name in COMMANDS:
        module = import_module(f"campaign.commands.{name}")
        command = commands.add_parser(name, help=module.HELP)
        module.add_arguments(command)
        command.set_defaults(carry_out=module.carry_out, command=name)
    return top
