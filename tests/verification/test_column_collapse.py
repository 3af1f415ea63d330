"""Collapse of columns of aluminium bars, against experiments: truly two-dimensional, without cohesion, to rest.

Bui, Fukagawa, Sako and Ohno (2008, IJNAMG 32:1537) measured the surface of one column at rest and the line below which
nothing moved; Nguyen, Bui and Fukagawa (2015, arXiv 1512.05180) how far columns of every aspect ratio run. The base is
fixed, so bars slide on it with their own friction. No parameter is fitted.
"""

from pathlib import Path

import numpy as np
import pytest
from columns import collapse, column
from driver import Row

from campaign.simulation.detachment import detached_volume
from solver import observables
from solver.march import MarchEnd

DATA = Path(__file__).parent / "data"


def measured(name):
    """Return ``x, z`` in m of the digitised points."""
    return np.loadtxt(DATA / f"bui2008_{name}.csv", delimiter=",", skiprows=5).T * 1e-3


def surface_error(bars):
    """Return the root mean square difference to the measured surface in m."""
    x, z = measured("surface")
    return float(np.sqrt(np.mean((np.interp(x, bars.column, bars.height) - z) ** 2)))


def failure_line_error(bars):
    """Return the differences in m between the top of the bars that did not move and the measured line."""
    x, z = measured("failure_line")
    stayed = ~observables.is_displaced(bars.history.particles, bars.start, bars.slide)
    spacing = np.sqrt(bars.start.volume.mean())
    tops = [bars.start.y[stayed & (np.abs(bars.start.x - place) <= 0.6 * spacing)].max(initial=0.0) for place in x]
    return np.array(tops) + 0.5 * spacing - z


@pytest.fixture(scope="module")
def bars():
    return collapse()


def test_the_column_comes_to_rest(bars):
    assert bars.history.end is MarchEnd.AT_REST
    assert bars.history.settle_time < 1.5
    assert abs(bars.history.energy_error) < 0.01


def test_surface_at_rest(bars):
    """Five percent of the height. The measured deposit has 1.5 % more area than the column, 0.7 mm on average."""
    assert surface_error(bars) < 5e-3


def test_crest_keeps_its_height(bars):
    assert bars.height[0] == pytest.approx(0.1, abs=1e-3)


def test_failure_line(bars):
    """As close as a cell, and on the side of more material that moves not."""
    assert np.sqrt(np.mean(failure_line_error(bars) ** 2)) < 5e-3


FRONT = (
    "measured 442 mm, computed 510: in pure FLIP the last percents of the mass separate, bounce and run on; the target "
    "of 10 % stays"
)


@pytest.mark.xfail(strict=True, reason=FRONT)
def test_front(bars):
    assert bars.front == pytest.approx(0.442, rel=0.10)


def test_front_is_not_far_beyond(bars):
    assert 0.442 < bars.front < 0.442 * 1.2


def test_bars_that_have_come_apart_are_noticed(bars):
    """Up to a percent of them flies ahead of what is joined."""
    apart = detached_volume(bars.history.particles, bars.start, bars.model.surface, bars.model.particle_spacing)
    assert 0.0 < apart < 0.01 * bars.start.volume.sum()


@pytest.mark.slow
def test_finer_cells_tell_the_same():
    """So the front is wrong for another reason than the cells.

    The front is a single loose particle, which scatters by 6 mm (standard deviation of 16 runs) when round-off or the
    time step changes. The median of five runs scatters by 3 mm: three such are 10 mm, a false alarm in 1 of 300.
    """
    fine = [
        collapse('numerics.cell="2.5 mm"', f"numerics.courant={courant}") for courant in (0.58, 0.59, 0.6, 0.61, 0.62)
    ]
    assert np.median([run.front for run in fine]) == pytest.approx(0.510, abs=0.01)
    assert surface_error(fine[0]) < 5e-3


@pytest.mark.slow
def test_more_particles_in_a_cell_tell_the_same():
    fine = collapse("numerics.particles_per_cell=9")
    assert fine.front == pytest.approx(0.510, abs=0.02)


@pytest.mark.slow
@pytest.mark.parametrize("aspect_ratio", [1.0, 1.5, 2.0])
def test_scaling_of_rod_columns(aspect_ratio):
    """Nguyen, Bui and Fukagawa: ``d / d0 = 4.30 a^0.72`` and ``h0 / h = 1.42 a^(2/3)`` above 0.65.

    With the friction angle of the other experiment, because theirs is not known here. At 0.65 the measured law begins;
    its (d - d0) / d0 there is 2.15, against 1.21 that Bui et al. measured at 0.5.
    """
    width = 0.1 / aspect_ratio
    base = 1e3 * width * 9.0 * aspect_ratio**0.5
    rods = collapse(*column(1e3 * width, 100.0, base, min(5.0, 50.0 * width)))
    assert rods.front / width == pytest.approx(4.30 * aspect_ratio**0.72, rel=0.15)
    assert 0.1 / rods.height[0] == pytest.approx(1.42 * aspect_ratio ** (2 / 3), rel=0.1)


def rows():
    bars = collapse()
    surface, failure_line = surface_error(bars), float(np.sqrt(np.mean(failure_line_error(bars) ** 2)))
    front, crest = bars.front / 0.442 - 1.0, bars.height[0] / 0.1 - 1.0
    return [
        Row(
            "Column of aluminium bars (Bui et al. 2008), surface",
            "5 mm rms",
            "",
            f"{surface * 1e3:.1f} mm",
            surface < 5e-3,
        ),
        Row("The same, failure line", "5 mm rms", "", f"{failure_line * 1e3:.1f} mm", failure_line < 5e-3),
        Row(
            "The same, crest", "100 mm within 1 %", f"{bars.height[0] * 1e3:.1f} mm", f"{crest:+.1%}", abs(crest) < 0.01
        ),
        Row("The same, front", "442 mm within 10 %", f"{bars.front * 1e3:.0f} mm", f"{front:+.0%}", abs(front) < 0.10),
    ]
