"""Variants of a scene run the same realizations, once, and as long as the budget lasts."""

import math

import pytest
from small_campaign import small_scene
from stand_in import StandIn, prepare

from campaign.exit_codes import ExitCode
from campaign.running.campaign_directory import opened
from campaign.running.crew import Alone
from campaign.running.means import means_of
from campaign.running.side_run import Stopped
from campaign.running.stop_request import StopRequest
from campaign.running.study import OWN, Study, directory_of, leading, named
from campaign.scene.cost import realization_seconds
from campaign.storage import manifest

AMPLE = 1e9  # s of core time; the stand-in's realizations say that they take as long as the whole process has taken
FINER = "numerics.cell=1 m"


@pytest.fixture
def stop():
    return StopRequest()


@pytest.fixture
def directory(tmp_path):
    with opened(small_scene(), tmp_path / "study", 1) as directory:
        yield directory


@pytest.fixture
def study_of(directory, stop):
    def study(realizations, budget=AMPLE, prepare=prepare):
        return Study(directory.scene, realizations, budget, means_of(directory, prepare, Alone(stop), stop))

    return study


def runouts(outcome, count):
    return [outcome.tally.summaries[k].final_runout for k in range(count)]


def test_all_variants_run_the_same_realizations(study_of):
    """The stand-in's run-out grows by 2 m for a metre less of cell, from one to the next by a tenth more."""
    study = study_of(3)
    own, finer = study.run(), study.run(FINER)
    assert own.name == OWN
    assert finer.name == "numerics.cell = 1 m"
    shifts = [there - here for there, here in zip(runouts(finer, 3), runouts(own, 3), strict=True)]
    assert shifts == pytest.approx([2.0, 2.2, 2.4])


def test_what_has_been_run_is_read(study_of):
    """Whoever asks again, for more: two of three are there."""
    asked = []

    class Watched(StandIn):
        def simulate(self, realization, interrupt):
            asked.append((self.scene.numerics.cell, realization))
            return super().simulate(realization, interrupt)

    before = study_of(2).run(FINER)
    after = study_of(3, prepare=lambda scene, _: Watched(scene)).run(FINER)
    assert {each for each in asked if each[1] >= 0} == {(1.0, 2)}
    assert runouts(after, 2) == runouts(before, 2)


def test_what_exceeds_the_budget_is_left_out_and_said(study_of):
    scene = small_scene()
    one = realization_seconds(scene)
    outcome = study_of(3, budget=2 * one).run()
    assert outcome.tally is None
    assert outcome.why_not.startswith("left out: about")
    assert outcome.seconds == one


def test_what_was_run_counts_against_the_budget_and_stays_when_it_is_used_up(study_of):
    study_of(3).run()
    study = study_of(3, budget=1e-6)
    assert study.run().tally is not None
    assert study.run(FINER).why_not.endswith("and 0 s left")


def test_no_valid_scene_is_no_outcome(study_of):
    outcome = study_of(3).run("numerics.cell=-1 m")
    assert outcome.tally is None
    assert "numerics.cell" in outcome.why_not
    assert math.isnan(outcome.seconds)


def test_who_asks_for_an_end_ends_the_study(study_of, stop):
    stop.drain = True
    with pytest.raises(Stopped, match="asked to stop"):
        study_of(3).run()


def test_a_study_says_how_it_ended(directory, stop):
    def lead(study):
        return leading(prepare, lambda _, means: study(means))(directory, Alone(stop), stop)

    assert lead(lambda means: "all is known") is ExitCode.DONE
    assert manifest.read(directory.path)["end"]["verdict"] == "all is known"

    def interrupted(means):
        raise Stopped("asked to stop")

    assert lead(interrupted) is ExitCode.RESUMABLE
    assert manifest.read(directory.path)["end"]["verdict"] == "stopped early (asked to stop)"


def test_changes_are_named_as_they_are_written():
    assert named(("numerics.basis=linear", "numerics.courant=0.2")) == "numerics.basis = linear, numerics.courant = 0.2"


def test_directories_of_long_changes_differ_and_fit_a_file_system(tmp_path):
    many = tuple(f"soil.cohesion.mean={k} kPa" for k in range(30))
    one, other = directory_of(tmp_path, many), directory_of(tmp_path, (*many[:-1], "soil.cohesion.mean=99 kPa"))
    assert one != other
    assert len(one.name) < 200
    assert directory_of(tmp_path, (FINER,)).name == "numerics.cell-1-m"
