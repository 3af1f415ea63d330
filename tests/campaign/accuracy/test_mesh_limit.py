"""The limit of small cells from some meshes and cheaper models."""

import numpy as np
import pytest
from nature import CELL, HALF, LADDERS, MEAN, OWN, QUARTER, Nature

from campaign.accuracy.mesh_limit import Runs, limit_means, sampled
from campaign.statistics.intervals import mean_interval

FINEST = LADDERS[-1]
COUNTS = (20, 60, 150, 300, 300)
WHOLE = tuple(range(len(FINEST)))


def models_of(nature, counts=COUNTS):
    return sampled([nature.runs(model, n) for model, n in zip(FINEST, counts, strict=True)])


def test_by_itself_the_finest_mesh_gives_the_plain_mean():
    models = models_of(Nature(1))
    found = limit_means(models, (0,)).at(0.95)
    assert found.counted == pytest.approx(mean_interval(models[0].runout, 0.95))
    assert found.change == pytest.approx(mean_interval(models[0].runout - models[1].runout[:20], 0.95))


def test_the_total_interval_reaches_as_far_as_the_change_and_its_error():
    found = limit_means(models_of(Nature(1)), WHOLE).at(0.95)
    reach = abs(found.change.estimate)
    assert found.total.lower < found.counted.estimate - reach
    assert found.total.upper > found.counted.estimate + reach
    assert found.error == pytest.approx(
        max(found.total.upper - found.total.estimate, found.total.estimate - found.total.lower)
    )


def test_cheaper_models_narrow_the_interval_without_moving_it_away():
    alone, together = (limit_means(models_of(Nature(2)), chain).at(0.95) for chain in ((0,), WHOLE))
    assert together.counted.half_width < 0.5 * alone.counted.half_width
    assert alone.counted.lower < together.counted.estimate < alone.counted.upper


@pytest.mark.parametrize(("order", "chance"), [(1.0, 0.6), (2.0, 1.0)])
def test_intervals_hold_the_mean_on_the_mesh_and_in_the_limit(order, chance):
    """Of 100 campaigns a true 95 % is below 88 % in 1 of 400 seeds; the total interval holds more."""
    on_mesh = in_limit = 0
    for seed in range(100):
        nature = Nature(seed, order=order, chance=chance)
        found = limit_means(models_of(nature), WHOLE).at(0.95)
        on_mesh += found.counted.lower <= nature.mean(QUARTER) <= found.counted.upper
        in_limit += found.total.lower <= MEAN <= found.total.upper
    assert 0.88 <= on_mesh / 100
    assert in_limit / 100 >= 0.90


def test_a_mean_of_slides_leaves_out_what_does_not_slide():
    """Of what slides, not of all: with a probability of 60 % the mean over all would be 6 m."""
    nature = Nature(3, chance=0.6)
    found = limit_means(models_of(nature, (200, 300, 400, 500, 500)), WHOLE).at(0.95)
    assert found.counted.estimate == pytest.approx(nature.mean(QUARTER), abs=0.3)


def test_what_failed_on_one_mesh_is_left_out_of_all():
    models = [Nature(4).runs(model, n) for model, n in ((HALF, 10), (OWN, 30))]
    models[1].runout[[3, 20]] = np.nan
    fine, coarse = sampled(models)
    assert (len(fine.runout), len(coarse.runout)) == (9, 28)
    np.testing.assert_array_equal(fine.runout, np.delete(models[0].runout, 3))


def test_without_a_slide_there_is_no_limit():
    still = [Runs(np.zeros(n), np.zeros(n), np.zeros((n, 1))) for n in (10, 30)]
    assert limit_means(sampled(still), (0, 1)) is None


def test_the_cells_of_a_ladder_halve():
    for ladder in LADDERS:
        assert CELL[ladder[1]] == 2 * CELL[ladder[0]]


def test_at_the_same_cost_plain_runs_know_the_mean_on_the_mesh_far_less_well():
    """Its variance is a fifth or less of that of plain runs of the finest mesh."""
    counts = (8, 40, 150, 300, 600)
    cost = sum(n * model.cost for n, model in zip(counts, FINEST, strict=True))
    nature = Nature(6)
    together = limit_means(models_of(nature, counts), WHOLE).at(0.95).counted.half_width
    plain = 1.96 * nature.runout[QUARTER].std() / np.sqrt(cost / QUARTER.cost)
    assert together < np.sqrt(1 / 5) * plain
