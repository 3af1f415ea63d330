"""Realizations are handed out once, in order, and only while they fit."""

from tallies import filled

from campaign.running.dispatcher import Dispatcher
from campaign.seeds import BASELINE
from campaign.statistics.tally import RankReport


def test_missing_ids_are_handed_out_once_and_the_baseline_first():
    dispatcher = Dispatcher(filled([0, 2], maximum=5), lambda _longest: "")
    assert [dispatcher.exchange(RankReport(None)) for _ in range(5)] == [BASELINE, 1, 3, 4, None]
    assert dispatcher.stopped == ""


def test_a_problem_on_one_rank_stops_all():
    dispatcher = Dispatcher(filled([], maximum=5), lambda _longest: "")
    assert dispatcher.exchange(RankReport(None, "the disk is full")) is None
    assert dispatcher.exchange(RankReport(None)) is None
    assert dispatcher.stopped == "the disk is full"


def test_nothing_is_started_that_does_not_fit_into_the_job():
    dispatcher = Dispatcher(filled([BASELINE, 0]), lambda longest: "no time" if longest >= 1.0 else "")
    assert dispatcher.exchange(RankReport(None)) is None
