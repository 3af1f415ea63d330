"""Domains follow the ground as it deforms, and areas on the lattice are joined without a change of the picture."""

from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from campaign.report import moving
from campaign.report.figures.deposit import columns_of, deposit_of
from campaign.report.figures.domains import LONGEST, SHORTEST, corners, deformation_gradients, undeformed
from campaign.report.figures.labels import Label, highest, place_labels
from campaign.report.figures.particles import LEVELS, Scale, rectangles, still_areas
from campaign.report.figures.section import Section
from campaign.scene import load_scene
from solver.surface import Surface, slope_surface

SIDE = 0.5
X, Y = (axis.ravel() for axis in np.meshgrid(SIDE * (np.arange(8) + 0.5), SIDE * (np.arange(6) + 0.5)))


def mapped(gradient):
    return tuple(np.asarray(gradient) @ np.stack([X, Y]))


def gradients(now, ratio=1.0):
    return deformation_gradients((X, Y), now, np.full(X.size, ratio), SIDE)


@pytest.mark.parametrize(
    "gradient",
    [
        [[1.0, 0.0], [0.0, 1.0]],
        [[np.cos(1.0), -np.sin(1.0)], [np.sin(1.0), np.cos(1.0)]],
        [[1.0, 0.6], [0.0, 1.0]],
        [[1.3, 0.2], [-0.1, 0.9]],
    ],
)
def test_uniform_deformation_is_found_exactly(gradient):
    """A linear map of the lattice is its own deformation gradient, at the edge as well; J is its determinant."""
    found = gradients(mapped(gradient), float(np.linalg.det(gradient)))
    np.testing.assert_allclose(found, np.broadcast_to(gradient, found.shape), atol=1e-12)


def test_domains_have_the_area_that_the_solver_gives_and_no_endless_stretch():
    rng = np.random.default_rng(1)
    found = gradients((rng.uniform(0, 4, X.size), rng.uniform(0, 3, X.size)), 1.2)
    np.testing.assert_allclose(np.abs(np.linalg.det(found)), 1.2)
    stretch = np.linalg.svd(found, compute_uv=False)
    assert np.all(stretch[:, 0] / stretch[:, 1] < LONGEST / SHORTEST + 1e-9)


def test_a_torn_off_neighbour_does_not_stretch_a_domain():
    """The right half is carried 10 m away: beside the gap domains stay as they were, to 2 % of (1.8 / 20)^6."""
    found = gradients((X + np.where(X > 2.0, 10.0, 0.0), Y))
    np.testing.assert_allclose(found, undeformed(X.size), atol=1e-2)


def test_a_lonely_particle_keeps_its_shape():
    found = deformation_gradients((X[:1], Y[:1]), (X[:1] + 3.0, Y[:1]), np.ones(1), SIDE)
    np.testing.assert_array_equal(found, undeformed(1))


def area(polygons):
    x, y = polygons[..., 0], polygons[..., 1]
    return 0.5 * np.sum(x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1), axis=1)


def test_neighbours_of_one_colour_are_one_rectangle():
    """Six rows of eight, with one odd particle: that row falls into three, the others are whole."""
    levels = np.zeros(X.size, dtype=int)
    levels[10] = 3
    joined, of = rectangles(X, Y, levels, SIDE)
    assert sorted(of.tolist()) == [0] * 7 + [3]
    single = corners(X, Y, undeformed(X.size), SIDE)
    assert joined[..., 0].min() == pytest.approx(single[..., 0].min())
    assert joined[..., 1].max() == pytest.approx(single[..., 1].max())
    assert np.all(area(joined) > 0)


def test_still_ground_ends_at_the_surface_and_not_at_that_of_a_particle():
    """A surface that falls from 3.2 to 2.7 m over a lattice of 0.5 m, whose particles end at 3 m and at 2.5 m."""
    surface = Surface(np.array([0.0, 4.0]), np.array([3.2, 2.7]))
    is_there = surface.height_at(X) > Y
    areas = still_areas((X[is_there], Y[is_there]), np.ones(is_there.sum(), bool), Section(surface, SIDE, 4.0, 4.0))
    tops = areas[areas[..., 1].max(axis=1) > 2.6]
    at, elevation = tops[:, 2:, 0], tops[:, 2:, 1]
    np.testing.assert_allclose(elevation, surface.height_at(at), atol=1e-5)
    assert at.min() == 0.0
    assert at.max() == 4.0


@pytest.mark.parametrize("step", [1, 2, 3])
def test_joined_squares_lie_where_the_particles_lie_that_they_stand_for(step):
    """24 x 24 particles as squares of one, two or three a side: they cover the same ground."""
    side = 1.0 / 24
    i, j = (axis.ravel() for axis in np.meshgrid(np.arange(24), np.arange(24)))
    x, y = side * (i + 0.5), side * (j + 0.5)
    lattice = SimpleNamespace(x=x, y=y, volume=np.full(x.size, side**2))
    ground = SimpleNamespace(lattice=lattice, scene=load_scene("ma2023"))
    shot = SimpleNamespace(x=x + 3.0, y=y, displacement=np.full(x.size, 3.0), volume=lattice.volume)
    section = Section(slope_surface(1.0, 0.8, 2.0, 4.0, 1.0), side, 9.0, 2.0)
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(moving, "MOST", x.size / step**2)
        found = moving.moving_areas(ground, [shot], section)
    assert found.side == pytest.approx(step * side)
    frame = moving.frame_of(ground, section, found, shot)
    assert frame.x.min() - 0.5 * found.side == pytest.approx(3.0)
    assert frame.x.max() + 0.5 * found.side == pytest.approx(4.0)
    assert frame.y.min() - 0.5 * found.side == pytest.approx(0.0)
    assert frame.y.max() + 0.5 * found.side == pytest.approx(1.0)


def test_there_are_no_rectangles_of_nothing():
    nothing = np.empty(0)
    assert rectangles(nothing, nothing, nothing.astype(int), SIDE)[0].shape == (0, 4, 2)


def test_colours_end_where_the_scale_ends():
    assert Scale("viridis", 0.0, 1.0).levels(np.array([-1.0, 0.0, 0.5, 1.0, 9.0])).tolist() == [
        0,
        0,
        LEVELS // 2,
        LEVELS - 1,
        LEVELS - 1,
    ]


def test_labels_do_not_run_into_each_other_and_end_below_the_sky():
    """However near their places are: each pair is apart sideways or by a line, and all are above the ground."""
    rng = np.random.default_rng(2)
    labels = [Label(x, 0.0, "a name of some length", "k", "") for x in rng.uniform(0, 50, 12)]
    placed = place_labels(labels, lambda x: np.full_like(x, 4.0), 0.1, 50.0)
    assert len(placed) == 12
    for k, one in enumerate(placed):
        assert 4.0 < one.bottom < highest(placed, 0.1)
        assert one.right <= 50.0 + 1e-9
        for other in placed[:k]:
            beside = one.right < other.left or other.right < one.left
            assert beside or abs(one.bottom - other.bottom) >= 1.9 - 1e-9
            assert not (one.left < other.label.x < one.right and one.bottom < other.bottom)


def test_no_line_crosses_a_name_on_a_short_section():
    """Of five places within 8 m each name is wider than the way to the next place, and than that to the last one."""
    labels = [Label(x, 2.0, "house of the miller, x = 10.5 m", "k", "") for x in (6.6, 7.0, 8.0, 10.5, 14.0)]
    placed = place_labels(labels, lambda x: np.where(x < 6.6, 8.0, 2.0), 0.5, 19.0)
    for one in placed:
        crossed = [other for other in placed if one.left < other.label.x < one.right and one.bottom < other.bottom]
        assert not crossed


def test_ground_that_no_slide_moves_is_drawn_as_high_as_the_slope_is():
    """The dataset's surface is a quarter of a cell too high where particles fill the ground only so."""
    surface = Surface(np.array([0.0, 4.0, 6.0, 10.0]), np.array([3.3, 3.3, 1.3, 1.3]))
    x = np.arange(10) + 0.5
    of_particles = columns_of(surface, x) + 0.2
    after = np.stack([of_particles, of_particles + np.where(x > 6.0, 0.5, 0.0)])
    data = xr.Dataset(
        {"initial_surface": ("x", of_particles), "deposit_surface": (("realization", "x"), after)}, {"x": x}
    )
    outcomes = SimpleNamespace(slides=2)
    deposit = deposit_of(SimpleNamespace(data=data, outcomes=outcomes, has_slid=np.full(2, True)), surface)
    assert (deposit.x[0], deposit.x[-1]) == (0.0, 10.0)
    np.testing.assert_allclose(deposit.before[1:5], 3.3)
    np.testing.assert_allclose(deposit.median[1:7], deposit.before[1:7])
    np.testing.assert_allclose(deposit.median[7:] - 1.3, 0.25)


def test_a_column_with_a_vertical_face_has_the_mean_elevation():
    surface = Surface(np.array([0.0, 1.5, 1.5, 3.0]), np.array([4.0, 4.0, 1.0, 1.0]))
    np.testing.assert_allclose(columns_of(surface, np.array([0.5, 1.5, 2.5])), [4.0, 2.5, 1.0])
