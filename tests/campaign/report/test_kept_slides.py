"""What the report draws of single slides is simulated once and found again, whole or not at all."""

import shutil

import numpy as np
import pytest
from small_campaign import run, small_scene

from campaign.report.kept_slides import OF_PARTICLES, FilmedGround, kept_slide
from campaign.report.replays import replays, shown_slides
from campaign.report.snapshots import replay
from campaign.results.results import read_results
from campaign.seeds import BASELINE
from campaign.simulation.contract import Interrupted
from campaign.simulation.ground import Ground, prepare
from campaign.simulation.realization import never
from campaign.storage.layout import SNAPSHOTS


@pytest.fixture(scope="module")
def ground():
    return prepare(small_scene())


@pytest.fixture(scope="module")
def campaign(tmp_path_factory):
    directory = tmp_path_factory.mktemp("campaign")
    run(directory, small_scene("campaign.realizations=10"))
    replays(read_results(directory), directory, simulate=True)
    return directory


def broken(*_arguments, **_keywords):
    raise RuntimeError("nobody may simulate here")


def test_a_kept_slide_is_the_simulated_one(tmp_path, ground):
    seen = replay(ground, 3)
    assert kept_slide(ground, tmp_path, 3) is None
    record = FilmedGround(ground, tmp_path).simulate(3, never)
    found = kept_slide(ground, tmp_path, 3)
    assert found.record.values["final_runout"] == record.values["final_runout"] == seen.record.values["final_runout"]
    assert (found.record.status, found.realization) == (seen.record.status, 3)
    assert found.raised_shares == seen.raised_shares
    np.testing.assert_array_equal(found.soil["cohesion"], seen.soil["cohesion"])
    for one, other in zip(found.snapshots, seen.snapshots, strict=True):
        assert (one.time, one.runout) == (other.time, other.runout)
        for name in OF_PARTICLES:
            np.testing.assert_array_equal(getattr(one, name), getattr(other, name), strict=True)


def test_slides_of_other_scenes_and_ids_are_not_taken(tmp_path, ground):
    FilmedGround(ground, tmp_path).simulate(BASELINE, never)
    (kept,) = (tmp_path / SNAPSHOTS).iterdir()
    shutil.copy(kept, kept.with_name("realization-000004.arrays"))
    assert kept_slide(ground, tmp_path, 4) is None
    other = prepare(small_scene("soil.cohesion.mean=21 kPa"))
    assert kept_slide(other, tmp_path, BASELINE) is None
    assert kept_slide(ground, tmp_path, BASELINE) is not None


def test_a_filmed_ground_is_left_like_any_other(tmp_path, ground):
    with pytest.raises(Interrupted):
        FilmedGround(ground, tmp_path).simulate(0, lambda: True)
    assert not (tmp_path / SNAPSHOTS).exists()


def test_a_second_report_simulates_nothing(campaign, monkeypatch):
    monkeypatch.setattr(Ground, "simulate", broken)
    replayed, differences = replays(read_results(campaign), campaign, simulate=True)
    assert differences == []
    assert replayed.deterministic.end.runout > replayed.deterministic.snapshots[0].runout == 0.0
    shortest, _, longest = (slide.end.runout for slide in replayed.ranked.values())
    runouts = read_results(campaign).runouts
    assert (shortest, longest) == (runouts.min(), runouts.max())


def test_a_report_that_may_not_simulate_says_what_does(campaign, tmp_path):
    shutil.copytree(campaign, tmp_path / "copy")
    results = read_results(tmp_path / "copy")
    median = shown_slides(results)["median"]
    (tmp_path / "copy" / SNAPSHOTS / f"realization-{median:06d}.arrays").write_bytes(b"")
    replayed, sentences = replays(results, tmp_path / "copy", simulate=False)
    assert replayed is None
    assert "that is what campaign report" in sentences[0]
    assert replays(results, tmp_path / "copy", simulate=True)[0] is not None
    assert replays(results, tmp_path / "copy", simulate=False)[0] is not None
