"""The account of a campaign does not depend on the order in which realizations finish."""

import numpy as np
import pytest
from tallies import filled, outcome

from campaign.seeds import BASELINE


@pytest.mark.parametrize("seed", range(5))
def test_the_result_does_not_depend_on_the_order_of_arrival(seed):
    straight = filled([BASELINE, *range(200)])
    shuffled = filled(np.random.default_rng(seed).permutation(np.arange(-1, 200)).tolist())
    assert straight.size == shuffled.size == 70
    assert straight.history().verdict == shuffled.history().verdict


def test_nothing_is_decided_before_the_baseline():
    assert filled(range(200)).size is None


def test_a_gap_ends_the_prefix():
    tally = filled([BASELINE, *range(15), *range(16, 90)])
    assert (tally.prefix, tally.done, tally.size) == (15, 89, None)
    tally.add(outcome(15))
    assert tally.size == 70


def test_the_maximum_ends_a_campaign_without_convergence():
    tally = filled([BASELINE, *range(4)], maximum=4)
    assert tally.size == 4
    assert tally.history().converged_at is None


def test_ids_beyond_the_maximum_stay_out():
    assert filled([BASELINE, 7, *range(4)], maximum=4).done == 4


def test_too_many_failures_are_noticed_at_the_first_checkpoint():
    tally = filled([BASELINE, *range(60)], failing=range(5, 8))
    assert (tally.size, tally.too_many_failed) == (20, True)
