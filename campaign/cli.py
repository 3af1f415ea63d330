"""The door: `campaign` and its commands.

Everything heavy is imported by the command that needs it, so that a typing error is answered at once and `status` works
where MPI cannot be started.
"""

import argparse
import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from campaign.errors import CampaignError
from campaign.exit_codes import ExitCode

if TYPE_CHECKING:
    from campaign.scene import Scene

THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")

DEFAULT_SCENE = "ma2023"


def main(arguments: Sequence[str] | None = None) -> int:
    """Carry out one command and return its exit code; without arguments that is `run ma2023`."""
    _pin_threads()
    given = sys.argv[1:] if arguments is None else list(arguments)
    options = _parser().parse_args(given or ["run", DEFAULT_SCENE])
    try:
        code: ExitCode = options.command(options)
    except CampaignError as refusal:
        print(refusal, file=sys.stderr)
        return ExitCode.REFUSED
    return code


def _pin_threads() -> None:
    """Give each rank one thread, before NumPy is imported.

    One realization is one core, and the results of BLAS depend on its threads: a user's own setting must not win.
    """
    for name in THREADS:
        os.environ[name] = "1"


def _run(options: argparse.Namespace) -> ExitCode:
    from campaign.running.mpi import run_on_ranks
    from campaign.scene import load_scene
    from campaign.simulation.ground import prepare

    def read_scene() -> "Scene":
        return load_scene(options.scene, _overrides(options))

    return run_on_ranks(read_scene, options.out, prepare, _write_report, options.allow_drift)


def _write_report(directory: Path) -> Path:
    from campaign.report.page import write_report

    return write_report(directory)


def _validate(options: argparse.Namespace) -> ExitCode:
    from campaign.scene.cost import cost

    scene = _scene(options)
    print(f"{scene.title}: a valid scene; {cost(scene)}.")
    return ExitCode.DONE


def _status(options: argparse.Namespace) -> ExitCode:
    from campaign.commands.status import status, watch

    if options.watch:
        watch(options.directory)
    else:
        print(status(options.directory))
    return ExitCode.DONE


def _report(options: argparse.Namespace) -> ExitCode:
    from campaign.report.page import write_report

    print(write_report(options.directory))
    return ExitCode.DONE


def _replay(options: argparse.Namespace) -> ExitCode:
    from campaign.commands.replay import replay
    from campaign.storage import manifest

    manifest.read(options.directory)
    print(replay(options.directory, options.realization))
    return ExitCode.DONE


def _tradeoff(options: argparse.Namespace) -> ExitCode:
    from campaign.tradeoff.table import write_tradeoff

    scene = _scene(options)
    out = options.out or Path(f"tradeoff-{scene.name}")
    write_tradeoff(scene, 60 * options.budget, out)
    return ExitCode.DONE


def _scenes(_options: argparse.Namespace) -> ExitCode:
    from campaign.scene import builtin_scenes

    for name, title in builtin_scenes().items():
        print(f"{name:20}{title}")
    return ExitCode.DONE


def _scene(options: argparse.Namespace) -> "Scene":
    from campaign.scene import load_scene

    return load_scene(options.scene, _overrides(options))


def _overrides(options: argparse.Namespace) -> list[str]:
    """Return the overrides in the order of their precedence."""
    named = {"campaign.realizations": options.realizations, "campaign.seed": options.seed}
    return [*options.set, *(f"{key}={value}" for key, value in named.items() if value is not None)]


class _Version(argparse.Action):
    """Prints the versions, which takes half a second to find out, only where they are asked for."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        from campaign.commands.version import version

        print(version())
        parser.exit()


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="campaign", description="How far will this slope run, and how sure are we?")
    parser.add_argument("--version", action=_Version, nargs=0, help="versions of all that takes part in a result")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    run = commands.add_parser("run", help="run a campaign, or continue it")
    _add_scene(run)
    run.add_argument("--out", metavar="DIR", type=Path, help="results directory (default: campaign-NAME)")
    run.add_argument("--allow-drift", action="store_true", help="continue what another version of the solver began")
    run.set_defaults(command=_run)

    validate = commands.add_parser("validate", help="find every mistake in a scene, estimate its cost")
    _add_scene(validate)
    validate.set_defaults(command=_validate)

    status = commands.add_parser("status", help="how a campaign stands, while it runs or after")
    status.add_argument("directory", metavar="DIR", type=Path)
    status.add_argument("--watch", action="store_true", help="again and again, until it ends")
    status.set_defaults(command=_status)

    report = commands.add_parser("report", help="figures and a page from results.nc")
    report.add_argument("directory", metavar="DIR", type=Path)
    report.set_defaults(command=_report)

    replay = commands.add_parser("replay", help="one realization again, with full particle output")
    replay.add_argument("directory", metavar="DIR", type=Path)
    replay.add_argument("realization", metavar="K", type=int, help="its id; -1 is the deterministic run")
    replay.set_defaults(command=_replay)

    tradeoff = commands.add_parser("tradeoff", help="speed against accuracy: chart, table, recommended setting")
    _add_scene(tradeoff)
    tradeoff.add_argument("--out", metavar="DIR", type=Path, help="directory of the results (default: tradeoff-NAME)")
    tradeoff.add_argument("--budget", metavar="MINUTES", type=float, default=10.0, help="CPU time it may take")
    tradeoff.set_defaults(command=_tradeoff, realizations=3)

    scenes = commands.add_parser("scenes", help="list the built-in scenes")
    scenes.set_defaults(command=_scenes)
    return parser


def _add_scene(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("scene", metavar="SCENE", help="a TOML file, or the name of a built-in scene")
    parser.add_argument("--realizations", metavar="N", type=int, help="at most this many")
    parser.add_argument("--seed", metavar="S", type=int, help="seed of the random fields")
    parser.add_argument(
        "--set", metavar="KEY=VALUE", action="append", default=[], help='for instance soil.cohesion.mean="25 kPa"'
    )
