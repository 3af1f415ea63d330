"""The runs of the run-out study: one thing varied at a time."""

from typing import NamedTuple

OURS, PRINTED = "ma2023", "ma2023-printed"
CELLS = (2.0, 1.0, 0.5, 0.25)
SHIFTS = 8  # places of the lattice under the slope


class Run(NamedTuple):
    """A deterministic run: a built-in scene and what is changed in it."""

    label: str
    scene: str
    overrides: tuple[str, ...]
    cell: float  # m


def key_of(run):
    """Return the name under which the results of a run are kept."""
    return " ".join([run.scene, *run.overrides])


class Ladder(NamedTuple):
    """Runs that differ in one thing."""

    title: str
    runs: list[Run]


def run(label, cell, *overrides, scene=OURS):
    """Return a run with cells of ``cell`` m."""
    return Run(label, scene, (f"numerics.cell={cell:g} m", *overrides), cell)


def cells(title, *overrides, scene=OURS, sizes=CELLS):
    """Return the ladder of cell sizes under some overrides."""
    return Ladder(title, [run(f"{cell:g} m", cell, *overrides, scene=scene) for cell in sizes])


def choices(title, key, values, *overrides, cell=0.5):
    """Return the ladder of one key."""
    return Ladder(title, [run(str(value), cell, f"{key}={value}", *overrides) for value in values])


def shifted(cell, shifts=SHIFTS):
    """Return runs whose toe lies at ``shifts`` places between two nodes."""
    places = [20.0 + cell * k / shifts for k in range(shifts)]
    return Ladder(f"{cell:g} m", [run(f"{x:g}", cell, f"geometry.slope.crest={x:.10g} m") for x in places])


LONG = "geometry.slope.plain=40 m"  # the printed scene's 20 m let far slides reach the wall
UNTIL_10_S = "slide.failed=14 m"  # nothing moves so far, so the end criterion is never armed

BY_CELL = [
    cells("`ma2023`", sizes=(*CELLS, 0.125)),
    cells("`ma2023`, 9 particles a cell", "numerics.particles_per_cell=9"),
    cells("`ma2023` without softening", "soil.softening.law=none"),
    cells("`ma2023-printed`: plain uGIMP, local softening", LONG, scene=PRINTED),
    cells("the same with `cell-average`", LONG, "numerics.locking=cell-average", scene=PRINTED),
]

OTHERS = [
    choices("particles per cell", "numerics.particles_per_cell", (4, 9, 16)),
    choices("Courant number", "numerics.courant", (0.2, 0.3, 0.6, 0.9)),
    Ladder(
        "domain",
        [
            run("as given", 0.5),
            run("plain 80 m", 0.5, "geometry.slope.plain=80 m"),
            run("crest 40 m", 0.5, "geometry.slope.crest=40 m"),
            run("foundation 8 m", 0.5, "geometry.slope.foundation=8 m"),
            run("foundation 16 m", 0.5, "geometry.slope.foundation=16 m"),
        ],
    ),
    Ladder(
        "release of gravity",
        [
            run("release", 0.5),
            run("ramp of 1 s", 0.5, "numerics.gravity=ramp", "numerics.ramp_time=1 s"),
            run("ramp of 2 s", 0.5, "numerics.gravity=ramp", "numerics.ramp_time=2 s"),
            run("ramp of 4 s", 0.5, "numerics.gravity=ramp", "numerics.ramp_time=4 s", "numerics.end_time=14 s"),
        ],
    ),
    Ladder(
        "end",
        [
            run("at rest", 0.5),
            run("after 10 s", 0.5, UNTIL_10_S),
            run("after 20 s", 0.5, UNTIL_10_S, "numerics.end_time=20 s"),
        ],
    ),
    choices("Young's modulus", "soil.young_modulus", ("25 MPa", "100 MPa", "400 MPa")),
]

LADDERS = [*BY_CELL, *OTHERS]
NOISE = [shifted(1.0), shifted(0.5), shifted(0.25, 4)]
