"""The numbers of realizations are those of least cost."""

import math
from itertools import product

import numpy as np
import pytest

from campaign.accuracy.allocation import allocation

SCATTER, COST = (0.3, 0.5, 4.0), (20.0, 3.0, 0.2)


def cost_of(numbers):
    return sum(n * c for n, c in zip(numbers, COST, strict=True))


def variance_of(numbers):
    return sum(v / n for v, n in zip(SCATTER, numbers, strict=True))


def test_the_wanted_variance_is_met():
    assert variance_of(allocation(SCATTER, COST, 0.1, (4, 4, 4))) <= 0.1


def test_no_other_numbers_cost_less_by_more_than_rounding():
    found = allocation(SCATTER, COST, 0.2, (1, 1, 1))
    others = (each for each in product(range(1, 12), range(1, 40), range(1, 200)) if list(each) == sorted(each))
    least = min(cost_of(each) for each in others if variance_of(each) <= 0.2)
    assert cost_of(found) <= least + sum(COST)


def test_large_numbers_are_in_proportion_to_the_root_of_scatter_over_cost():
    found = np.array(allocation(SCATTER, COST, 1e-5, (4, 4, 4)))
    shares = found / np.sqrt(np.divide(SCATTER, COST))
    np.testing.assert_allclose(shares, shares[0], rtol=1e-3)


def test_what_has_run_already_counts():
    least = (30, 40, 50)
    found = allocation(SCATTER, COST, 0.1, least)
    assert found[0] == 30
    assert found[1] == 40
    assert found[2] == math.ceil(4.0 / (0.1 - 0.3 / 30 - 0.5 / 40))


def test_no_model_runs_more_than_a_cheaper_one():
    assert allocation((1.0, 0.0), (1.0, 1.0), 0.1, (4, 4)) == (10, 10)


@pytest.mark.parametrize("scatter", [(0.0, 0.0), (0.0, 1e-30)])
def test_without_scatter_nothing_more_is_run(scatter):
    assert allocation(scatter, (1.0, 1.0), 0.01, (5, 7)) == (5, 7)
