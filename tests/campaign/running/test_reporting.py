"""The report at the end of a campaign: its slides are simulated by the crew, and a signal breaks it off."""

import math
import os
import signal
import time

import pytest
from small_campaign import small_scene

from campaign import run
from campaign.record import SLID
from campaign.report import replays
from campaign.results.results import read_results
from campaign.running import reporting
from campaign.running.reporting import draw_report
from campaign.running.side_run import Means
from campaign.running.stop_request import BrokenOff, StopRequest, listening
from campaign.running.worker import Interrupt
from campaign.storage.layout import REPORT, SNAPSHOTS

SCENE = small_scene("campaign.realizations=10", "campaign.discretisation_pairs=0", "campaign.sensitivity_pairs=0")


@pytest.fixture(scope="module")
def campaign(tmp_path_factory):
    directory = tmp_path_factory.mktemp("campaign") / "out"
    run(SCENE, directory, report=True)
    return directory


def never_asked(*_arguments, **_keywords):
    raise AssertionError("nothing may be simulated")


def test_the_slides_are_kept_before_the_page_is_drawn(campaign):
    results = read_results(campaign)
    assert results.has_status(SLID).all()
    kept = {path.name for path in (campaign / SNAPSHOTS).glob("*.arrays")}
    shortest, longest = (results.ranked(share) for share in (0, 1))
    assert kept >= {"baseline.arrays", f"realization-{shortest:06d}.arrays", f"realization-{longest:06d}.arrays"}
    assert len(kept) == 4
    assert (campaign / REPORT).read_text("utf-8").count('class="film"') == 2


def test_the_same_command_again_simulates_no_slide(campaign, capsys, monkeypatch):
    monkeypatch.setattr("campaign.simulation.ground.Ground.simulate", never_asked)
    monkeypatch.setattr("campaign.report.page.write_report", lambda home, _simulate: home / REPORT)
    run(SCENE, campaign, report=True)
    said = capsys.readouterr().out
    assert "slides again" not in said
    assert "Report: " in said


def drawn(directory, stopped="", write_report=lambda home, _simulate: home / REPORT):
    """Draw the report of a campaign without a crew."""
    means = Means(directory, never_asked, never_asked, stopped)
    with listening() as request:
        draw_report(None, means, request, write_report)


def test_a_campaign_that_stopped_early_has_a_report_and_simulates_no_slide(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(reporting, "_simulate_slides", never_asked)
    allowed = []
    drawn(tmp_path, "asked to stop", write_report=lambda home, simulate: allowed.append(simulate) or home / REPORT)
    assert allowed == [False]
    assert f"Report: {tmp_path / REPORT}" in capsys.readouterr().out


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGUSR1, signal.SIGINT])
def test_a_signal_breaks_the_drawing_off(tmp_path, capsys, monkeypatch, number):
    monkeypatch.setattr(reporting, "_simulate_slides", lambda *_: None)

    def draw(_home, _simulate):
        os.kill(os.getpid(), number)
        time.sleep(30)

    begin = time.monotonic()
    drawn(tmp_path, write_report=draw)
    assert time.monotonic() - begin < 2
    assert f"It is made by: campaign report {tmp_path}" in capsys.readouterr().out


def test_who_asks_for_an_end_while_slides_are_simulated_gets_no_report(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(reporting, "_simulate_slides", lambda *_: os.kill(os.getpid(), signal.SIGTERM))
    drawn(tmp_path, write_report=never_asked)
    assert "The report is left out, as asked to stop" in capsys.readouterr().out


def test_what_goes_wrong_is_told_and_nothing_more(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(reporting, "_simulate_slides", lambda *_: None)
    drawn(tmp_path, write_report=never_asked)
    assert "The report could not be made (AssertionError('nothing may be simulated'))" in capsys.readouterr().out


def test_outside_a_signal_sets_flags_alone():
    stop = StopRequest()
    with pytest.raises(BrokenOff), stop.breaking_off():
        stop.receive(signal.SIGTERM)
    stop.receive(signal.SIGTERM)
    assert stop.drain


@pytest.mark.parametrize("breaks_off", [True, False])
def test_the_first_request_leaves_a_slide_that_is_only_drawn(breaks_off):
    stop = StopRequest()
    interrupt = Interrupt(stop, math.inf, math.inf, lambda: None, breaks_off)
    interrupt.restart()
    assert not interrupt()
    stop.receive(signal.SIGUSR1)
    assert interrupt() == breaks_off


def test_the_slides_shown_are_those_the_page_draws(campaign):
    results = read_results(campaign)
    page = replays.replays(results, campaign, simulate=False)[0]
    shown = replays.shown_slides(results)
    assert {called: slide.realization for called, slide in page.ranked.items()} | {"deterministic": -1} == shown
