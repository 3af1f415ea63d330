"""From a surface to particles."""

import itertools

import numpy as np
import pytest

from solver.faces import face_stack, foot_of_slope
from solver.filling import fill_ground, fill_to_surface
from solver.surface import Surface, slope_surface


def surface(*points):
    x, y = np.array(points, dtype=float).T
    return Surface(x, y)


PAPER = slope_surface(height=15.0, angle=np.radians(45.0), crest=20.0, plain=20.0, foundation=4.0)


def test_the_papers_slope_has_the_papers_10090_particles():
    assert fill_ground(PAPER, 0.5, 4, 2000.0).x.size == 10_090


def test_slope_has_its_toe_at_the_foot():
    assert PAPER.toe == pytest.approx((35.0, 4.0), abs=1e-12)
    assert PAPER.width == pytest.approx(55.0)
    assert PAPER.top == 19.0


@pytest.mark.parametrize(
    ("points", "toe"),
    [
        pytest.param([(0, 9), (10, 9), (10, 4), (30, 4)], 10.0, id="vertical face"),
        pytest.param([(0, 22), (20, 22), (35, 7), (75, 5)], 35.0, id="falling plain"),
        pytest.param([(0, 22), (20, 22), (35, 7), (75, 6.99)], 35.0, id="plain that falls a centimetre"),
        pytest.param([(0, 22), (20, 22), (35, 7), (75, 9)], 35.0, id="rising plain"),
        pytest.param([(0, 19), (20, 19), (35, 4), (45, 4), (60, 10), (80, 10)], 35.0, id="valley"),
        pytest.param([(0, 10), (10, 10), (16, 4), (40, 4), (60, 25)], 16.0, id="valley with a higher far side"),
        pytest.param([(0, 20), (10, 20), (12, 19), (30, 12), (31, 11.8), (50, 11)], 30.0, id="edge, face, small step"),
        pytest.param(
            [(0, 30), (20, 30), (22, 28.5), (30, 20), (40, 12), (50, 8), (60, 6), (80, 5.5), (100, 5)],
            40.0,
            id="hollow slope that runs out in a fan",
        ),
        pytest.param(
            [
                (0, 25),
                (30, 24),
                (36, 24),
                (42, 19),
                (46, 18.6),
                (53, 13),
                (57, 12.6),
                (64, 7),
                (68, 6.6),
                (69.5, 5.8),
                (71, 6.6),
                (76, 6.8),
                (82, 6.8),
                (100, 6),
                (125, 5),
            ],
            64.0,
            id="cut of three faces above a ditch",
        ),
        pytest.param(
            [(0, 25), (36, 25), (42, 19), (46, 19), (52, 13), (56, 13), (62, 7), (125, 7)], 62.0, id="regular benches"
        ),
        pytest.param([(0, 25), (20, 25), (20, 19), (24, 19), (30, 13), (90, 13)], 30.0, id="wall above a face"),
        pytest.param([(0, 25), (20, 25), (30, 15), (45, 15), (50, 10), (90, 10)], 30.0, id="face beyond a wide berm"),
        pytest.param([(0, 14), (20, 14), (30, 4), (33, 4), (34, 2.8), (50, 2.8)], 30.0, id="bank of a stream"),
    ],
)
def test_the_toe_is_the_foot_of_the_slope_however_many_faces_short_benches_part(points, toe):
    assert foot_of_slope(*np.array(points, dtype=float).T) == toe


def test_a_wall_that_faces_away_is_no_face():
    """A step up of 8 m, higher than the slope, and 4 m down beyond it."""
    points = np.array([(0, 2), (20, 2), (20, 10), (30, 10), (34, 6), (60, 6)], dtype=float)
    assert foot_of_slope(*points.T) == 34.0


def test_any_surface_that_descends_has_a_slope_that_descends():
    """Rough ones and ones with walls either way; one with a steep ditch through the slope among them."""
    rng = np.random.default_rng(20)
    for _ in range(500):
        x = np.sort(rng.uniform(0.0, 40.0, rng.integers(2, 16)))
        x = np.round(x / 4) * 4 if rng.random() < 0.5 else x
        y = np.cumsum(rng.normal(0.0, 2.0, x.size))
        if np.all(np.diff(y) >= 0.0):
            continue
        head, foot = face_stack(x, y)
        assert head < foot
        assert y[head] > y[foot]


def test_the_foot_does_not_depend_on_how_finely_a_surface_is_drawn():
    x = np.array([0.0, 20.0, 35.0, 75.0])
    y = np.array([22.0, 22.0, 7.0, 5.0])
    fine = np.union1d(x, np.linspace(0.0, 75.0, 151))
    assert foot_of_slope(fine, np.interp(fine, x, y)) == 35.0


@pytest.mark.parametrize(
    ("points", "toe", "crest"),
    [
        ([[0, 22], [20, 22], [35, 7], [75, 5]], 35.0, 20.0),
        ([[0, 8], [10, 8], [10, 4], [30, 4]], 10.0, 10.0),
        ([[0, 22], [20, 21.8], [24, 18], [35, 7], [75, 7]], 35.0, 20.0),  # the crest falls by a hundredth
        ([[0, 19], [20, 19], [35, 4], [45, 4], [60, 10], [80, 10]], 35.0, 20.0),
        ([[0, 19], [10, 19], [20, 9], [40, 9], [50, 4], [80, 4]], 50.0, 10.0),  # two faces, alike: the higher one
        ([[0, 19], [10, 19], [20, 9], [40, 9], [45, 4], [80, 4]], 30.0, 10.0),  # a toe on the berm
        ([[0, 4], [20, 8], [40, 4]], 10.0, 10.0),  # no face above the toe
        ([[0, 25], [36, 25], [44, 19], [48, 19], [54, 13], [58, 13], [62, 7], [99, 7]], 62.0, 36.0),  # steeper below
    ],
)
def test_the_crest_is_where_the_steepest_face_above_the_toe_begins(points, toe, crest):
    assert Surface(*np.array(points, dtype=float).T, toe).crest_x == crest


def test_ground_that_only_rises_has_no_foot():
    with pytest.raises(ValueError, match="nowhere descends"):
        foot_of_slope(np.array([0.0, 10.0]), np.array([1.0, 2.0]))


@pytest.mark.parametrize(
    ("x", "height"), [(0.0, 19.0), (10.0, 19.0), (20.0, 19.0), (27.5, 11.5), (35.0, 4.0), (55.0, 4.0)]
)
def test_height_is_interpolated(x, height):
    assert PAPER.height_at(np.array([x]))[0] == pytest.approx(height)


def test_height_on_a_vertical_face_is_that_of_the_ground_to_its_right():
    stairs = surface((0, 9), (10, 9), (10, 4), (30, 4))
    np.testing.assert_allclose(stairs.height_at(np.array([10.0 - 1e-9, 10.0, 10.0 + 1e-9])), [9.0, 4.0, 4.0])


def test_vertical_face_holds_exactly_its_area():
    ground = fill_ground(surface((0, 9), (10, 9), (10, 4), (30, 4)), 0.5, 4, 2000.0)
    assert ground.volume.sum() == pytest.approx(10 * 9 + 20 * 4, rel=1e-13)
    assert ground.mass.sum() == pytest.approx(2000.0 * (10 * 9 + 20 * 4), rel=1e-13)


@pytest.mark.parametrize("particles_per_cell", [1, 4, 9, 16])
def test_particles_tile_level_ground(particles_per_cell):
    ground = fill_ground(surface((0, 2), (3, 2)), 0.5, particles_per_cell, 2000.0)
    spacing = 0.5 / np.sqrt(particles_per_cell)
    assert ground.x.size == 6 * 4 * particles_per_cell
    assert ground.x.min() == pytest.approx(spacing / 2)
    assert ground.x.max() == pytest.approx(3.0 - spacing / 2)
    assert ground.y.max() == pytest.approx(2.0 - spacing / 2)
    assert len(set(zip(ground.x.round(9), ground.y.round(9), strict=True))) == ground.x.size


def test_area_of_an_inclined_surface_converges():
    """The staircase keeps lattice points strictly below the surface: at 45 degrees half a spacing squared a step."""
    exact = 20.0 * 19.0 + 15.0 * (19.0 + 4.0) / 2.0 + 20.0 * 4.0
    errors = [abs(fill_ground(PAPER, cell, 4, 2000.0).volume.sum() / exact - 1.0) for cell in (1.0, 0.5, 0.25)]
    assert errors[1] < 0.005
    np.testing.assert_allclose(np.log2(np.divide(errors[:-1], errors[1:])), 1.0, atol=0.05)


def test_particles_come_sorted_by_cell():
    ground = fill_ground(PAPER, 0.5, 4, 2000.0)
    cell = np.floor(ground.y / 0.5) * 1000 + np.floor(ground.x / 0.5)
    assert np.all(np.diff(cell) >= 0)


def drawn_moments(points):
    """Return the area, and the centroid, of the ground under a polyline, by the formulas of a trapezium."""
    area = first_x = first_y = 0.0
    for (x_a, y_a), (x_b, y_b) in itertools.pairwise(points):
        width = x_b - x_a
        area += width * (y_a + y_b) / 2.0
        first_x += width * (x_a * (2.0 * y_a + y_b) + x_b * (y_a + 2.0 * y_b)) / 6.0
        first_y += width * (y_a**2 + y_a * y_b + y_b**2) / 6.0
    return area, first_x / area, first_y / area


ROUGH = [(0, 4.13), (2.2, 4.9), (5.7, 4.9), (5.7, 3.31), (8.05, 2.0), (9.0, 1.07), (9.0, 0.4), (11.3, 0.72), (14, 0.61)]
CLIFF = [(0, 9), (10, 9), (10, 4), (30, 4)]
WEDGE = [(0, 6.2), (3, 6.2), (9.2, 0.001), (14, 0.001)]


@pytest.mark.parametrize("particles_per_cell", [1, 4, 9])
@pytest.mark.parametrize("points", [ROUGH, CLIFF, WEDGE])
def test_cut_particles_have_the_mass_that_is_drawn(points, particles_per_cell):
    ground = fill_to_surface(surface(*points), 0.5, particles_per_cell, 2000.0)
    area, x, y = drawn_moments(points)
    assert ground.volume.sum() == pytest.approx(area, rel=1e-12)
    assert ground.mass.sum() == pytest.approx(2000.0 * area, rel=1e-12)
    centre = np.average(ground.x, weights=ground.volume), np.average(ground.y, weights=ground.volume)
    assert centre == pytest.approx((x, y), abs=0.02)


def test_cut_particles_are_none_too_light_and_stand_on_the_lattice():
    ground = fill_to_surface(surface(*ROUGH), 0.5, 4, 2000.0)
    assert ground.volume.min() > 0.499 * 0.25**2
    assert ground.volume.max() < 2.5 * 0.25**2
    for places in (ground.x, ground.y):
        np.testing.assert_allclose(places / 0.25 % 1.0, 0.5, atol=1e-9)


def test_squares_that_are_half_full_are_particles():
    """At 45 degrees through the corners of the lattice: 60 squares along the face of 15 m, whatever the rounding."""
    whole, cut = (fill(PAPER, 0.5, 4, 2000.0) for fill in (fill_ground, fill_to_surface))
    half = np.isclose(cut.volume, 0.5 * 0.25**2)
    assert half.sum() == 60 == cut.x.size - whole.x.size
    np.testing.assert_allclose(PAPER.height_at(cut.x[half]), cut.y[half])
    assert cut.volume.sum() == pytest.approx(PAPER.area, rel=1e-12)


def test_level_ground_on_the_lattice_is_the_same_either_way():
    line = surface((0, 2), (3, 2))
    whole, cut = (fill(line, 0.5, 4, 2000.0) for fill in (fill_ground, fill_to_surface))
    for one, other in zip(whole, cut, strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-12)


def test_mass_grows_smoothly_with_a_slope():
    """By centimetres of height: the lattice jumps by a row of particles, what is cut grows in proportion."""
    heights = np.arange(6.0, 6.5, 0.02)
    slopes = [surface((0, 2 + h), (5, 2 + h), (5 + h, 2), (20, 2)) for h in heights]
    whole, cut = (
        np.array([fill(line, 1.0, 4, 1.0).mass.sum() for line in slopes]) for fill in (fill_ground, fill_to_surface)
    )
    drawn = np.array([drawn_moments(list(zip(line.x, line.y, strict=True)))[0] for line in slopes])
    np.testing.assert_allclose(cut, drawn, rtol=1e-12)
    assert np.abs(whole - drawn).max() > 1.0
