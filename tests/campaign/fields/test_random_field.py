"""The field of soil strengths: its statistics, and that it belongs to the ground and not to the mesh."""

import pickle
from math import exp, expm1, log, pi, radians, sqrt

import numpy as np
import pytest
from scipy import stats
from soil_fields import COHESION, FRICTION, assert_mean, box_scene, draws, small_sampler, standard

from campaign.errors import SamplerError
from campaign.fields.marginals import Lognormal, gaussian_cross_correlation
from campaign.fields.reference_grid import ReferenceGrid
from campaign.seeds import BASELINE
from campaign.simulation.scene_sampler import strength_sampler

GOLDEN = [26234.497928, 18832.865449, 19053.353441]


@pytest.fixture(scope="module", params=["exponential", "separable-exponential", "squared-exponential", "turned"])
def ensemble(request):
    kind, angle = ("exponential", 0.4) if request.param == "turned" else (request.param, 0.0)
    return (*draws(small_sampler(correlation=kind, angle=angle)), kind, angle)


def test_mean_and_coefficient_of_variation(ensemble):
    """Mean of X, and mean of ((X - mean) / mean)^2 = COV^2. False alarm: 4 x 6.3e-5 for each of four fields."""
    for values, marginal in zip(ensemble[:2], (COHESION, FRICTION), strict=True):
        relative = values / marginal.mean - 1.0
        assert_mean(relative.mean(axis=(1, 2)), 0.0)
        assert_mean((relative**2).mean(axis=(1, 2)), marginal.cov**2)


def test_marginal_is_lognormal(ensemble):
    """Kolmogorov-Smirnov at three places, over realizations. False alarm: 6 x 1e-4 for each of four fields."""
    for values, marginal in zip(ensemble[:2], (COHESION, FRICTION), strict=True):
        s = sqrt(log(1.0 + marginal.cov**2))
        law = stats.lognorm(s, scale=marginal.mean * exp(-(s**2) / 2.0))
        for place in ((0, 0), (3, 5), (-1, -1)):
            assert stats.kstest(values[:, *place], law.cdf).pvalue > 1e-4


def test_cross_correlation_is_that_of_the_gaussian_fields(ensemble):
    """Eq. (4). False alarm: 6.3e-5 for each of four fields."""
    product = standard(ensemble[0], COHESION) * standard(ensemble[1], FRICTION)
    assert_mean(product.mean(axis=(1, 2)), -0.5)


@pytest.mark.parametrize("lag", [(0, 1), (0, 4), (0, 8), (1, 0), (2, 0), (4, 0), (2, 4), (2, -4)])
def test_autocorrelation(ensemble, lag):
    """Along both axes and both diagonals, the formulas written out. False alarm: 2 x 6.3e-5 for each of 32 cases."""
    *fields, kind, angle = ensemble
    dy, dx = 0.5 * lag[0], 0.5 * lag[1]
    u = (dx * np.cos(angle) + dy * np.sin(angle)) / 4.0
    v = (-dx * np.sin(angle) + dy * np.cos(angle)) / 1.0
    expected = {
        "exponential": exp(-sqrt(u**2 + v**2)),
        "separable-exponential": exp(-abs(u) - abs(v)),
        "squared-exponential": exp(-(u**2) - v**2),
    }[kind]
    for values, marginal in zip(fields, (COHESION, FRICTION), strict=True):
        z = standard(values, marginal)
        rows, columns = z.shape[1:]
        here = z[:, : rows - lag[0], max(0, -lag[1]) : columns - max(0, lag[1])]
        there = z[:, lag[0] :, max(0, lag[1]) : columns + min(0, lag[1])]
        assert_mean((here * there).mean(axis=(1, 2)), expected)


def test_cross_correlation_of_the_lognormal_fields():
    """Pearson correlation of c and phi themselves, strong and with large scatter. False alarm: 6.3e-5."""
    wild = COHESION.model_copy(update={"cov": 0.5}), FRICTION.model_copy(update={"mean": radians(10.0), "cov": 0.5})
    cohesion, friction = draws(small_sampler(*wild, cross_correlation=-0.7, cross_correlation_of="lognormal"))
    product = (cohesion / wild[0].mean - 1.0) * (friction / wild[1].mean - 1.0) / 0.25
    assert_mean(product.mean(axis=(1, 2)), -0.7)


@pytest.mark.parametrize(("cov", "expected"), [(0.1, -0.5038), (0.2, -0.5151), (0.3, -0.5343), (0.5, -0.5984)])
def test_gaussian_cross_correlation(cov, expected):
    """Tabulated, and inverted by E[XY] of a bivariate lognormal: (exp(rho_G s^2) - 1) / COV^2 = -0.5."""
    law = Lognormal(1.0, cov)
    rho = gaussian_cross_correlation(-0.5, law, law)
    assert rho == pytest.approx(expected, abs=5e-5)
    assert expm1(rho * log(1.0 + cov**2)) / cov**2 == pytest.approx(-0.5, rel=1e-12)


def test_scale_of_fluctuation_is_twice_the_distance_of_the_exponential():
    distances = small_sampler().draw(1, 0)
    scales = small_sampler(horizontal=8.0, vertical=2.0, length_kind="scale-of-fluctuation").draw(1, 0)
    assert np.array_equal(distances["cohesion"], scales["cohesion"])


def test_default_resolution_has_eight_cells_in_the_shorter_distance():
    assert small_sampler(resolution=None).grid.resolution == 0.125


def test_baseline_is_the_mean_everywhere():
    soil = small_sampler().draw(7, BASELINE).at(np.array([0.1, 5.9]), np.array([2.9, 0.0]))
    assert soil["cohesion"].tolist() == [20e3, 20e3]
    assert soil["friction_angle"].tolist() == [radians(20.0)] * 2


def test_the_dataset_says_what_each_field_is():
    drawn = small_sampler().draw(7, 0)
    data = drawn.to_dataset()
    assert data.friction_angle.attrs == {"units": "rad", "long_name": "peak friction angle", "symbol": "phi"}
    assert np.array_equal(data.cohesion.sel(x=0.75, y=1.25), drawn["cohesion"][2, 1])


def test_realization_depends_on_seed_and_identity_alone():
    """Built again, sent to another rank, drawn in another order: bitwise the same field."""
    sampler = small_sampler()
    first = sampler.draw(7, 3)["cohesion"]
    sampler.draw(7, 4)
    for other in (sampler, small_sampler(), pickle.loads(pickle.dumps(sampler))):
        assert np.array_equal(other.draw(7, 3)["cohesion"], first)
    assert not np.array_equal(sampler.draw(8, 3)["cohesion"], first)
    assert not np.array_equal(sampler.draw(7, 4)["cohesion"], first)


def test_field_is_stable():
    """Stored campaigns can be continued only while realization 0 of seed 2023 stays what it was."""
    drawn = small_sampler().draw(2023, 0)
    assert drawn["cohesion"][2, :3].round(6).tolist() == GOLDEN


@pytest.mark.parametrize("cell", [1.0, 0.5, 0.25])
def test_field_is_the_same_on_every_mesh(cell):
    """Particles at k/4 of a cell read what the finest mesh reads there, on the edges of the field's cells as well."""
    field = small_sampler().draw(7, 0)
    corners = cell * np.arange(round(6.0 / cell))
    for offset in (0.25, 0.5, 0.75):
        x = corners + offset * cell
        y = np.full_like(x, 1.25)
        column = [int((place + 1e-9) // 0.5) for place in x]
        assert np.array_equal(field.at(x, y)["cohesion"], field["cohesion"][2, column])


def test_place_on_an_edge_reads_one_cell_whatever_its_rounding():
    """0.1 + 0.2 is larger than 0.3 and 3 x 0.1 / 0.1 may be less than 3; both are the same place."""
    grid = ReferenceGrid.covering(1.0, 1.0, 0.1)
    x = np.array([0.3, 0.1 + 0.2, np.nextafter(0.3, 0.0), 3 * 0.1])
    assert grid.shape == (10, 10)
    assert grid.index(x, x)[1].tolist() == [3, 3, 3, 3]
    assert grid.index(np.array([0.0, 1.0]), np.array([1.0, 0.0]))[0].tolist() == [9, 0]


def test_place_outside_the_field_is_refused():
    with pytest.raises(ValueError, match=r"x = 6\.5 m is outside the random field"):
        small_sampler().draw(7, 0).at(np.array([1.0, 6.5]), np.array([1.0, 1.0]))


@pytest.mark.parametrize("side", [-1.0, 1.0])
@pytest.mark.parametrize("up", [-1.0, 1.0])
def test_cholesky_covers_the_ground_and_nothing_else(side, up, tmp_path):
    """A steep face that cuts cells anywhere, with the ground in each of the four quarters: no particle is left out."""

    def ground(x, y):
        return side * (x - 3.1) + up * 0.7 * (y - 1.6) <= 0.0

    sampler = strength_sampler(box_scene(sampler="cholesky"), 6.0, 3.0, tmp_path, ground)
    drawn = sampler.draw(7, 0)
    x, y = np.random.default_rng(0).uniform((0.0, 0.0), (6.0, 3.0), (5000, 2)).T
    inside = ground(x, y)
    assert np.isfinite(drawn.at(x[inside], y[inside])["friction_angle"]).all()
    with pytest.raises(ValueError, match="is not in the ground"):
        drawn.at(x[~inside], y[~inside])


def test_friction_angle_beyond_the_vertical_is_refused():
    sampler = small_sampler(COHESION, FRICTION.model_copy(update={"mean": radians(70.0), "cov": 0.5}))
    with pytest.raises(SamplerError, match="Realization 0 has a peak friction angle of"):
        [sampler.draw(7, k) for k in range(20)]
    assert sampler.draw(7, BASELINE)["friction_angle"].max() < pi / 2
