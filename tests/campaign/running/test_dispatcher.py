"""Realizations are handed out once, in order, and only while they fit."""

from tallies import filled, summary

from campaign.running.dispatcher import Dispatcher
from campaign.seeds import BASELINE
from campaign.statistics.tally import Fault, RankReport


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


def fault(realization, retires=False):
    return RankReport(None, "", Fault(realization, f"no memory for {realization}", retires))


def test_what_a_machine_could_not_compute_is_handed_out_last_again():
    dispatcher = Dispatcher(filled([BASELINE], maximum=3), lambda _longest: "")
    assert dispatcher.exchange(RankReport(None)) == 0
    assert dispatcher.exchange(fault(0)) == 1
    assert dispatcher.exchange(RankReport(summary(1))) == 2
    assert dispatcher.exchange(RankReport(summary(2))) == 0
    assert dispatcher.stopped == ""
    assert dispatcher.exchange(RankReport(summary(0))) is None
    assert dispatcher.stopped == ""


def test_a_rank_that_retires_leaves_its_work_to_others_and_without_others_the_campaign_stops():
    dispatcher = Dispatcher(filled([BASELINE], maximum=3), lambda _longest: "")
    assert [dispatcher.exchange(RankReport(None)) for _ in range(2)] == [0, 1]
    assert dispatcher.exchange(fault(1, retires=True)) is None
    assert dispatcher.stopped == "no memory for 1"
    assert dispatcher.exchange(RankReport(summary(0))) == 2
    assert dispatcher.exchange(fault(2, retires=True)) is None
    assert dispatcher.stopped == "no memory for 2"
