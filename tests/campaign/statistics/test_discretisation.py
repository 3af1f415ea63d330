"""The discretisation error is what half the cell changes in the same realizations."""

import numpy as np
import pytest
from small_campaign import small_scene
from tallies import summary_of

from campaign.record import Status
from campaign.scene import load_scene
from campaign.scene.softening import softening_rate
from campaign.seeds import BASELINE
from campaign.simulation.ground import prepare
from campaign.statistics.discretisation import Discretisation, estimate, with_half_cell
from campaign.statistics.tally import tally_of


def account(scene, runouts, **statuses):
    tally = tally_of(scene)
    for k, runout in enumerate(runouts, start=BASELINE):
        tally.add(summary_of(k, runout, statuses.get(f"_{k}", Status.slid)))
    return tally


@pytest.fixture(scope="module")
def scene():
    return small_scene("campaign.realizations=12")


def test_half_the_cell_keeps_the_rest(scene):
    half = with_half_cell(scene, 3)
    assert half.numerics == scene.numerics.model_copy(update={"cell": 1.0})
    assert (half.geometry, half.soil, half.field, half.campaign.seed) == (
        scene.geometry,
        scene.soil,
        scene.field,
        scene.campaign.seed,
    )


def test_half_the_cell_halves_the_rate_of_local_softening():
    scene = load_scene("ma2023-printed")
    half = with_half_cell(scene, 3)
    assert softening_rate(half) == softening_rate(scene) / 2


def test_a_realization_is_the_same_ground_on_both_meshes(scene):
    here, there = (prepare(each).draw(2) for each in (scene, with_half_cell(scene, 3)))
    assert here.grid == there.grid
    assert here.names == there.names
    np.testing.assert_array_equal(here.values, there.values)


def test_only_pairs_of_which_both_count_enter(scene):
    coarse = account(scene, [9.0, 10.0, 11.0, 12.0, 13.0, 14.0], _1=Status.crashed)
    fine = account(
        with_half_cell(scene, 5), [9.5, 11.0, 12.0, 14.0, 0.0, 14.5], _3=Status.no_slide, _4=Status.reached_wall
    )
    found = estimate(scene, coarse, fine, range(5))
    np.testing.assert_array_equal(found.differences, [1.0, np.nan, 2.0, np.nan, np.nan])
    assert (found.error, found.interval.n, found.deterministic) == (1.5, 2, 0.5)
    assert (found.repeated, found.standing) == (5, 1)


def test_what_was_not_repeated_is_no_pair(scene):
    """The account of half the cell holds with their own cells the realizations that are not repeated."""
    coarse = account(scene, [9.0, 10.0, 11.0, 0.0, 13.0], _2=Status.no_slide)
    fine = account(with_half_cell(scene, 4), [9.5, 10.0, 12.0, 0.0, 14.0], _2=Status.no_slide)
    found = estimate(scene, coarse, fine, {BASELINE, 1, 3})
    np.testing.assert_array_equal(found.differences, [np.nan, 1.0, np.nan, 1.0])
    assert (found.repeated, found.standing) == (2, 0)


def test_the_estimate_is_a_size_and_the_change_has_a_sign():
    """Student's t of 95 % and 3 degrees of freedom is 3.182: -1 +- 3.182 sqrt(1/15) = -1.82 to -0.18 m."""
    found = Discretisation(1.0, np.array([-0.4, -1.6, -0.8, -1.2]), -0.5, 0.95)
    assert found.error == pytest.approx(1.0)
    assert found.interval == pytest.approx((-1.0, -1.82, -0.18, 4, False), abs=0.005)


@pytest.mark.parametrize("differences", [[], [np.nan], [0.5]])
def test_too_few_pairs_are_no_interval(differences):
    assert not Discretisation(1.0, np.array(differences, dtype=float), 0.0, 0.95).interval.is_known
