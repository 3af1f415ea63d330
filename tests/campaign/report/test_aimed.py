"""An answer from all meshes and models comes first, and says what it rests on."""

import pytest
from small_campaign import conclude, made_up, small_scene

from campaign.accuracy.mesh_limit import MeshLimit
from campaign.accuracy.pursuit import Pursuit
from campaign.accuracy.settings import models_of
from campaign.report.answer import answer
from campaign.report.error_budget import error_budget
from campaign.report.headline import tiles
from campaign.results.accuracy import of_pursuit, reached_of
from campaign.results.results import Results, read_results
from campaign.seeds import BASELINE
from campaign.simulation.ground import prepare
from campaign.statistics.intervals import Interval

LIMIT = MeshLimit(Interval(9.0, 8.8, 9.2, 12), Interval(-0.2, -0.3, -0.1, 12), Interval(9.0, 8.6, 9.5, 12))


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    """Twelve slides of 10 m and more."""
    wanted = ("campaign.realizations=12", "campaign.minimum=13", "campaign.accuracy=6 %")
    directory, scene = tmp_path_factory.mktemp("aimed"), small_scene(*wanted)
    ground = prepare(scene)
    slides = [made_up(ground, k, 10.0 + 0.02 * k) for k in range(12)]
    conclude(directory, scene, ground, [made_up(ground, BASELINE, 9.0), *slides])
    return read_results(directory)


def aimed(plain, is_reached=True, cut_short=0):
    models = models_of(plain.scene)
    ladder = models.ladders[0]
    others = len(ladder) - 1
    found = Pursuit(ladder, (12,) + (36,) * others, (cut_short,) + (0,) * others, LIMIT, is_reached)
    return Results(plain.data.assign(of_pursuit(found, models)), plain.scene)


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
    assert "It is a lower bound: 3 of 12 runs on that mesh met a wall" in answer(given)
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


def test_a_plain_campaign_says_nothing_of_it(plain):
    assert reached_of(plain.data) is None
    assert "all meshes" not in answer(plain)
