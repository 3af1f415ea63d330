"""An answer from all meshes and models comes first, and says what it rests on."""

import numpy as np
import pytest
from small_campaign import conclude, made_up, small_scene

from campaign.accuracy.mesh_limit import MeshLimit, Runs
from campaign.accuracy.pursuit import Pursuit
from campaign.accuracy.settings import models_of
from campaign.report.answer import answer
from campaign.report.error_budget import error_budget
from campaign.report.headline import reaches, tiles
from campaign.results.accuracy import of_pursuit, reached_of
from campaign.results.results import Results, read_results
from campaign.scene import scene_of
from campaign.seeds import BASELINE
from campaign.simulation.ground import prepare
from campaign.statistics.intervals import Interval

PLACES = (("the road", 9.5), ("the house", 20.0))
"""Receptors and their distances from the toe, which is at x = 35 m."""

LIMIT = MeshLimit(Interval(9.0, 8.8, 9.2, 12), Interval(-0.2, -0.3, -0.1, 12), Interval(9.0, 8.6, 9.5, 12))


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    """Twelve slides of 10 m and more."""
    wanted = ("campaign.realizations=12", "campaign.minimum=13", "campaign.accuracy=6 %")
    directory = tmp_path_factory.mktemp("aimed")
    places = "".join(f'\n[[receptor]]\nname = "{name}"\nx = "{35 + d:g} m"\n' for name, d in PLACES)
    scene = scene_of(small_scene().text + places, [*small_scene().overrides, *wanted], "ma2023")
    ground = prepare(scene)
    slides = [made_up(ground, k, 10.0 + 0.02 * k) for k in range(12)]
    conclude(directory, scene, ground, [made_up(ground, BASELINE, 9.0), *slides])
    return read_results(directory)


def runs_of(count, cut_short):
    """Slides of 8 to 10 m, alike on all meshes."""
    return Runs(8.0 + 2.0 * (np.arange(count) * 5 % 12) / 11, np.ones(count), np.zeros((count, 1)), cut_short)


def aimed(plain, is_reached=True, cut_short=0):
    models = models_of(plain.scene)
    ladder = models.ladders[0]
    others = len(ladder) - 1
    runs = [runs_of(count, short) for count, short in ((12, cut_short), *[(36, 0)] * others)]
    found = Pursuit(ladder, tuple(runs), LIMIT, is_reached)
    return Results(plain.data.assign(of_pursuit(found, models, [d for _, d in PLACES])), plain.scene)


def test_the_dataset_gives_back_what_it_was_given(plain):
    found = reached_of(aimed(plain).data)
    assert found.limit == LIMIT
    assert found.counts[0] == 12
    assert found.cells == (1.0, 2.0, 2.0)


def test_the_answer_begins_with_all_models_and_tells_what_is_counted_on_one_mesh(plain):
    text = answer(aimed(plain))
    assert (
        "The slide runs 9.00 m on average, 8.60 to 9.50 m with 95 % confidence for sampling and mesh together" in text
    )
    assert "±0.50 m (5.6 %), 6 % were asked." in text
    assert "12 runs with cells of 1 m, 36 with 2 m and 36 with 2 m and E = 10 MPa" in text
    assert text.index("All that follows is counted with cells of 2 m alone.") < text.index(
        "The slides of these cells ran 10.11 m on average"
    )


def test_what_was_not_reached_is_said(plain):
    assert "not the 6 % that were asked" in answer(aimed(plain, is_reached=False))


def test_runs_that_were_cut_short_make_it_a_lower_bound(plain):
    given = aimed(plain, cut_short=3)
    assert "It is a lower bound: 3 of 12 runs on that mesh met the wall ahead" in answer(given)
    assert "The slide runs at least 9.00 m on average, at least 8.60 m with 95 % confidence" in answer(given)
    assert ("at least 9.00 m", "at least 8.60 m") in [each[1:3] for each in tiles(given)]
    assert ("at least 9.00 m", "at least 8.60 m") in [each[2:4] for each in error_budget(given)]


def test_the_first_screen_and_the_budget_have_it(plain):
    (tile,) = [each for each in tiles(aimed(plain)) if each.value == "9.00 m"]
    assert tile.interval == "8.60 to 9.50 m"
    assert [row.source for row in error_budget(aimed(plain)) if "all meshes" in row.quantity] == [
        "Total",
        "Sampling",
        "Discretisation",
    ]


def test_how_far_and_how_probably_is_told_of_the_finest_mesh(plain):
    """Of 36 slides those of 9.5 m and more are 9, of which every third falls on 9.64, 9.82 and 10 m."""
    text = answer(aimed(plain))
    assert "50 % of the slides stop within 9.00 m" in text
    assert "25 % (12 to 42 %) come as far as the road" in text
    road, house = reaches(aimed(plain))
    assert (road.value, road.interval) == ("25 %", "12 to 42 %")
    assert "counted with cells of 2 m alone: 0 %" in road.remark
    assert house.value == "0 %"


def test_nothing_is_foretold_from_slides_that_were_cut_short(plain):
    assert reached_of(aimed(plain, cut_short=3).data).quantiles == {}
    assert "come as far as" not in answer(aimed(plain, cut_short=3))


def test_a_plain_campaign_says_nothing_of_it(plain):
    assert reached_of(plain.data) is None
    assert "all meshes" not in answer(plain)
