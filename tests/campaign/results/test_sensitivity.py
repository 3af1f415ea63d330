"""What the run-out owes to the soil and to the inputs is in the dataset, with units, names and intervals."""

import math
from pathlib import Path

import numpy as np
import pytest
from scene_complaints import UNDRAINED, written
from small_campaign import small_scene
from soil_campaign import FOOT, SLOPE, soil_campaign

from campaign.results import dataset
from campaign.results.results import open_results
from campaign.results.sensitivity import effects_of, map_of, ranking_of, with_sensitivity
from campaign.results.sensitivity_table import ESTIMATES, OTHERS, markdown
from campaign.scene.inputs import inputs_of

RARE = {f"slide_{name}" for name in ("correlation", "regression", "explained")}


@pytest.fixture(scope="module")
def results():
    return soil_campaign(80)


def test_the_map_finds_the_foot_of_the_slope_in_the_soil_that_is_drawn(results):
    found = map_of(results.data)
    foot, elsewhere = found.change[0][FOOT], np.delete(found.change[0], np.s_[2:5], axis=0)
    assert np.nanmean(foot) == pytest.approx(SLOPE * math.log(1.1), rel=0.35)
    assert abs(np.nanmean(elsewhere)) < 0.1 * abs(np.nanmean(foot))
    assert found.explained > 0.85
    assert found.is_clear[0][FOOT].any()
    assert ranking_of(results.data, "runout").correlation[0].upper < 0


def test_every_variable_says_its_unit_and_what_it_is(results):
    for name, row in (ESTIMATES | OTHERS).items():
        if name in RARE:
            assert name not in results.data
            continue
        stored = results.data[name]
        assert (stored.dims, stored.attrs["units"], stored.attrs["long_name"]) == (row.dims, row.units, row.long_name)
        if name in ESTIMATES:
            assert results.data[f"{name}_ci"].dims == (*row.dims, "bound")
    assert results.data["input"].values.tolist() == [row.key for row in inputs_of(results.scene)]


def test_what_is_written_is_what_is_read(results, tmp_path):
    dataset.write(results.data, tmp_path / "results.nc")
    read = open_results(tmp_path)
    for name in ("sensitivity", "runout_regression_ci", "input_difference", "input_effect"):
        np.testing.assert_array_equal(read[name], results.data[name])
    assert ranking_of(read, "runout") == ranking_of(results.data, "runout")
    assert map_of(read).everywhere == map_of(results.data).everywhere
    assert effects_of(results).effects["soil.unit_weight"].n == 4


def test_where_some_stand_sliding_is_ranked_too():
    found = soil_campaign(150, standing=lambda runout: runout < 10.2)
    assert 10 <= found.outcomes.slides <= 140
    sliding = ranking_of(found.data, "slide")
    assert sliding.correlation[0].upper < 0
    assert sliding.correlation[0].n == 150


def test_undrained_soil_has_one_property(tmp_path):
    found = soil_campaign(50, source=written(tmp_path, *UNDRAINED))
    assert found.data["sensitivity"].shape[0] == 1
    assert len(ranking_of(found.data, "runout").regression) == 1


def test_few_slides_rank_nothing():
    few = soil_campaign(12)
    assert ranking_of(few.data, "runout") is map_of(few.data) is None
    assert set(with_sensitivity(few, None).variables) == set(few.data.variables)


def test_readme_lists_the_variables_of_the_table():
    text = (Path(__file__).parents[3] / "README.md").read_text()
    begin, end = "<!-- sensitivity: from the table -->\n", "\n<!-- sensitivity end -->"
    assert text[text.index(begin) + len(begin) : text.index(end)] == markdown()


def test_a_small_scene_repeats_four_slides_of_each_input():
    assert small_scene().campaign.sensitivity_pairs == 4
