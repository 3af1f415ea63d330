"""Fields that honour borings: exact at the data, and elsewhere what kriging of all properties together says."""

from math import log1p, radians, sqrt

import numpy as np
import pytest
from soil_fields import DEVIATIONS

from campaign.accuracy.field_control import deviations
from campaign.errors import SamplerError
from campaign.scene import load_scene
from campaign.scene.ground_surface import surface_of
from campaign.seeds import BASELINE
from campaign.simulation.field_summary import box_map
from campaign.simulation.ground import strengths_of
from campaign.simulation.scene_sampler import refuse_crowded_data

DRAWS = 500
COARSE = ("numerics.cell=2 m", "field.resolution=0.5 m")
BORINGS = """boring=[
    {name="B1", x="22.3 m", cohesion=[["1.6 m", "18 kPa"], ["4.6 m", "23 kPa"]], friction_angle=[["1.6 m", "11 deg"]]},
    {name="B2", x="45.3 m", by="elevation", cohesion=[["1 m", "19 kPa"]]},
]""".replace("\n", "")
NOISY = BORINGS.replace('name="B1"', 'name="B1", noise=0.05')
X, Y = np.array([22.3, 22.3, 45.3]), np.array([15.1, 12.1, 1.0])
COHESION, FRICTION = np.array([18e3, 23e3, 19e3]), radians(11.0)
CLAY = 'layer=[{name="clay", top="7.3 m", cohesion={mean="30 kPa", cov=0.2}}]'
IN_CLAY = 'boring=[{name="B1", x="10 m", by="elevation", cohesion=[["6.6 m", "40 kPa"]]}]'


def bored(*overrides, borings=BORINGS):
    return load_scene("ma2023", [*COARSE, borings, *overrides])


@pytest.mark.parametrize(
    "field",
    [
        (),
        ("field.angle=20 deg",),
        ("field.sampler=cholesky", "field.resolution=1 m"),
        ("field.correlation=squared-exponential", "field.sampler=kronecker"),
        ("soil.cohesion.gradient=1 kPa/m",),
        ("soil.cohesion.residual_cov=0.2", "field.pairs.cohesion.cohesion_residual=0.5"),
    ],
    ids=["circulant", "turned", "cholesky", "kronecker", "trend", "three properties"],
)
@pytest.mark.parametrize("realization", [0, 7, BASELINE])
def test_fields_pass_through_the_data(field, realization):
    drawn = strengths_of(bored(*field), realization).at(X, Y)
    np.testing.assert_allclose(drawn["cohesion"], COHESION, rtol=1e-9)
    np.testing.assert_allclose(drawn["friction_angle"][0], FRICTION, rtol=1e-9)


def kriged(x, y, noise):
    """Return mean and variance of ln cohesion and ln friction angle at places, by the formula of conditional Gaussians.

    With the joint covariance of both properties at all places written out: C_cc = C_pp = C, C_cp = -0.5 C.
    """
    centre = np.floor(np.array([[22.3, 15.1], [22.3, 12.1], [45.3, 1.0], [22.3, 15.1]]) / 0.5) * 0.5 + 0.25
    places = np.concatenate([centre, np.tile(np.array([x, y]).T, (2, 1))])
    kinds = np.repeat([0, 1, 0, 1], [3, 1, len(x), len(x)])
    s = sqrt(log1p(0.1**2))
    error = np.array([noise, noise, 0.0, noise])
    lag = places[:, None] - places
    joint = np.where(kinds[:, None] == kinds, 1.0, -0.5) * np.exp(-np.hypot(lag[..., 0] / 20.0, lag[..., 1] / 2.0))
    values = np.array([18e3 / 20e3, 23e3 / 20e3, 19e3 / 20e3, 11.0 / 10.0])
    ln_error = np.log1p(error**2)
    z = (np.log(values) + ln_error / 2.0 + s**2 / 2.0) / s
    data = joint[:4, :4] + np.diag(ln_error) / s**2
    weights = np.linalg.solve(data, joint[:4, 4:]).T
    mean, variance = weights @ z, 1.0 - np.sum(weights * joint[4:, :4], axis=1)
    return s * mean.reshape(2, -1) - s**2 / 2.0, s**2 * variance.reshape(2, -1)


@pytest.mark.parametrize(("borings", "noise"), [(BORINGS, 0.0), (NOISY, 0.05)], ids=["exact", "noisy"])
def test_mean_and_variance_elsewhere_are_those_of_cokriging(borings, noise):
    """500 draws at six places. False alarm: 6.3e-5 for each of 24 moments, so 1 in 660 for each case.

    The third place is that of B1 with noise, which the fields then do not pass through.
    """
    x, y = np.array([22.25, 23.25, 22.25, 30.25, 44.25, 70.25]), np.array([13.75, 15.25, 15.25, 8.25, 1.75, 3.25])
    if not noise:
        x[2] += 4.0
    scene = bored(borings=borings)
    drawn = np.array([[*strengths_of(scene, k).at(x, y).values()] for k in range(DRAWS)])
    means, variances = kriged(x, y, noise)
    ln = np.log(drawn / np.array([20e3, radians(10.0)])[:, None])
    for moment, expected in ((ln, means), ((ln - means) ** 2, variances)):
        error = moment.std(axis=0, ddof=1) / sqrt(DRAWS)
        assert np.all(np.abs(moment.mean(axis=0) - expected) < DEVIATIONS * error)


def test_mean_strengths_are_the_means_given_the_data():
    """exp(mean + variance / 2) of the logarithm; so far away the mean of the scene."""
    x, y = np.array([22.25, 23.25, 70.25]), np.array([13.75, 15.25, 18.25])
    mean, variance = kriged(x, y, 0.0)
    field = strengths_of(bored(), BASELINE)
    expected = 20e3 * np.exp(mean + variance / 2.0)[0]
    np.testing.assert_allclose(field.at(x, y)["cohesion"], expected, rtol=1e-12)
    far = strengths_of(bored("field.horizontal=4 m"), BASELINE).at(np.array([74.0]), np.array([3.0]))["cohesion"]
    assert far == pytest.approx(20e3, rel=1e-3)


def test_data_in_a_layer_are_of_its_distribution_and_of_the_field_that_it_has():
    """Below, a shared field has the data above as well; one of its own has them alone."""
    x, y = np.array([10.0, 10.0]), np.array([6.6, 7.6])
    own, alone = (
        bored(CLAY, "layer.1.field=own", borings=IN_CLAY),
        bored(CLAY, "layer.1.field=own", borings="boring=[]"),
    )
    shared, free = bored(CLAY, borings=IN_CLAY), bored(CLAY, borings="boring=[]")
    layer = np.array([1, 0])
    read = {
        name: strengths_of(scene, 3).at(x, y, layer)["cohesion"]
        for name, scene in (("own", own), ("alone", alone), ("shared", shared), ("free", free))
    }
    assert read["own"][0] == pytest.approx(40e3, rel=1e-9)
    assert read["shared"][0] == pytest.approx(40e3, rel=1e-9)
    assert read["own"][1] == read["alone"][1]
    assert read["shared"][1] != read["free"][1]


def test_values_in_one_cell_count_as_their_mean():
    """Of logarithms, 19 kPa: a profile is read every few centimetres, and the field has one value in a cell."""
    two = (
        'boring=[{name="CPT", x="10.2 m", cohesion=[["2.1 m", "19 kPa"], ["2.2 m", "20 kPa"], ["2.3 m", "18.05 kPa"]]}]'
    )
    drawn = strengths_of(bored(borings=two), 3).at(np.array([10.2]), np.array([16.8]))["cohesion"]
    assert drawn == pytest.approx(19e3, rel=1e-9)


def test_data_that_follow_from_others_are_refused():
    """A smooth field over 20 m leaves nothing open between values half a metre apart; with noise it does."""
    values = ", ".join(f'["{0.5 * k} m", "{20 + k % 2} kPa"]' for k in range(1, 20))
    smooth = "field.correlation=squared-exponential", "field.vertical=20 m"
    dense = f'boring=[{{name="CPT", x="10 m", cohesion=[{values}]}}]'
    with pytest.raises(SamplerError, match="some follow from the others; give the borings a noise"):
        refuse_crowded_data(bored(*smooth, borings=dense))
    strengths_of(bored(*smooth, borings=dense.replace('name="CPT"', 'name="CPT", noise=0.05')), 0)


@pytest.mark.parametrize("more", [(), (CLAY, "layer.1.field=own"), ("soil.cohesion.gradient=1 kPa/m",)])
def test_the_known_mean_of_a_map_is_that_given_the_data(more):
    """Deviations from it have the mean 0 that the accuracy of a mean rests on. False alarm: 6.3e-5 a box."""
    scene = bored(*more, borings=NOISY)
    fields = [strengths_of(scene, k) for k in range(80)]
    boxes = box_map(surface_of(scene.geometry), fields[0].grid)
    found = deviations(np.array([boxes.means(field) for field in fields]), scene)
    error = found.std(axis=0, ddof=1) / sqrt(80.0)
    assert np.mean(np.abs(found.mean(axis=0)) < DEVIATIONS * error) > 0.99


def test_borings_leave_other_realizations_and_the_identity_of_other_scenes_as_they_were():
    none = load_scene("ma2023", [*COARSE, "boring=[]"])
    assert none.digest() == load_scene("ma2023", COARSE).digest()
    assert bored().digest() != none.digest()
