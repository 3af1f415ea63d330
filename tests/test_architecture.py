"""Data flows one way, and imports follow it."""

import ast
import sys
import tomllib
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
SOURCES = sorted([*ROOT.glob("solver/**/*.py"), *ROOT.glob("campaign/**/*.py")])


def module_name(source: Path) -> str:
    parts = source.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {module_name(source): source for source in SOURCES}


def imports(source: Path) -> set[str]:
    """Return what a file imports, wherever in it; `from campaign import x` is `campaign.x` if that is a module."""
    found: set[str] = set()
    for node in ast.walk(ast.parse(source.read_text())):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            names = {f"{node.module}.{alias.name}" for alias in node.names}
            found |= (names & MODULES.keys()) or {node.module}
    return found


def top_levels(source: Path) -> set[str]:
    return {name.split(".")[0] for name in imports(source)}


def importers_of(package: str) -> set[str]:
    return {name for name, source in MODULES.items() if package in top_levels(source)}


def floors_below(module: str) -> set[str]:
    """Return the module and all of ours that it imports, directly or not."""
    seen: set[str] = set()
    ahead = [module]
    while ahead:
        name = ahead.pop()
        if name not in seen:
            seen.add(name)
            ahead.extend(imports(MODULES[name]) & MODULES.keys())
    return seen


def test_every_package_is_installed():
    listed = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["setuptools"]["packages"]
    assert sorted(listed) == sorted(module_name(source) for source in SOURCES if source.name == "__init__.py")


def test_the_solver_knows_numpy_and_numba_alone():
    """And Numba's own compiler where a vector type is made."""
    assert importers_of("llvmlite") == {"solver.lanes"}
    allowed = {"solver", "numpy", "numba", "llvmlite"} | set(sys.stdlib_module_names)
    for name, source in MODULES.items():
        if name.startswith("solver"):
            assert top_levels(source) <= allowed, name


def test_only_the_runner_knows_mpi():
    assert importers_of("mpi4py") == {f"campaign.running.{name}" for name in ("guard", "mpi", "mpi_library")}


def test_only_the_figures_know_matplotlib():
    assert all(
        name.startswith(("campaign.report.figures.", "campaign.tradeoff.chart", "campaign.screening.chart"))
        for name in importers_of("matplotlib")
    )


def test_no_import_runs_in_a_circle():
    graph = {name: imports(source) & MODULES.keys() for name, source in MODULES.items()}
    TopologicalSorter(graph).prepare()


ROOMS = (
    "solver",
    "campaign.errors campaign.exit_codes campaign.files campaign.kept_arrays campaign.record campaign.seeds "
    "campaign.terminal",
    "campaign.fields",
    "campaign.scene",
    "campaign.storage",
    "campaign.simulation",
    "campaign.statistics",
    "campaign.accuracy",
    "campaign.results",
    "campaign.comparison",
    "campaign.report",
    "campaign.running",
    "campaign.tradeoff campaign.screening",
    "campaign.commands",
    "campaign.cli campaign.__main__",
)
"""From the lowest to the highest; a module imports from its own room and from those before it."""


def room_of(module: str) -> int:
    """Return the number of a module's room; the face of the library, `campaign` itself, imports nothing when loaded."""
    return next(
        number
        for number, names in enumerate(ROOMS)
        if any(f"{module}.".startswith(f"{name}.") for name in names.split())
    )


@pytest.mark.parametrize("module", sorted(MODULES.keys() - {"campaign"}))
def test_no_import_runs_upwards(module: str):
    ours = imports(MODULES[module]) & MODULES.keys() - {"campaign"}
    assert not [name for name in ours if room_of(name) > room_of(module)]


def test_a_scene_is_validated_without_the_libraries_that_load_slowly():
    """`campaign validate` is to answer at once; Numba, SciPy and xarray take half a second each."""
    below = floors_below("campaign.scene.foresight") | floors_below("campaign.scene.outlook")
    loaded = set().union(*(top_levels(MODULES[name]) for name in below))
    assert not loaded & {"numba", "scipy", "xarray", "matplotlib", "mpi4py"}
