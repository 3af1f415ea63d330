"""The distribution on the finest mesh, from few runs of it and many of cheaper models."""

import numpy as np
import pytest
from nature import LADDERS, MEAN, QUARTER, SCATTER, Nature
from scipy.stats import norm

from campaign.accuracy.foretold import foretold
from campaign.accuracy.mesh_limit import Runs
from campaign.statistics.intervals import quantile_interval
from campaign.statistics.proportions import exact_interval

COUNTS = (17, 48, 96, 96, 96)


def runs_of(nature, counts=COUNTS):
    return [nature.runs(model, n) for model, n in zip(LADDERS[-1], counts, strict=True)]


def plain(runouts):
    return Runs(runouts, np.ones(len(runouts)), np.zeros((len(runouts), 0)))


def test_a_model_that_tells_all_is_as_good_as_runs_on_the_finest_mesh():
    """A fine run-out that is twice the coarse one less 3 m: the interval is that of as many plain runs."""
    coarse = np.random.default_rng(1).normal(7.0, 1.0, 200)
    fine = 2.0 * coarse - 3.0
    found = foretold([plain(fine[:20]), plain(coarse)], 0.95, 0)
    assert found.n == 200
    beyond = np.count_nonzero(fine > 12.0)
    assert found.exceedance(12.0).sampling == pytest.approx(exact_interval(beyond, 200, 0.95), abs=0.01)
    assert found.quantile(0.5).sampling.estimate == pytest.approx(np.median(fine))
    ranks = quantile_interval(fine, 0.5, 0.95)
    assert found.quantile(0.5).sampling.lower <= ranks.lower + 1e-9
    assert found.quantile(0.5).sampling.upper >= ranks.upper - 1e-9


def test_what_regressions_leave_stays_in_the_distribution():
    """Of fine run-outs with a scatter of 5 m a model of 3 m tells a part: the quantiles are those of 5 m."""
    rng = np.random.default_rng(2)
    coarse = rng.normal(30.0, 3.0, 4000)
    fine = coarse + rng.normal(0.0, 4.0, 4000)
    found = foretold([plain(fine[:1000]), plain(coarse)], 0.95, 0)
    assert found.quantile(0.95).sampling.estimate == pytest.approx(30.0 + 5.0 * norm.ppf(0.95), abs=0.6)


def test_what_never_came_so_far_is_no_more_certain_than_of_so_many_plain_runs():
    found = foretold(runs_of(Nature(3)), 0.95, 0).exceedance(40.0)
    assert found.sampling == exact_interval(0, 96, 0.95)
    assert found.total.upper >= found.sampling.upper


def test_a_quantile_that_so_many_plain_runs_do_not_bound_is_not_bounded():
    """A 95 % quantile needs 72 slides."""
    few = np.random.default_rng(5).normal(10.0, 1.0, 60)
    found = foretold([plain(few[:20]), plain(few)], 0.95, 0).quantile(0.95)
    assert np.isnan(found.sampling.upper)
    assert np.isnan(found.total.upper)
    assert np.isfinite(found.sampling.lower)


def test_the_total_interval_holds_both_limits():
    """A halving that takes 1 m off each run-out: the median may be 1 m lower or higher."""
    coarse = np.random.default_rng(4).normal(10.0, 1.0, 300)
    found = foretold([plain(coarse[:40] - 1.0), plain(coarse)], 0.95, 0).quantile(0.5)
    assert found.total.lower < found.sampling.estimate - 1.0
    assert found.total.upper > found.sampling.estimate + 1.0


def test_the_same_campaign_says_the_same():
    one, other = (foretold(runs_of(Nature(5)), 0.95, 7).exceedance(11.0) for _ in range(2))
    assert one == other


def test_slides_cut_short_widen_the_intervals_upwards():
    """Two of 96 may have come any distance: two per cent more beyond it, and a quantile of two per cent more."""
    whole = runs_of(Nature(6))
    short = [*whole[:2], whole[2]._replace(cut_short=2), *whole[3:]]
    closed, opened = foretold(whole, 0.95, 0), foretold(short, 0.95, 0)
    least, most = closed.exceedance(11.0).total, opened.exceedance(11.0).total
    assert most[:2] == least[:2]
    assert most.upper == pytest.approx(least.upper + 2 / 96)
    assert opened.quantile(0.5).total.upper == closed.quantile(0.5 + 2 / 96).total.upper


def test_too_few_pairs_and_many_slides_cut_short_foretell_nothing():
    whole = runs_of(Nature(6))
    assert foretold([whole[0]._replace(cut_short=1), *whole[1:]], 0.95, 0) is None
    still = [Runs(np.zeros(n), np.zeros(n), np.zeros((n, 1))) for n in (10, 30)]
    assert foretold(still, 0.95, 0) is None


@pytest.mark.slow
@pytest.mark.parametrize("chance", [1.0, 0.6])
def test_intervals_hold_on_the_mesh_and_in_the_limit(chance):
    """Of 200 campaigns a true 95 % is below 90 % in 1 of 500 seeds."""
    campaigns = 200
    held = np.zeros((3, 2))
    for seed in range(campaigns):
        nature = Nature(seed, chance=chance)
        found = foretold(runs_of(nature), 0.95, seed)
        for row, distance in enumerate((9.0, 11.5)):
            on_mesh, in_limit = (chance * norm.sf((distance - mean) / SCATTER) for mean in (nature.mean(QUARTER), MEAN))
            given = found.exceedance(distance)
            held[row] += holds(given.sampling, on_mesh), holds(given.total, in_limit)
        median = found.quantile(0.5)
        held[2] += holds(median.sampling, nature.mean(QUARTER)), holds(median.total, MEAN)
    assert np.all(held / campaigns >= 0.90), held / campaigns


def holds(interval, truth):
    return interval.lower <= truth <= interval.upper


def test_the_interval_is_half_as_wide_as_that_of_the_finest_runs_alone():
    widths = []
    for seed in range(5):
        nature = Nature(seed)
        found = foretold(runs_of(nature), 0.95, seed).exceedance(10.0).sampling.half_width
        alone = exact_interval(np.count_nonzero(nature.runout[QUARTER][: COUNTS[0]] > 10.0), COUNTS[0], 0.95).half_width
        widths.append(found / alone)
    assert np.mean(widths) < 0.6
