"""Settings are compared on the same ground, and the advice follows from the numbers."""

import csv

import numpy as np
import pytest
import xarray as xr
from small_campaign import small_scene

from campaign import cli
from campaign.errors import RefusalError
from campaign.report.figures.style import in_style
from campaign.scene import load_scene
from campaign.simulation.ground import Ground, prepare
from campaign.tradeoff import trials as tradeoff
from campaign.tradeoff.chart import _name, chart
from campaign.tradeoff.table import rows, table
from campaign.tradeoff.trials import OWN, Tradeoff, Trial, settings

SHORT = ["numerics.end_time=3 s", "numerics.cell=2 m", "campaign.realizations=1"]


def trial(setting, seconds, runouts, reason="", was_run=True):
    return Trial(setting, 1.0, np.array(runouts), seconds, reason, was_run)


@pytest.fixture
def made_up():
    """By hand: the RMS of (0.3, 0.4) is 0.354, of (3, 4) 3.54; 5 % of the reference's mean, 10 m, are 0.5 m."""
    trials = [
        trial(OWN, 2.0, [10.3, 10.4]),
        trial("numerics.cell=0.5 m", 16.0, [10.0, 10.0]),
        trial("numerics.cell=2 m", 0.25, [13.0, 14.0]),
        trial("numerics.courant=0.3", 4.0, [10.3, 10.4]),
        trial("numerics.courant=0.9", 1.5, [10.1, np.nan], "energy was created"),
        trial("numerics.particles_per_cell=16", 8.0, [np.nan, np.nan], "left out", was_run=False),
    ]
    return Tradeoff(small_scene(), trials, trials[1])


def test_the_front_holds_what_nothing_cheaper_equals(made_up):
    assert [each.setting for each in made_up.front] == ["numerics.cell=2 m", OWN, "numerics.cell=0.5 m"]
    assert [each.rms(made_up.reference) for each in made_up.front] == pytest.approx([3.5355, 0.35355, 0.0], rel=1e-4)


def test_the_cheapest_of_the_front_that_is_near_is_recommended(made_up):
    assert made_up.recommended is made_up.trials[0]
    assert "within 0.35 m" in made_up.advice
    assert "8.0 times smaller" in made_up.advice


def test_where_nothing_is_near_nothing_is_recommended(made_up):
    far = Tradeoff(made_up.scene, made_up.trials[1:3], made_up.reference)
    assert far.recommended is None
    assert "none of them is recommended" in far.advice


def test_failures_and_what_was_left_out_are_marked(made_up):
    by_setting = {row[0]: row[1:] for row in rows(made_up)}
    assert by_setting["numerics.courant=0.9"] == ("1.5", "", "", "1 of 2 runs", "energy was created")
    assert by_setting["numerics.particles_per_cell=16"] == ("8", "", "", "", "left out")
    assert "energy was created" in table(made_up)
    assert table(made_up).startswith("1 realization and the run with mean strengths in each setting\n")
    assert "1 of 2 runs  energy was created" in table(made_up)


def test_the_chart_shows_every_setting_that_was_run_and_crosses_the_failed(made_up):
    with in_style():
        axes = chart(made_up).figure.axes[0]
    assert sum(line.get_marker() == "x" for line in axes.lines) == 1
    listed = axes.texts[-1].get_text()
    assert len(listed.splitlines()) == 5
    assert "as the scene says (recommended)" in listed


def test_the_chart_names_a_setting_and_what_it_needs(made_up):
    both = trial("numerics.basis=linear, numerics.courant=0.2", 1.0, [10.0, 10.0])
    assert _name(both, made_up) == "basis = linear, courant = 0.2"
    assert _name(made_up.trials[0], made_up) == f"{OWN} (recommended)"
    assert _name(trial("soil.young_modulus=2.5 MPa", 1.0, [9.0, 9.0]), made_up) == "young modulus = 2.5 MPa"


def test_the_settings_of_the_scene_itself_are_not_tried_twice():
    scene = small_scene()
    tried = settings(scene)
    assert "numerics.cell=4 m" in tried
    assert f"numerics.courant={scene.numerics.courant}" not in tried
    assert f"numerics.basis={scene.numerics.basis}" not in tried
    assert "soil.young_modulus=25 MPa" in tried


@pytest.mark.parametrize(
    ("setting", "needs"),
    [
        ("numerics.basis=linear", ["numerics.courant=0.2"]),
        ("numerics.basis=bspline", ["numerics.locking=none"]),
        ("numerics.stress_update=usl", ["numerics.courant=0.4"]),
        ("numerics.stress_update=usf", []),
        ("numerics.courant=0.9", []),
    ],
)
def test_a_setting_is_tried_with_what_it_needs(setting, needs):
    scene = load_scene("ma2023", ["numerics.cell=2 m"])
    assert tradeoff.needed(scene, setting) == needs
    load_scene(scene, [setting, *needs])


def test_a_short_comparison_on_the_command_line(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(cli, "_pin_threads", lambda: None)
    monkeypatch.setattr(tradeoff, "CHOICES", {"numerics.courant": (0.6, 0.9), "numerics.locking": ("none",)})
    overrides = [part for override in SHORT[:2] for part in ("--set", override)]
    code = cli.main(["tradeoff", "ma2023", *overrides, "--realizations", "1", "--out", str(tmp_path / "t")])
    assert code == 0
    assert "reference" in capsys.readouterr().out
    with xr.open_dataset(tmp_path / "t" / "tradeoff.nc") as data:
        kept = data.load()
    record = prepare(load_scene("ma2023", SHORT)).simulate(0)
    assert float(kept.final_runout.sel(setting=OWN, realization=0)) == record.values["final_runout_mass"]
    assert kept.attrs["scene_overrides"].split("\n") == SHORT
    with (tmp_path / "t" / "tradeoff.csv").open() as file:
        assert len(list(csv.reader(file))) == 1 + kept.sizes["setting"]
    assert (tmp_path / "t" / "tradeoff.png").stat().st_size > 5000


def test_what_exceeds_the_budget_is_left_out_and_said(tmp_path):
    said = []
    bench = tradeoff.Bench(1, 10.0, tmp_path)
    left_out = bench.tried("numerics.cell=0.1 m", small_scene(*SHORT), 60.0, said.append)
    assert not left_out.was_run
    assert "left out, about 2 min of CPU time and 10 s left" in said[0]


def test_a_scene_that_gives_no_runout_is_refused(tmp_path):
    with pytest.raises(RefusalError, match="gives no run-out"):
        tradeoff.compare(small_scene(*SHORT), 1, 0.0, tmp_path, lambda line: None)


def test_a_run_that_raises_is_a_failure_of_its_setting(tmp_path, monkeypatch):
    """The first of two realizations, so that the other still counts."""
    asked = iter([ZeroDivisionError("a particle has no mass")])

    def simulate_badly(*arguments):
        for error in asked:
            raise error
        return simulate(*arguments)

    simulate = Ground.simulate
    monkeypatch.setattr(Ground, "simulate", simulate_badly)
    tried = tradeoff.Bench(1, 100.0, tmp_path).tried(OWN, small_scene(*SHORT), 0.1, lambda line: None)
    assert tried.failures == 1
    assert "no mass" in tried.reason
