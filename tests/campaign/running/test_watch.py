"""A realization that does not come back is noticed, whatever else goes on."""

import pytest

from campaign.running.watch import GRACE, HungError, Watch


@pytest.fixture
def scene():
    """A watch over realizations of 100 s at most, its clock, and what is held against realizations."""
    clock, held = [0.0], []
    return Watch(100.0, lambda *what: held.append(what), lambda: clock[0]), clock, held


def test_who_comes_back_in_time_is_let_be(scene):
    watch, clock, held = scene
    for step in range(20):
        watch.begins(0, step)
        watch.begins(1, 100 + step)
        clock[0] += 110.0 + GRACE
        watch.look()
    watch.begins(1, None)
    watch.begins(0, None)
    clock[0] += 1e6
    watch.look()
    assert held == []


def test_who_does_not_is_named_with_its_realization(scene):
    watch, clock, held = scene
    watch.begins(0, 3)
    watch.begins(1, 4)
    clock[0] += 110.0 + GRACE
    watch.begins(0, 5)
    clock[0] += 1.0
    with pytest.raises(HungError, match="Rank 1 does not come back from realization 4, begun 411 s ago"):
        watch.look()
    assert held == [(1, 4, "no answer within 410 s")]
