"""Sentences, rows and figures on the inputs say what the dataset says, and that there is too little where there is."""

import matplotlib.image
import numpy as np
import pytest
from soil_campaign import soil_campaign

from campaign.record import Status
from campaign.report.chapters import chapters
from campaign.report.distances import curves_of
from campaign.report.figures import inputs, sensitivity
from campaign.report.figures.section import section_of
from campaign.report.figures.style import NotDrawableError, in_style
from campaign.report.inputs import effect_rows, property_rows, property_tables, sentences
from campaign.results.results import Results
from campaign.results.sensitivity import effects_of, map_of, ranking_of, with_sensitivity


@pytest.fixture(scope="module")
def results():
    return soil_campaign(80)


@pytest.fixture(scope="module")
def bare(results):
    """The same without what this is about."""
    told = [name for name in results.data if str(name).startswith(("input", "sensitivity", "runout_", "slide_"))]
    return Results(results.data.drop_vars(told), results.scene)


def drawings(results):
    section = section_of(results.scene, results.runouts)
    return [lambda: inputs.ranking(results), lambda: sensitivity.sensitivity(results, section)]


def test_the_input_with_the_largest_effect_is_named_first(results):
    effect = effects_of(results).effects["soil.softening.rate"]
    told = sentences(results)
    assert told[0].startswith(
        "Of 8 inputs, each raised alone by 10 %, softening rate changes the run-out of a slide most"
    )
    assert f"{effect.estimate:+.2f} m ({effect.lower:+.2f} to {effect.upper:+.2f} m)" in told[0]
    assert "follows the mean peak cohesion of all the ground that moves most closely" in told[1]
    assert "; both means together explain " in told[1]
    assert told[2].startswith("The same properties place by place, instead of their means, explain ")
    assert "(peak cohesion around x = " in told[2]


def test_effects_lost_in_their_scatter_are_not_ranked(results):
    """Four slides with changes of +-3 m: an interval that holds 0 for every input."""
    lost = np.broadcast_to([3.0, -3.0, 3.1, -3.1], results.data["input_difference"].shape)
    data = results.data.assign(input_difference=(results.data["input_difference"].dims, lost))
    assert sentences(Results(data, results.scene))[0] == (
        "Of 8 inputs, each raised alone by 10 %, none has an effect on the run-out of a slide that can be told from "
        "none: 4 slides were computed again for each. A larger campaign.sensitivity_pairs may tell more."
    )


def test_only_effects_that_can_be_told_are_ranked_and_the_others_named(results):
    """Two inputs with +1.0 and -2.0 m within 0.1 m; all others change the run-out by 3 m one way or the other."""
    keys = results.data["input"].values.tolist()
    rows = np.broadcast_to([9.0, -3.0, 9.1, -3.1], results.data["input_difference"].shape).copy()
    first, second = keys.index("soil.softening.rate"), keys.index("soil.cohesion.mean")
    rows[first], rows[second] = [-2.0, -2.1, -1.9, -2.0], [1.0, 1.1, 0.9, 1.0]
    data = results.data.assign(input_difference=(results.data["input_difference"].dims, rows))
    told = sentences(Results(data, results.scene))[0]
    assert "softening rate changes the run-out of a slide most of those whose effect can be told from none, by" in told
    assert "; next comes mean peak cohesion, +1.00 m" in told
    assert " have effects lost in the scatter. 4 slides were computed again for each." in told


def test_slopes_that_stand_with_more_of_an_input_are_told_and_not_extrapolated(results):
    """With more friction all four slopes stand, with more cohesion three of four: no derivative follows from that."""
    keys = results.data["input"].values.tolist()
    front = results.data["final_runout_mass"].values[[*effects_of(results).realizations]]
    rows = results.data["input_difference"].values.copy()
    friction, cohesion = keys.index("soil.friction_angle.mean"), keys.index("soil.cohesion.mean")
    rows[friction], rows[cohesion] = -front, [*-front[:3], 0.8]
    data = results.data.assign(input_difference=(results.data["input_difference"].dims, rows))
    standing = Results(data, results.scene)
    told = sentences(standing)[0]
    assert "no longer slide at all: " in told
    assert "4 with 10 % more mean peak friction angle" in told
    assert "3 with 10 % more mean peak cohesion" in told
    assert f", by {-front.mean():+.2f} m (" in told
    assert f"; next come mean peak cohesion, {rows[cohesion].mean():+.2f} m (3 of 4 slides then stand) and " in told
    assert "ean peak cohesion has an effect lost" not in told
    per_deviation = {row.name: row.per_deviation for row in effect_rows(standing)}
    assert per_deviation["mean peak friction angle"] == per_deviation["mean peak cohesion"] == ""


def test_rows_are_in_the_order_of_effect(results):
    rows = effect_rows(results)
    assert rows[0].name == "softening rate"
    sizes = [abs(float(row.change.split()[0])) for row in rows]
    assert sizes == sorted(sizes, reverse=True)
    cohesion = next(row for row in rows if row.name == "mean peak cohesion")
    assert (cohesion.values, cohesion.pairs) == ("22 kPa instead of 20 kPa", "4")
    assert cohesion.per_deviation == f"{cohesion.change} for 10 %"
    assert [row.name for row in property_rows(results, "runout")] == ["peak cohesion", "peak friction angle"]


def test_a_property_that_others_hide_is_named_all_the_same(results):
    """Negative correlation between cohesion and friction: each makes up for the other, and only together they tell."""
    numbers = {
        "runout_correlation": [-0.22, -0.2],
        "runout_correlation_ci": [[-0.53, 0.11], [-0.51, 0.16]],
        "runout_regression": [-0.49, -0.47],
        "runout_regression_ci": [[-0.85, -0.24], [-0.78, -0.18]],
    }
    hidden = results.data.assign({name: results.data[name].copy(data=given) for name, given in numbers.items()})
    assert (
        "follows the mean peak cohesion of all the ground that moves most closely where the others stay the same "
        "(regression -0.49 (-0.85 to -0.24)); alone none is seen to matter, as they vary together."
    ) in sentences(Results(hidden, results.scene))[1]
    wide = hidden["runout_regression_ci"].copy(data=[[-0.85, 0.24], [-0.78, 0.18]])
    unseen = hidden.assign(runout_regression_ci=wide)
    assert "does not visibly follow the mean" in sentences(Results(unseen, results.scene))[1]


def test_where_only_sliding_is_ranked_the_chapter_is_there_with_that():
    """Of 80 realizations fewer than 30 slide: too few for their run-outs, enough for whether the slope slides."""
    ranked = soil_campaign(80, standing=lambda runout: runout < 10.8)
    rare = Results(ranked.data.drop_vars([name for name in ranked.data if str(name).startswith("input")]), ranked.scene)
    assert rare.outcomes.slides < 30
    (table,) = property_tables(rare)
    assert table.outcome == "whether the slope slides"
    assert [row.name for row in table.rows] == ["peak cohesion", "peak friction angle"]
    section = section_of(rare.scene, rare.runouts)
    assert "inputs" in [chapter.name for chapter in chapters(rare, curves_of(rare).all, section, None)]


def test_too_little_is_said_in_a_sentence(bare):
    assert sentences(bare) == [
        "The 80 slides do not say which property of the soil matters; the slides to say what the inputs do were not "
        "computed again."
    ]
    assert effect_rows(bare) == property_tables(bare) == []
    for draw in drawings(bare):
        with pytest.raises(NotDrawableError, match="It needs"):
            draw()


def test_slides_that_a_wall_stopped_have_no_part_in_what_the_soil_does(results):
    """The wall stopped the longest 20 of 80 slides; the other 60 tell the same as a campaign of these alone."""
    stopped = results.runouts > np.sort(results.runouts)[59]
    status = np.where(stopped, int(Status.reached_wall), results.data["status"].values)
    told = [name for name in results.data if str(name).startswith(("sensitivity", "runout_"))]
    walled = Results(results.data.drop_vars(told).assign(status=("realization", status)), results.scene)
    told_again = Results(with_sensitivity(walled, None), walled.scene)
    assert ranking_of(told_again.data, "runout").correlation[0].n == map_of(told_again.data).everywhere[0].n == 60
    alone = walled.data.isel(realization=np.flatnonzero(~stopped))
    assert ranking_of(with_sensitivity(Results(alone, walled.scene), None), "runout") == ranking_of(
        told_again.data, "runout"
    )
    assert sentences(told_again)[-1] == (
        "What the soil makes of the run-out is told without the 20 of 80 slides that the wall ahead stopped; with "
        "their whole run-outs it may be another."
    )
    assert "From 60 slides" in drawings(told_again)[1]().caption
    moving = np.where(stopped, int(Status.not_settled), results.data["status"].values)
    still = Results(results.data.assign(status=("realization", moving)), results.scene)
    told = sentences(still)[-1]
    assert told == (
        "20 slides whose fronts may have come farther after the end count with the distance until then, also where "
        "slides are computed again with more of an input."
    )


@pytest.mark.parametrize("number", [0, 1])
def test_a_figure_has_something_on_it(results, number, tmp_path):
    with in_style():
        illustration = drawings(results)[number]()
        illustration.figure.savefig(tmp_path / "figure.png", dpi=30)
    assert np.ptp(matplotlib.image.imread(tmp_path / "figure.png")[..., :3]) > 0.5
    assert "80" in illustration.caption
