"""Settings are compared on the same ground, and the advice follows from the numbers."""

import csv
import io
import math

import numpy as np
import pytest
import xarray as xr
from small_campaign import small_scene

from campaign import cli
from campaign.record import Status
from campaign.report.figures.style import in_style
from campaign.running.study import OWN, together
from campaign.scene import load_scene
from campaign.simulation.ground import prepare
from campaign.tradeoff import settings as choices
from campaign.tradeoff.chart import chart
from campaign.tradeoff.settings import finer, needed, settings
from campaign.tradeoff.table import as_csv, as_dataset, table
from campaign.tradeoff.trials import Tradeoff, Trial

SHORT = ["numerics.end_time=3 s", "numerics.cell=2 m"]

# Of eight random fields: a mean of 10 m, a standard deviation of 2 m.
FIELDS = 10 + 2 * np.array([-1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0]) * math.sqrt(7 / 8)
WIGGLE = 0.1 * np.array([1.0, 1.0, -1.0, -1.0, 1.0, 1.0, -1.0, -1.0])


def trial(changes, cell, seconds, runouts, **keywords):
    return Trial(changes, cell, np.asarray(runouts, dtype=float), seconds, **keywords)


@pytest.fixture
def made_up():
    """By hand: 5 % of 10 m are 0.5 m, so that sampling may take 0.25 m: (1.96 * 2 / 0.25)^2 = 245.9 realizations."""
    trials = [
        trial((), 1.0, 2.0, FIELDS + 0.3 + WIGGLE),
        trial(("numerics.cell=0.5 m",), 0.5, 16.0, FIELDS),
        trial(("numerics.cell=2 m",), 2.0, 0.25, FIELDS + 3.0 + WIGGLE),
        trial(("soil.young_modulus=10 MPa",), 1.0, 0.7, FIELDS + 0.2 + WIGGLE),
        trial(("numerics.courant=0.9",), 1.0, 1.5, np.where(FIELDS > 10, FIELDS, np.nan), ends={Status.diverged: 4}),
        trial(("numerics.particles_per_cell=16",), 1.0, 8.0, np.full(8, np.nan), why_not="left out: too long"),
    ]
    return Tradeoff(small_scene(), trials, trials[1])


def test_the_shift_is_that_of_the_same_fields_and_its_interval_bounds_the_bias(made_up):
    """The wiggle's standard deviation is 0.1069, and t of 7 degrees 2.365: 0.0894 on either side."""
    own = made_up.of(made_up.trials[0])
    assert own.shift.estimate == pytest.approx(0.3)
    assert own.bias == pytest.approx(0.3 + 0.0894, abs=1e-4)
    assert made_up.of(made_up.reference).bias == 0.0


def test_a_campaign_of_the_sampling_error_costs_what_it_takes(made_up):
    reference = made_up.of(made_up.reference)
    assert reference.sampling_cost(0.25) == pytest.approx(245.9 * 16, rel=1e-3)
    assert reference.error(245.9 * 16) == pytest.approx(0.25, rel=1e-3)
    assert reference.cost(0.25) == pytest.approx(reference.sampling_cost(0.25))


def test_a_bias_is_never_averaged_away(made_up):
    coarse = made_up.of(made_up.trials[2])
    assert coarse.error(1e12) == pytest.approx(coarse.bias, abs=1e-4)
    assert math.isinf(coarse.cost(made_up.wanted))


def test_the_front_holds_what_nothing_cheaper_equals(made_up):
    assert [each.trial.cell for each in made_up.front] == [2.0, 1.0, 0.5]
    assert made_up.front[1].trial.changes == ("soil.young_modulus=10 MPa",)


def test_the_setting_with_which_the_wanted_error_costs_least_is_recommended(made_up):
    """Softer ground may shift the mean by 0.289 m, which leaves 0.211 m; the scene as it is by 0.389 m and 0.111 m."""
    assert made_up.recommended.trial.changes == ("soil.young_modulus=10 MPa",)
    assert "Recommended: soil.young_modulus = 10 MPa" in made_up.advice
    share = 100 * (0.7 / 0.2106**2) / (2.0 / 0.1106**2)
    assert f"{share:.2g} % of what the scene as it is takes" in made_up.advice
    assert "off by some 0.30 m" in made_up.advice


def test_an_accuracy_of_the_scene_is_the_wanted_one(made_up):
    strict = Tradeoff(small_scene("campaign.accuracy=0.2 m"), made_up.trials[:1], made_up.trials[0])
    assert strict.wanted == 0.2


def test_what_is_cheaper_and_shifts_the_scene_by_little_is_harmless(made_up):
    """Softer ground shifts the scene by exactly 0.1 m; larger cells are another mesh."""
    assert made_up.harmless == [("soil.young_modulus=10 MPa",)]


def test_where_nothing_is_near_nothing_is_recommended(made_up):
    far = Tradeoff(made_up.scene, [made_up.trials[0], made_up.trials[2]], made_up.reference)
    strict = Tradeoff(small_scene("campaign.accuracy=0.3 m"), far.trials, far.reference)
    assert strict.recommended is None
    assert "to 0.30 m: the nearest, as the scene says, may shift it by up to 0.39 m" in strict.advice


def test_cheaper_models_make_the_finest_mesh_cheaper(made_up):
    """The cheap ones explain all but a wiggle of 0.1 of the scatter of 2 m."""
    width = 0.1
    assert made_up.multilevel_cost(width) < 0.3 * made_up.of(made_up.reference).sampling_cost(width)
    alone = Tradeoff(made_up.scene, [made_up.reference], made_up.reference)
    assert math.isnan(alone.multilevel_cost(width))


def test_failures_and_what_was_left_out_are_marked(made_up):
    lines = {line.split("  ")[0]: line for line in table(made_up).splitlines()}
    assert "4 of 8 diverged" in lines["Courant 0.9"]
    assert "left out: too long" in lines["16 particles a cell"]
    assert table(made_up).startswith("8 realizations in each setting; campaigns until sampling adds 0.25 m")
    written = {row["setting"]: row for row in csv.DictReader(io.StringIO(as_csv(made_up)))}
    assert written["numerics.courant = 0.9"]["total_error_m"] == ""
    assert float(written[OWN]["total_error_m"]) == pytest.approx(0.6394, abs=1e-4)
    assert written["numerics.cell = 0.5 m"]["remark"] == "finest mesh, nothing cheaper is as near"


def test_the_dataset_holds_what_the_table_says(made_up):
    data = as_dataset(made_up)
    own = data.sel(setting=OWN)
    assert float(own.total_error) == pytest.approx(0.6394, abs=1e-4)
    assert np.array_equal(own.final_runout, made_up.trials[0].runouts)
    assert np.isnan(data.total_error.sel(setting="numerics.courant = 0.9"))
    assert data.attrs["recommended"] == "soil.young_modulus = 10 MPa"
    assert all("long_name" in variable.attrs for variable in data.variables.values())


def test_the_chart_shows_every_setting_that_was_run_and_crosses_the_failed(made_up):
    with in_style():
        axes, names, steps = chart(made_up).figure.axes
    assert sum(line.get_marker() == "o" for line in axes.lines) == 4
    assert sum(len(line.get_xdata()) for line in axes.lines if line.get_marker() == "x") == 1
    listed = "\n".join(column.get_text() for column in names.texts)
    assert len(listed.splitlines()) == 6
    assert "E 10 MPa (recommended)" in listed
    assert "16 particles a cell (left out)" in listed
    assert any("never stable" in text.get_text() for text in steps.texts)


def test_the_settings_of_the_scene_itself_are_not_tried_twice():
    scene = small_scene()
    tried = settings(scene)
    assert finer(scene) == ("numerics.cell=1 m",)
    assert ("numerics.cell=4 m",) in tried
    assert (f"numerics.courant={scene.numerics.courant}",) not in tried
    assert (f"numerics.basis={scene.numerics.basis}",) not in tried
    assert ("soil.young_modulus=10 MPa",) in tried


@pytest.mark.parametrize(
    ("key", "value", "needs"),
    [
        ("numerics.basis", "linear", ["numerics.courant=0.2"]),
        ("numerics.basis", "bspline", ["numerics.locking=none"]),
        ("numerics.stress_update", "usl", ["numerics.courant=0.4"]),
        ("numerics.stress_update", "usf", []),
        ("numerics.courant", 0.9, []),
    ],
)
def test_a_setting_is_tried_with_what_it_needs(key, value, needs):
    scene = load_scene("ma2023", ["numerics.cell=2 m"])
    assert needed(scene, key, value) == needs
    load_scene(scene, [f"{key}={value}", *needs])


def test_of_two_settings_that_change_the_same_the_first_counts():
    usl = ("numerics.stress_update=usl", "numerics.courant=0.4")
    assert together([usl, ("numerics.courant=0.9",)]) == ("numerics.courant=0.4", "numerics.stress_update=usl")


def test_a_short_comparison_on_the_command_line(tmp_path, monkeypatch, capsys):
    """With run-outs as those of the scene on its own; a second look at the same directory computes nothing."""
    monkeypatch.setattr(cli, "_pin_threads", lambda: None)
    monkeypatch.setattr(choices, "CHOICES", {"numerics.courant": (0.6, 0.9)})
    overrides = [part for override in SHORT for part in ("--set", override)]
    command = ["tradeoff", "ma2023", *overrides, "--realizations", "4", "--out", str(tmp_path / "t")]
    assert cli.main(command) == 0
    told = capsys.readouterr().out
    assert "numerics.courant = 0.9: 4 realizations" in told
    with xr.open_dataset(tmp_path / "t" / "tradeoff.nc") as data:
        kept = data.load()
    record = prepare(load_scene("ma2023", SHORT)).simulate(0)
    assert float(kept.final_runout.sel(setting=OWN, realization=0)) == record.values["final_runout_mass"]
    assert (tmp_path / "t" / "tradeoff.png").stat().st_size > 5000
    assert cli.main(command) == 0
    assert "of core time." not in capsys.readouterr().out
