"""The stability atlas: run every method where it fails.

PYTHONPATH=tests/helpers python tests/studies/atlas.py > tests/studies/atlas.md
"""

from pathlib import Path
from typing import NamedTuple

import law_cases
import space
import spectrum
import time_step
from bodies import BASES, crossing_bar, displacement_error, flying_block
from driver import SCHEMES
from quasi_static import PRANDTL, bearing_pressure
from sweep import COURANTS, draw, sweep
from whole_runs import SHORTLY_BEYOND, UNSTABLE, is_stopped, simulate, soft_ground

from solver.timestep import LARGEST_COURANT

FIGURE = Path(__file__).with_suffix(".png")

INTRODUCTION = """# The stability atlas

Where the methods of this solver, and of others, fail. Each line gives the condition, the symptom, the boundary that is
expected from the references or derived, the one measured, and what protects a user there. The tests in
`tests/stability` hold most of the lines; `atlas.py` runs all of them and makes this page and its figure.

![Energy that nine schemes create in two elastic bodies, against the Courant number](atlas.png)

A step can fail in two ways. *In place*, a block trembles so little that no particle changes its place among the nodes;
the limit to expect follows from the eigenvalues of the step (`spectrum.py`). *With crossing*, particles pass from cell
to cell as in the two bodies of the figure, and the limit is where one of them has gained a tenth of its vibration
energy, found in steps of 0.1; no theory gives it. A scene is held to the lower of the two or to a little less: USL has
a lower limit, 0.46, with 16 GIMP particles in a cell. Below its limit USL destroys up to two thirds of the vibration of
a body that crosses cells: it does not explode, it damps.
"""


class Entry(NamedTuple):
    """One line of the atlas."""

    condition: str
    symptom: str
    expected: str
    measured: str
    guard: str


def largest_quiet(gains, most=0.1):
    """Return the Courant number up to which a body gains less than ``most`` of its vibration energy."""
    quiet = 0.0
    for courant, gain in zip(COURANTS, gains, strict=True):
        if not gain < most:
            break
        quiet = courant
    return quiet


def time_step_entries(block, bar):
    """Return a line for each basis and stress update."""
    for (basis, scheme), largest in LARGEST_COURANT.items():
        crossing = min(largest_quiet(gains[basis, scheme]) for gains in (block, bar))
        still = time_step.limit_of_block(basis, scheme)
        yield Entry(
            f"{basis} with {scheme.upper()}: Courant number",
            "energy from nowhere, explosion",
            f"{spectrum.limit(basis, scheme):.2f} in place",
            f"{still:.2f} in place, {crossing or 'none'} with crossing",
            f"`numerics.courant` at most {largest:g}" if largest else "the pair is refused",
        )


def particle_entry():
    """Return the line of one particle near a node."""
    places = (0.5, 0.2, 0.05, 0.01)
    limits = [time_step.limit_of_particle(place) for place in places]
    return Entry(
        f"one linear particle under USL, {', '.join(f'{place:g}' for place in places)} cells beyond a node",
        "the limit vanishes at the node",
        "Courant " + ", ".join(f"{expected:.2f}" for _, expected in limits),
        ", ".join(f"{measured:.2f}" for measured, _ in limits),
        "linear with USL is refused",
    )


def crossing_entry():
    """Return the line of the linear basis under crossing."""
    linear, gimp = ([displacement_error(basis, cells) for cells in (12, 25, 50)] for basis in ("linear", "gimp"))
    return Entry(
        "linear basis, particles cross cells (bar of 12, 25 and 50 cells, MUSL, Courant 0.3)",
        "stress jumps by its own size",
        "grows with refinement; GIMP stays at the 2 % that finite strain explains",
        "displacement error "
        + ", ".join(f"{error:.0%}" for error in linear)
        + "; GIMP "
        + ", ".join(f"{error:.1%}" for error in gimp),
        '`basis = "gimp"` is the default; linear at most at Courant 0.2',
    )


def chessboard_entry():
    """Return the line of one particle in a cell."""
    alone, one_of_four = law_cases.chessboard_felt("gimp", 0.5), law_cases.chessboard_felt("gimp", 0.25)
    return Entry(
        "one particle in the middle of each cell, any basis",
        "forces that alternate from node to node move no particle and never fade: no rest under gravity",
        "a particle feels none of them, one of four feels 1/4",
        f"{alone:.2f}, {one_of_four:.2f}",
        '`particles_per_cell = 1` is refused with `gravity = "release"`',
    )


def fracture_entry(basis):
    """Return the line of numerical fracture of one basis."""
    (first, last), (may, must) = space.fracture(basis), space.expected_fracture(basis)
    return Entry(
        f"{basis}: stretch, two particles a cell and direction",
        "neighbours share no node: the body breaks without cause",
        f"begins at {may:.1f}, complete at {must:.1f}",
        f"{first:.1f}, {last:.1f}; a strip is flagged from {space.stretch_flagged(basis):.1f} on",
        "the record is flagged, `detached_volume` says how much is ahead of the gap, and the report in how many slides",
    )


def space_entries():
    """Return the lines of locking and of softening."""
    plain, cured = (bearing_pressure(5, locking)[-1] / PRANDTL for locking in ("none", "cell-average"))
    local, scaled = space.mesh_dependence(False), space.mesh_dependence(True)
    yield Entry(
        "plastic flow without change of volume (Prandtl's strip load, 5 cells on half the width)",
        "over-strength without a plateau",
        "load over the exact one above 1.1; within 5 % with cell averages",
        f"{plain:.2f}; {cured:.2f} with cell averages",
        '`locking = "cell-average"` is the default',
    )
    yield Entry(
        "local softening, cells halved (sheared strip)",
        "slip to half strength shrinks with the cell",
        "by 2; by 1 if the rate grows with the cell",
        f"{local:.2f}; {scaled:.2f} if scaled",
        "`softening.reference_cell` scales the rate; `internal_length` takes the cells out of it",
    )


def law_entries():
    """Return the lines of laws and formulas."""
    for basis in BASES:
        yield Entry(
            f"{basis}: share `b` of PIC in the velocity update",
            "viscosity `a b h^2 / dt`, larger for smaller steps",
            f"a = 1/6 + (l_p / h)^2 / 3 = {law_cases.expected_pic_constant(basis):.3f}",
            f"{law_cases.pic_constant(basis):.3f}",
            "half a percent of energy destroyed ends the run",
        )
    growth = ", ".join(f"{law_cases.first_order_growth(steps):.3f}" for steps in (200, 2000))
    yield Entry(
        "first-order spin, one turn in 200 and 2000 steps",
        "the deviator grows",
        "exp(8 pi^2 / n) = 1.484, 1.040",
        growth,
        f"Cayley's rotation: {abs(law_cases.cayley_growth(200) - 1.0):.0e}",
    )
    yield Entry(
        "Cholesky factor of a squared-exponential correlation, 150 points on a line",
        "indefinite by rounding",
        "finer than about 0.25 autocorrelation distances",
        f"finer than {law_cases.finest_factorised():.2f}",
        "`SamplerError`, which names the exact sampler",
    )
    chi_square, bonett = law_cases.coverages()
    yield Entry(
        "chi-square interval of a variance, lognormal values with COV 0.5, n = 100",
        "a 95 % interval that is none",
        "about 73 %",
        f"{chi_square:.0%}; Bonett's {bonett:.0%}",
        "Bonett's interval is the one in use",
    )


def guard_entries():
    """Return the lines of whole realizations, run past the scene rules."""
    stopped = sum(is_stopped(simulate(settings, without_limit=True)) for settings in UNSTABLE)
    yield Entry(
        f"{len(UNSTABLE)} unstable slopes, past the scene rules and the largest Courant number",
        "explosion, energy from nowhere, damping",
        "none ends as a normal record",
        f"{stopped} stopped",
        "energy ledger (2 %), P-wave speed, finite places",
    )
    refused = sum(is_stopped(simulate(settings)) for settings in SHORTLY_BEYOND)
    unseen = sum(not is_stopped(simulate(settings, without_limit=True)) for settings in SHORTLY_BEYOND)
    yield Entry(
        f"{len(SHORTLY_BEYOND)} slopes up to a fifth beyond the limit in place, past the scene rules",
        "shaken ground yields, which eats the energy, and slides 20 to 60 % too far, or 7 % less far",
        "none ends as a normal record",
        f"{refused} stopped; the ledger alone misses {unseen}",
        "the march takes no step beyond the largest Courant number of its basis and stress update",
    )
    courants = (0.1, 0.3, 0.6, 0.9)
    lost = ", ".join(f"{-soft_ground(courant)[1]:.1%}" for courant in courants)
    yield Entry(
        "ground pressed to a fifth by its own weight (E = 300 kPa), gravity ramp, Courant 0.1, 0.3, 0.6, 0.9",
        "MUSL destroys the energy of the bouncing ground",
        "in proportion to the step",
        lost,
        "energy ledger (2 %), which asks for a smaller step",
    )


def entries(block, bar):
    """Yield the whole atlas."""
    yield from time_step_entries(block, bar)
    yield particle_entry()
    yield crossing_entry()
    yield chessboard_entry()
    yield from map(fracture_entry, BASES)
    yield from space_entries()
    yield from law_entries()
    yield from guard_entries()


def main():
    block, bar = sweep(flying_block, BASES, SCHEMES), sweep(crossing_bar, BASES, SCHEMES)
    print(INTRODUCTION)
    print("| where it fails | symptom | expected | measured | guard |")
    print("|---|---|---|---|---|")
    for entry in entries(block, bar):
        print("| " + " | ".join(entry) + " |", flush=True)
    draw({"Free block that flies over four cells": block, "Bar whose end swings by 1.2 cells": bar}, FIGURE)


if __name__ == "__main__":
    main()
