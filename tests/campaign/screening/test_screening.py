"""Choices are judged on the same ground, and what may be dropped is dropped together before anybody is told so."""

import csv
import io
import math

import numpy as np
import pytest
import xarray as xr
from small_campaign import small_scene
from stand_in import prepare

from campaign import cli
from campaign.errors import RefusalError
from campaign.record import Record, Status, summarize
from campaign.report.figures.style import in_style
from campaign.running.campaign_directory import opened
from campaign.running.crew import Alone
from campaign.running.means import means_of
from campaign.running.stop_request import StopRequest
from campaign.running.study import Outcome, directory_of
from campaign.scene import load_scene
from campaign.scene.cost import particle_count, realization_seconds, speed
from campaign.scene.loading import scene_of
from campaign.screening import effects as law
from campaign.screening import screen as whole
from campaign.screening.chart import COLOURS, chart
from campaign.screening.choices import Choice
from campaign.screening.screen import screen
from campaign.screening.screening import Combination, Screened, Screening
from campaign.screening.simplified import HEADER, refuse_to_overwrite, simplified_scene, write_simplified
from campaign.screening.table import as_csv, as_dataset, table
from campaign.screening.verdict import Verdict, verdict_of
from campaign.simulation.quantities import UNITS
from campaign.statistics.tally import tally_of
from campaign.storage.record_store import RecordStore

AMPLE = 1e9  # s of core time; the stand-in's realizations say that they take as long as the whole process has taken
ROAD = 'receptor=[{name = "road", x = "46 m"}]'

UNCORRELATED = Choice("cross-correlation", "none", ("field.cross_correlation=0",))
SOFTER = Choice("modulus 100 MPa", "25 MPa", ("soil.young_modulus=25 MPa",))
COARSER = Choice("cells of 2 m", "3 m", ("numerics.cell=3 m", "geometry.slope.foundation=6 m"))
RAMP = Choice('gravity "release"', '"ramp"', ("numerics.gravity=ramp",), simplifies=False)
IMPOSSIBLE = Choice("crest of 20 m", "0 m", ("geometry.slope.crest=0 m",), redraws=True)


@pytest.fixture
def screened(tmp_path, monkeypatch):
    """Screen the stand-in, to which correlation and modulus are nothing; a metre of cell is -2 m, the ramp 0.6 m.

    Eight pairs that do not change bound a probability to 3.84 / 11.84 = 32 points.
    """
    monkeypatch.setattr(law, "POINTS", 0.35)

    def screened(*choices, budget=AMPLE, scene=None):
        monkeypatch.setattr(whole, "choices_of", lambda _: choices)
        scene, stop = scene or small_scene(), StopRequest()
        with opened(scene, tmp_path / "study", 1) as directory:
            return screen(scene, 8, budget, means_of(directory, prepare, Alone(stop), stop))

    return screened


def test_every_choice_is_judged_by_what_it_changes(screened):
    found = screened(UNCORRELATED, COARSER, RAMP)
    assert [each.verdict for each in found.choices] == [Verdict.DROP, Verdict.KEEP, Verdict.KEEP]
    ramp = found.choices[2].effects[0]
    assert ramp.difference.interval[:3] == pytest.approx((0.6, 0.6, 0.6))
    assert [each.choice for each in found.ranked] == [COARSER, RAMP, UNCORRELATED]
    assert found.advice.startswith('Keep: cells of 2 m and gravity "release". May drop: cross-correlation.')


def test_what_may_be_dropped_is_run_once_more_all_at_once(screened):
    found = screened(UNCORRELATED, COARSER, SOFTER)
    (at_once,) = found.together
    assert at_once.screened.choice.changes == (*UNCORRELATED.changes, *SOFTER.changes)
    assert at_once.screened.verdict is Verdict.DROP
    assert found.simplified is at_once
    assert at_once.members == (UNCORRELATED, SOFTER)


def test_what_is_merely_different_stays_as_it_is(screened):
    found = screened(UNCORRELATED, RAMP._replace(changes=("numerics.courant=0.7",)))
    assert [each.verdict for each in found.choices] == [Verdict.DROP, Verdict.DROP]
    assert found.choices[1].remark == "may drop: either will do"
    assert found.droppable == found.choices[:1]
    assert found.simplified.screened is found.choices[0]


def test_what_the_budget_leaves_out_is_not_known_and_not_dropped(screened):
    found = screened(UNCORRELATED, SOFTER, budget=8.01 * realization_seconds(small_scene()))
    assert [each.verdict for each in found.choices] == [Verdict.OPEN, Verdict.OPEN]
    assert "left out: about" in found.choices[0].remark
    assert found.simplified is None


def test_an_impossible_scene_is_said(screened):
    (found,) = screened(IMPOSSIBLE).choices
    assert found.verdict is Verdict.OPEN
    assert "no valid scene" in found.remark


def test_a_scene_that_was_not_run_is_refused(screened):
    with pytest.raises(RefusalError, match="The scene itself was not run: left out"):
        screened(UNCORRELATED, budget=1e-6)


def test_what_breaks_the_model_is_kept(made_up):
    """Forty of eighty fail without it: 50 points more, at least 40 (Tango)."""
    own = made_up.own
    fails = np.arange(80) < 40
    there = own._replace(runouts=np.where(fails, math.nan, own.runouts), is_spoiled=fails)
    broken = Screened(UNCORRELATED, there, law.effects_of(made_up.scene, own, there), law.spoiled(own, there, 0.95))
    assert verdict_of(broken.effects) is Verdict.OPEN
    assert broken.verdict is Verdict.KEEP
    assert broken.remark == "keep: 50 % more fail or reach a wall"


def test_receptors_walls_and_time_steps_are_read_from_the_records(tmp_path):
    """A step of as many particles as a core treats in a second takes a second."""
    scene = small_scene(ROAD)
    changed = load_scene(scene, SOFTER.changes)
    store, tally = RecordStore(directory_of(tmp_path, SOFTER.changes), changed.digest()), tally_of(changed)
    store.create()
    ends = [Status.slid, Status.no_slide, Status.reached_wall, Status.crashed]
    for k, (status, reached, steps) in enumerate(zip(ends, [1.0, 0.0, 1.0, math.nan], [100, 200, 300, 0], strict=True)):
        values = {"final_runout_mass": 9.0, "final_runout": 9.0, "front_reaches": np.array([reached]), "steps": steps}
        store.write(Record(k, status, "", values, UNITS))
        tally.add(summarize(store.read(k)))
    there = law.realizations_of(Outcome(SOFTER.changes, changed, tally, "", 1.0), tally, tmp_path, 4)
    assert np.array_equal(there.runouts, [9.0, 0.0, 9.0, math.nan], equal_nan=True)
    assert there.has_slid.tolist() == [True, False, True, False]
    assert there.is_spoiled.tolist() == [False, False, True, True]
    assert there.reaches.tolist() == [[True, False, True, False]]
    assert there.seconds == pytest.approx(200 * particle_count(changed) / speed(changed))


def test_the_probability_that_the_front_reaches_a_receptor_is_judged_too(made_up):
    scene = small_scene(ROAD)
    own = made_up.own._replace(reaches=np.arange(80)[None] < 20)
    there = own._replace(reaches=np.arange(80)[None] < 60)
    reach = law.effects_of(scene, own, there)[3]
    assert reach.words == "P(front reaches road)"
    assert (reach.difference.first, reach.difference.other) == (0.25, 0.75)
    assert verdict_of([reach]) is Verdict.KEEP


WIGGLE = np.tile([1.0, 1.0, -1.0, -1.0], 20) / math.sqrt(80 / 79)
RUNOUTS = 10 + 2 * np.tile([1.0, -1.0], 40) / math.sqrt(80 / 79)


def realizations(runouts, seconds):
    n = len(runouts)
    all_slide, none = np.ones(n, dtype=bool), np.zeros(n, dtype=bool)
    return law.Realizations(runouts, all_slide, none, np.empty((0, n), dtype=bool), seconds)


@pytest.fixture
def made_up():
    """By hand: 5 % of 10 m are 0.5 m, and 80 pairs know a difference that scatters by 1 m to 0.22 m."""
    scene, own = small_scene(), realizations(RUNOUTS, 2.0)

    def changed(choice, shift, seconds):
        there = realizations(RUNOUTS + shift + WIGGLE, seconds)
        return Screened(choice, there, law.effects_of(scene, own, there))

    choices = [
        changed(UNCORRELATED, 0.05, 2.0),
        changed(COARSER, -3.0, 0.25),
        changed(SOFTER, 0.2, 1.0),
        changed(RAMP, 0.4, 2.2),
        Screened(IMPOSSIBLE, why_not="left out: too long"),
    ]
    both = Choice("all that may drop", "", (*UNCORRELATED.changes, *SOFTER.changes))
    return Screening(scene, own, choices, [Combination((UNCORRELATED, SOFTER), changed(both, 0.25, 0.9))])


def test_the_table_tells_differences_intervals_cost_and_verdict(made_up):
    lines = {line.split("  ")[0]: " ".join(line.split()) for line in table(made_up).splitlines()}
    assert lines["cells of 2 m -> 3 m"].endswith("-3.00 ± 0.22 +0.24 ± 0.20 +0 (-5 to +5) 0.12 keep")
    assert lines["modulus 100 MPa -> 25 MPa"].endswith("0.5 may drop")
    assert "not known yet: 397 realizations would tell" in lines['gravity "release" -> "ramp"']
    assert lines["crest of 20 m -> 0 m"].endswith("not known yet: left out: too long")
    assert [*lines][2:4] == ["cells of 2 m -> 3 m", 'gravity "release" -> "ramp"']


def test_the_advice_names_every_choice_once(made_up):
    assert "Keep: cells of 2 m." in made_up.advice
    assert "May drop: cross-correlation and modulus 100 MPa." in made_up.advice
    assert 'Not known yet: gravity "release" and crest of 20 m.' in made_up.advice
    assert "by +0.25 ± 0.22 m, and a realization takes 45 % of the particle-steps" in made_up.advice
    assert "judged by itself, at 95 % confidence" in made_up.advice


def test_walls_in_the_way_of_the_scene_itself_are_said(made_up):
    own = made_up.own._replace(is_spoiled=np.arange(80) < 20)
    found = Screening(made_up.scene, own, made_up.choices)
    assert "25 % of the scene's own realizations fail or reach a wall of the model" in found.advice
    assert "wall" not in made_up.advice


def test_where_all_at_once_is_too_much_they_are_taken_one_after_the_other(made_up):
    """From the one that may change least; the second is too much for it, the third is not."""
    good, bad = made_up.choices[0].effects, made_up.choices[1].effects
    names, changes = "abcd", {name: (f"campaign.{name}=1",) for name in "abcd"}
    droppable = [Screened(Choice(name, "none", changes[name]), made_up.own, good) for name in names]
    asked = []

    def tried(choice):
        asked.append((choice.name, *(name for name in names if changes[name][0] in choice.changes)))
        return Screened(choice, made_up.own, bad if changes["c"][0] in choice.changes else good)

    attempts = whole._at_once(droppable, tried)
    assert asked == [
        ("all that may drop", *"abcd"),
        ("d and c", *"cd"),
        ("d and b", *"bd"),
        ("these and a", *"abd"),
    ]
    found = Screening(made_up.scene, made_up.own, droppable, attempts).simplified
    assert [each.name for each in found.members] == [*"dba"]


def test_where_no_two_may_go_at_once_the_one_goes_that_may_change_least(made_up):
    def tried(choice):
        return Screened(choice, made_up.own, made_up.choices[1].effects)

    attempts = whole._at_once(made_up.droppable, tried)
    assert len(attempts) == 1, "both at once are all of them"
    found = Screening(made_up.scene, made_up.own, made_up.choices, attempts)
    assert found.simplified.members == (UNCORRELATED,)


def test_a_row_of_the_csv_is_a_number_of_a_choice(made_up):
    rows = [*csv.DictReader(io.StringIO(as_csv(made_up)))]
    assert len(rows) == 5 * 3 + 1
    mean = next(row for row in rows if row["choice"] == "cells of 2 m" and row["number"].startswith("mean"))
    assert float(mean["change"]) == pytest.approx(-3.0)
    assert float(mean["tolerance"]) == pytest.approx(0.5)
    assert mean["verdict"] == "keep"


def test_the_dataset_holds_what_the_table_says(made_up, tmp_path):
    as_dataset(made_up).to_netcdf(tmp_path / "screen.nc")
    with xr.open_dataset(tmp_path / "screen.nc") as data:
        coarser = data.sel(choice=made_up.choices[1].name, variant=made_up.choices[1].name)
        assert float(coarser.runout_mean_difference) == pytest.approx(-3.0)
        assert coarser.runout_mean_difference_ci.values == pytest.approx([-3.2225, -2.7775], abs=1e-3)
        assert np.array_equal(coarser.final_runout, made_up.choices[1].realizations.runouts)
        assert str(coarser.verdict.values) == "keep"
        assert np.isnan(data.runout_mean_difference.sel(choice=made_up.choices[4].name))
        assert all("long_name" in variable.attrs for variable in data.variables.values())


def test_the_chart_shows_every_choice_that_was_run_with_its_verdict(made_up):
    with in_style():
        runouts, probabilities = chart(made_up).figure.axes
    named = [label.get_text() for label in runouts.get_yticklabels()]
    assert named[0] == "cells of 2 m → 3 m"
    assert len(named) == 5
    told = [(text.get_text(), text.get_color()) for text in probabilities.texts]
    assert told[0] == ("keep", COLOURS[Verdict.KEEP])
    assert told[1][0] == "cost × 0.12"
    assert [words for words, _ in told].count("may drop") == 3
    assert any("-3.0" in text.get_text() for text in runouts.texts), "beyond the view"


def test_the_simplified_scene_is_the_scene_that_was_run(made_up, tmp_path):
    file = tmp_path / "simpler.toml"
    write_simplified(made_up, file)
    text = file.read_text()
    assert text.startswith(f"{HEADER} from ma2023, with what does not change 80 realizations")
    assert "#     field.cross_correlation=0" in text
    wanted = load_scene(made_up.scene, made_up.simplified.screened.choice.changes)
    assert load_scene(file).digest() == wanted.digest()
    write_simplified(made_up, file)


def test_the_number_of_realizations_of_the_study_is_not_that_of_the_scene(made_up):
    scene = small_scene("campaign.realizations=80")
    found = Screening(scene, made_up.own, made_up.choices, made_up.together)
    assert scene_of(simplified_scene(found)).campaign.realizations == 1000


def test_without_anything_to_drop_no_file_is_written(made_up, tmp_path, capsys):
    found = Screening(made_up.scene, made_up.own, made_up.choices[1:2])
    write_simplified(found, tmp_path / "simpler.toml")
    assert not (tmp_path / "simpler.toml").exists()
    assert "is not written: no simpler scene" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("name", "complaint"),
    [("mine.toml", "exists and is left as it is"), ("mine.txt", "does not end in"), ("no/mine.toml", "no directory")],
)
def test_a_file_of_the_users_own_is_left_as_it_is(name, complaint, tmp_path):
    (tmp_path / "mine.toml").write_text("title = 'mine'")
    with pytest.raises(RefusalError, match=complaint):
        refuse_to_overwrite(tmp_path / name)


def test_a_short_screening_on_the_command_line(tmp_path, monkeypatch, capsys):
    """A second look at the same directory computes nothing."""
    monkeypatch.setattr(cli, "_pin_threads", lambda: None)
    monkeypatch.setattr(whole, "choices_of", lambda _: [SOFTER])
    monkeypatch.setattr(law, "POINTS", 0.6)
    command = ["screen", "ma2023", "--set", "numerics.end_time=3 s", "--set", "numerics.cell=2 m"]
    command += ["--accuracy", "3 m", "--realizations", "4", "--out", str(tmp_path / "s")]
    command += ["--simplified", str(tmp_path / "simpler.toml")]
    assert cli.main(command) == 0
    told = capsys.readouterr().out
    assert "soil.young_modulus = 25 MPa: 4 realizations" in told
    assert "modulus 100 MPa -> 25 MPa" in told
    assert (tmp_path / "s" / "screen.png").stat().st_size > 5000
    with xr.open_dataset(tmp_path / "s" / "screen.nc") as data:
        assert data.sizes == {"variant": 2, "realization": 4, "choice": 1, "bound": 2}
        assert abs(float(data.runout_mean_difference[0])) < 3.0
    assert load_scene(tmp_path / "simpler.toml").soil.young_modulus == 25e6
    assert cli.main(command) == 0
    assert "of core time." not in capsys.readouterr().out
