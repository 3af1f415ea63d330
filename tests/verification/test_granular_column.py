"""Run-out of columns of grains without side walls, against plane-strain continua and the equilibrium of the deposit.

Which law a column follows depends on its walls and its friction. For height over width ``a`` the run-out over the width
is 1.2 ``a`` for sand (Lube et al. 2005, Phys. Rev. E 72:041301) and 1.8 ``a`` for glass beads (Lajeunesse et al. 2005,
Phys. Fluids 17:103302) in channels, whose walls brake; the factor depends on material and channel (Balmforth and
Kerswell 2005, J. Fluid Mech. 538:399). In two dimensions without walls discs give 2.5 ``a`` up to ``a`` = 2 and 3.25
``a^0.7`` beyond (Staron and Hinch 2005, J. Fluid Mech. 545:1), and a continuum 2.2 ``a`` up to about 7 (Lagree, Staron
and Popinet 2011, J. Fluid Mech. 686:378).

The last is a column as here: plane strain, no side walls, floor without slip. Its friction ``mu(I)`` is shear over mean
stress in a flow without dilation, from 0.32 in slow flow to 0.60 in fast flow. A Mohr-Coulomb soil that does not dilate
flows at ``mu = sin phi`` (Davis 1968; ``test_incline``), so the law lies between columns of 18.7 and 36.9 degrees. In a
shallow layer, where length scales as height over friction, ``2.2 a`` with a friction between 0.32 and 0.60 becomes 1.41
``a`` to 2.64 ``a`` at 30 degrees, where it is 0.5.

Whatever happened before, a deposit without cohesion at rest is nowhere steeper than ``phi``, so it is at least as long
as a triangle or trapezium of its area with that slope and no more than the column's height.
"""

import math

import numpy as np
import pytest
from columns import collapse, column
from driver import Row

WIDTH = 100.0  # mm
ASPECT_RATIOS = (1.0, 2.0, 4.0)
FRICTION_ANGLE = math.radians(30.0)
FRICTION = math.sin(FRICTION_ANGLE)
CONTINUUM = 2.2
SLOW, FAST = 0.32, 0.60  # friction of the continuum


def run_out(aspect_ratio, friction, cell=5.0):
    """Return the run-out of the connected deposit over the width of the column; friction is ``sin phi``."""
    base = WIDTH * (3.5 + 5.0 * aspect_ratio)
    angle = f'soil.friction_angle.mean="{math.degrees(math.asin(friction))} deg"'
    end = 'numerics.end_time="3 s"'
    grains = collapse(*column(WIDTH, aspect_ratio * WIDTH, base, cell), angle, end)
    return float(grains.front / (1e-3 * WIDTH) - 1.0)


def least_run_out(aspect_ratio, friction_angle):
    """Return the run-out over the width of the shortest deposit whose slope is the friction angle (rad)."""
    slope = math.tan(friction_angle)
    if aspect_ratio > 2.0 * slope:
        return math.sqrt(2.0 * aspect_ratio / slope) - 1.0
    return 0.5 * aspect_ratio / slope


def bounds(aspect_ratio):
    """Return the run-outs over the width between which that of the continuum lies at the friction of the column."""
    return tuple(CONTINUUM * aspect_ratio * of_continuum / FRICTION for of_continuum in (SLOW, FAST))


def assert_plausible(aspect_ratio, cell):
    found = run_out(aspect_ratio, FRICTION, cell)
    assert found > least_run_out(aspect_ratio, FRICTION_ANGLE)
    low, high = bounds(aspect_ratio)
    assert low < found < high


def test_the_shortest_deposit_has_the_area_of_the_column():
    """Triangle and trapezium of slope 1 with areas 8 and 3/2: 4 wide, and 2 wide with a top of 1."""
    assert least_run_out(8.0, math.radians(45.0)) == pytest.approx(3.0)
    assert least_run_out(1.0, math.radians(45.0)) == pytest.approx(0.5)


def test_a_column_runs_out_as_a_continuum_without_walls_on_coarse_cells():
    """10 cells across. Experiments between walls, 1.2 times the width, are out of the bounds."""
    assert bounds(1.0)[0] > 1.2
    assert_plausible(1.0, 10.0)


@pytest.mark.slow
@pytest.mark.parametrize("aspect_ratio", ASPECT_RATIOS)
def test_a_column_runs_out_as_a_continuum_without_walls(aspect_ratio):
    assert_plausible(aspect_ratio, 5.0)


@pytest.mark.slow
@pytest.mark.parametrize("aspect_ratio", ASPECT_RATIOS)
def test_the_continuum_lies_between_columns_of_its_least_and_largest_friction(aspect_ratio):
    assert run_out(aspect_ratio, FAST) < CONTINUUM * aspect_ratio < run_out(aspect_ratio, SLOW)


def rows():
    ratios = np.array(ASPECT_RATIOS)
    own, short, far = (
        np.array([run_out(ratio, friction) for ratio in ASPECT_RATIOS]) for friction in (FRICTION, FAST, SLOW)
    )
    least = np.array([least_run_out(ratio, FRICTION_ANGLE) for ratio in ASPECT_RATIOS])
    low, high = bounds(ratios)
    law = CONTINUUM * ratios
    return [
        Row(
            "Granular columns, friction 30 degrees, height over width 1, 2, 4: run-out over width",
            f"{low[0]:.2f} to {high[0]:.2f} times that ratio (continuum without walls)",
            ", ".join(f"{each:.2f}" for each in own),
            f"{', '.join(f'{each:.2f}' for each in own / ratios)} times",
            bool(np.all((low < own) & (own < high))),
        ),
        Row(
            "The same, against the shortest deposit in equilibrium",
            f"above {', '.join(f'{each:.2f}' for each in least)}",
            ", ".join(f"{each:.2f}" for each in own),
            "",
            bool(np.all(own > least)),
        ),
        Row(
            "Granular columns with the largest and the least friction of that continuum",
            f"its {', '.join(f'{each:.1f}' for each in law)} between them",
            ", ".join(f"{one:.2f} to {other:.2f}" for one, other in zip(short, far, strict=True)),
            "",
            bool(np.all((short < law) & (law < far))),
        ),
    ]
