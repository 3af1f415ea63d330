"""Residual strength as two more random fields: four fields with the moments and the correlations that were asked for.

Each estimate is compared within four of its standard errors, over which it is by chance with a probability of 6.3e-5.
"""

from itertools import combinations
from math import exp, log, radians, sqrt

import numpy as np
import pytest
from scipy.stats import norm
from soil_fields import COHESION, FRICTION, assert_mean, box_scene, draws, small_sampler, standard

from campaign.fields.properties import BY_NAME, PROPERTIES, marginals, raised_to_floor
from campaign.scene.sections import Pairs
from campaign.seeds import BASELINE

COHESIONS = COHESION.model_copy(update={"residual_cov": 0.4})
FRICTIONS = FRICTION.model_copy(update={"residual_cov": 0.1})
ASKED = {
    ("cohesion", "friction_angle"): -0.5,
    ("cohesion", "cohesion_residual"): 0.5,
    ("friction_angle", "friction_angle_residual"): 0.4,
    ("cohesion_residual", "friction_angle_residual"): -0.3,
}
PAIRS = Pairs.model_validate(
    {
        "cohesion": {"cohesion_residual": 0.5},
        "friction_angle": {"friction_angle_residual": 0.4},
        "friction_angle_residual": {"cohesion_residual": -0.3},
    }
)


@pytest.fixture(scope="module", params=["circulant", "kronecker", "cholesky"])
def ensemble(request):
    """Return 2000 realizations by property, each (n, ny, nx)."""
    sampler = small_sampler(
        COHESIONS, FRICTIONS, pairs=PAIRS, sampler=request.param, correlation="separable-exponential"
    )
    return dict(zip(BY_NAME, draws(sampler), strict=True))


def test_four_fields_have_their_means_and_coefficients_of_variation(ensemble):
    """False alarm: 8 x 6.3e-5 for each of three samplers."""
    laws = marginals(box_scene(COHESIONS, FRICTIONS))
    assert [(law.mean, law.cov) for law in laws.values()] == [
        (20e3, 0.3),
        (radians(20.0), 0.2),
        (10e3, 0.4),
        (radians(12.0), 0.1),
    ]
    for name, law in laws.items():
        relative = ensemble[name] / law.mean - 1.0
        assert_mean(relative.mean(axis=(1, 2)), 0.0)
        assert_mean((relative**2).mean(axis=(1, 2)), law.cov**2)


def test_six_pairs_have_the_cross_correlations_asked_for_and_none_besides(ensemble):
    """False alarm: 6 x 6.3e-5 for each of three samplers."""
    gaussian = {name: standard(ensemble[name], law) for name, law in marginals(box_scene(COHESIONS, FRICTIONS)).items()}
    for pair in combinations(BY_NAME, 2):
        product = gaussian[pair[0]] * gaussian[pair[1]]
        assert_mean(product.mean(axis=(1, 2)), ASKED.get(pair, 0.0))


@pytest.mark.parametrize("name", ["cohesion_residual", "friction_angle_residual"])
def test_residual_strength_has_the_autocorrelation_of_the_peak(ensemble, name):
    """exp(-dx / 4 m - dy / 1 m), at lags of 2 m and of 0.5 m. False alarm: 4 x 6.3e-5 for each of three samplers."""
    z = standard(ensemble[name], marginals(box_scene(COHESIONS, FRICTIONS))[name])
    assert_mean((z[:, :, :-4] * z[:, :, 4:]).mean(axis=(1, 2)), exp(-2.0 / 4.0))
    assert_mean((z[:, :-1] * z[:, 1:]).mean(axis=(1, 2)), exp(-0.5 / 1.0))


def test_lognormal_peak_and_residual_have_the_correlation_asked_for():
    """Pearson's, of the values themselves, with large scatter. False alarm: 6.3e-5."""
    wild = COHESION.model_copy(update={"cov": 0.5, "residual": 10e3, "residual_cov": 0.8})
    pairs = Pairs.model_validate({"cohesion": {"cohesion_residual": 0.7}})
    drawn = draws(small_sampler(wild, FRICTION, pairs=pairs, cross_correlation_of="lognormal"))
    assert_mean(((drawn[0] / 20e3 - 1.0) * (drawn[2] / 10e3 - 1.0)).mean(axis=(1, 2)), 0.7 * 0.5 * 0.8)


@pytest.mark.parametrize("sampler", ["circulant", "cholesky"])
def test_a_property_that_becomes_random_leaves_the_others_what_they_were(sampler):
    """The same random numbers for the same property, whichever others are random: bit for bit."""
    none = small_sampler(sampler=sampler).draw(7, 3)
    both = small_sampler(COHESIONS, FRICTIONS, pairs=PAIRS, sampler=sampler).draw(7, 3)
    for name in none.names:
        assert np.array_equal(none[name], both[name])
    alone = small_sampler(COHESION, FRICTIONS, sampler=sampler).draw(7, 3)
    together = small_sampler(COHESIONS, FRICTIONS, sampler=sampler).draw(7, 3)
    assert alone.names == ("cohesion", "friction_angle", "friction_angle_residual")
    for name in alone.names:
        assert np.array_equal(alone[name], together[name])


def test_the_baseline_has_the_mean_of_every_random_property():
    drawn = small_sampler(COHESIONS, FRICTIONS, pairs=PAIRS).draw(7, BASELINE)
    for name, mean in zip(drawn.names, (20e3, radians(20.0), 10e3, radians(12.0)), strict=True):
        assert np.unique(drawn[name]).tolist() == [mean]


def test_no_peak_is_below_its_residual(ensemble):
    raised = raised_to_floor(ensemble)
    assert np.any(ensemble["cohesion"] < ensemble["cohesion_residual"])
    assert np.all(raised["cohesion"] >= raised["cohesion_residual"])
    assert np.all(raised["friction_angle"] >= raised["friction_angle_residual"])
    for name in ("cohesion_residual", "friction_angle_residual"):
        assert np.array_equal(raised[name], ensemble[name])


def test_peak_is_raised_to_residual_as_often_as_two_lognormal_values_change_order():
    """P(c < c_r) = Phi((m_r - m) / sqrt(s^2 + s_r^2 - 2 rho s s_r)) of the logarithms. False alarm: 6.3e-5.

    The two means are close, for the share of cells in which a rare event happens is far from Gaussian.
    """
    close = COHESION.model_copy(update={"residual": 16e3, "residual_cov": 0.4})
    pairs = Pairs.model_validate({"cohesion": {"cohesion_residual": 0.5}})
    drawn = dict(zip(BY_NAME, draws(small_sampler(close, FRICTION, pairs=pairs)), strict=False))
    s, s_r = (sqrt(log(1.0 + cov**2)) for cov in (0.3, 0.4))
    m, m_r = log(20e3) - 0.5 * s**2, log(16e3) - 0.5 * s_r**2
    expected = norm.cdf((m_r - m) / sqrt(s**2 + s_r**2 - 2.0 * 0.5 * s * s_r))
    assert 0.2 < expected < 0.3
    raised = raised_to_floor(drawn | {"friction_angle_residual": np.full_like(drawn["cohesion"], FRICTION.residual)})
    assert_mean((raised["cohesion"] > drawn["cohesion"]).mean(axis=(1, 2)), expected)


def test_every_property_enters_an_array_of_its_own():
    assert len({row.particle_array for row in PROPERTIES}) == len(BY_NAME) == len(PROPERTIES)
