"""What is known of a slope before it is run."""

import copy
import re
from dataclasses import dataclass

import numpy as np
import pytest

from campaign.commands.first_look_text import first_look_text
from campaign.errors import SceneError
from campaign.scene import Scene, load_scene, scene_of
from campaign.scene.constraints import tolerance
from campaign.scene.document import read_document
from campaign.scene.first_look import FirstLook, look_at
from campaign.scene.layer_table import trend_words
from campaign.scene.limit_equilibrium import Strata, critical_circle, factor_on
from campaign.scene.outlook import outlook
from campaign.scene.softening import is_brittle, is_progressive
from campaign.simulation.field_size import field_size
from solver.surface import slope_surface


def test_a_given_circle_has_the_factor_it_was_found_with():
    surface, strata = slope_surface(15.0, np.pi / 4, 20.0, 40.0, 4.0), Strata((20e3,), (np.radians(10.0),), (20e3,))
    found = critical_circle(surface, strata)
    assert factor_on(found, surface, strata) == pytest.approx(found.factor, rel=1e-9)


def test_a_circle_knows_how_deep_and_how_low_it_goes():
    """Undrained clay on deep ground slides on a base circle that touches the fixed base, 20 m below the crest."""
    surface = slope_surface(10.0, np.arctan(0.5), 30.0, 30.0, 10.0)
    found = critical_circle(surface, Strata((50e3,), (0.0,), (20e3,)))
    assert found.lowest == pytest.approx(0.0, abs=0.02)
    assert 10.0 < found.depth(surface) < 20.0
    assert found.elevation(np.array([found.entry])) == pytest.approx(surface.height_at(np.array([found.entry])))


def test_the_height_is_counted_from_the_toe_and_not_from_the_lowest_ground():
    surface = 'geometry={surface=[["0 m","22 m"],["20 m","22 m"],["35 m","7 m"],["75 m","5 m"]]}'
    assert look_at(load_scene("ma2023", [surface])).height == pytest.approx(15.0)


def cut(*bump):
    """Return a slope of 15 m with a bump or a ditch of a metre somewhere."""
    points = sorted([(0, 19), (20, 19), (35, 4), (75, 4), *bump], key=lambda point: point[0])
    return f"geometry={{surface={[[f'{x} m', f'{y} m'] for x, y in points]}}}"


@pytest.mark.parametrize(
    "bump",
    [
        pytest.param([(10, 19), (10, 20), (11, 20), (11, 19)], id="bump on the crest"),
        pytest.param([(19, 19), (19, 20), (20, 20)], id="bump on the edge"),
        pytest.param([(50, 4), (50, 5), (51, 5), (51, 4)], id="bump on the plain"),
        pytest.param([(50, 4), (50, 3), (51, 3), (51, 4)], id="pit in the plain"),
        pytest.param([(35, 3), (36, 3), (36, 4)], id="ditch at the toe"),
    ],
)
def test_height_front_and_circles_are_the_slopes_own_and_not_those_of_a_bump(bump):
    """Soil with little cohesion, of which a bump would be the first to fall."""
    loose = ["soil.cohesion.residual=1 kPa", "soil.friction_angle.residual=4 deg"]
    text = re.sub(r"(?m)^front_area.*\n", "", read_document("ma2023").text)
    even, uneven = (scene_of(text, [*loose, cut(*each)]) for each in ([], bump))
    assert uneven.front_area == pytest.approx(even.front_area)
    assert look_at(uneven).height == pytest.approx(15.0)
    assert look_at(uneven).residual.factor == pytest.approx(look_at(even).residual.factor, rel=0.1)


def test_the_factor_scatters_as_the_strength_when_cohesion_alone_holds_the_slope():
    """Without friction F is proportional to c, so that its coefficient of variation is that of c."""
    undrained = ["soil.friction_angle.mean=0.001 deg", "soil.friction_angle.residual=0 deg", "soil.cohesion.cov=0.2"]
    look = look_at(load_scene("ma2023", undrained))
    assert look.spread / look.peak.factor == pytest.approx(0.2, rel=1e-3)


def test_undrained_soil_has_no_friction_angle():
    """Taylor's slope of depth factor 2: F = 1.47 with c = 50 kPa."""
    tables = copy.deepcopy(read_document("ma2023").tables)
    del tables["soil"]["friction_angle"]
    tables["soil"] |= {"law": "tresca", "cohesion": {"mean": "50 kPa", "cov": 0.3, "residual": "20 kPa"}}
    slope = {"height": "10 m", "angle": "26.565 deg", "crest": "30 m", "plain": "30 m", "foundation": "10 m"}
    tables["geometry"] = {"slope": slope}
    look = look_at(Scene.model_validate(tables | {"name": "undrained", "text": ""}))
    assert look.peak.factor == pytest.approx(1.47, rel=0.01)
    assert look.spread / look.peak.factor == pytest.approx(0.3, rel=1e-3)


def test_negative_cross_correlation_narrows_the_scatter():
    spreads = [look_at(load_scene("ma2023", [f"field.cross_correlation={rho}"])).spread for rho in (-0.9, 0.0, 0.9)]
    assert spreads == sorted(spreads)


def test_friction_alone_brakes_a_slide_that_does_not_soften_as_it_does_a_block():
    """The column of bars stands on level ground: tan(19.8 deg), and hardly any cohesion."""
    look = look_at(load_scene("bui2008"))
    assert look.friction == pytest.approx(np.tan(np.radians(19.8)), rel=1e-3)
    assert look.time_scale == pytest.approx(np.sqrt(0.1 / (9.81 * look.friction)))


def test_residual_strength_brakes_less_and_falling_ground_still_less():
    """2 kPa and 5 degrees after any slip: 0.087 + 2 / (20 * 0.3 * 15) = 0.110; ground that falls by 1 in 30 less."""
    weak = ["soil.softening.slip_to_residual=1 mm", "soil.cohesion.residual=2 kPa"]
    falling = 'geometry={surface=[["0 m","22 m"],["20 m","22 m"],["35 m","7 m"],["95 m","5 m"]]}'
    assert look_at(load_scene("ma2023", weak)).friction == pytest.approx(0.1097, abs=1e-4)
    assert look_at(load_scene("ma2023", [*weak, falling])).friction == pytest.approx(0.1097 - 1 / 30, abs=1e-4)


def test_even_ground_that_falls_more_steeply_than_it_brakes_has_an_end():
    fan = 'geometry={surface=[["0 m","32 m"],["20 m","32 m"],["35 m","17 m"],["95 m","2 m"]], toe="35 m"}'
    assert look_at(load_scene("ma2023", [fan, "soil.softening.slip_to_residual=1 mm"])).friction == 0.05


def test_soil_that_does_not_soften_has_no_residual_factor():
    assert look_at(load_scene("bui2008")).residual is None


@dataclass
class Circle:
    factor: float


def look(peak, residual, spread=0.05):
    return FirstLook(slope_surface(15.0, 0.8, 20.0, 40.0, 4.0), 15.0, Circle(peak), Circle(residual), spread, 0.3)


@pytest.mark.parametrize(
    ("peak", "residual", "words"),
    [
        (0.73, 0.37, "Nearly every realization slides."),
        (0.73, 0.73, "Nearly every realization slides."),
        (0.8, 1.0, "What slides soon stops"),
        (1.0, 0.5, "Some realizations slide: 50 %"),
        (0.9, 0.5, "Most realizations slide: 98 % .*more where strength varies"),
        (1.05, 0.5, "Some realizations slide: 16 % .*fewer where strength varies"),
        (1.2, 0.5, "softening can start a slide"),
        (1.2, 1.1, "No realization is expected to slide."),
        (480.0, 0.4, "No realization is expected to slide."),
    ],
)
def test_the_factors_of_safety_are_told_as_what_will_happen(peak, residual, words):
    assert re.search(words, outlook(look(peak, residual)))


@pytest.mark.parametrize(
    ("peak", "residual", "words"),
    [
        (1.04, 0.5, "Some realizations slide: 21 % .*and more, perhaps most, where softening is as quick"),
        (1.1, 0.5, "even slopes with a factor of about 1.2 may slide"),
        (1.04, 1.0, "fewer where strength varies"),
        (1.27, 0.5, "softening can start a slide"),
    ],
)
def test_quick_softening_spreads_and_is_not_averaged_out(peak, residual, words):
    """Progressive failure: 60 of 60 slid at a factor of 1.04."""
    told = outlook(look(peak, residual), is_brittle=True)
    assert re.search(words, told)
    assert ("fewer" in told) == (residual >= 1.0)


@pytest.mark.parametrize(
    ("peak", "residual", "words"),
    [
        (1.06, 0.5, "Some realizations slide: 12 % .*and perhaps more, since softening may begin"),
        (1.06, 1.0, "fewer where strength varies"),
        (0.9, 0.5, "Most realizations slide: 98 % .*and perhaps more"),
    ],
)
def test_softening_within_a_slip_of_the_height_may_spread(peak, residual, words):
    """67 % slid at a factor of 1.06 where one strength everywhere foretells 26 %."""
    assert re.search(words, outlook(look(peak, residual), is_progressive=True))


@pytest.mark.parametrize(
    ("slip", "quickness"),
    [("0.5 m", (True, True)), ("1.5 m", (True, True)), ("4 m", (False, True)), ("16 m", (False, False))],
)
def test_how_quick_softening_is_depends_on_the_height(slip, quickness):
    """The slope is 15 m high."""
    scene = load_scene("ma2023", [f"soil.softening.slip_to_residual={slip}"])
    assert (is_brittle(scene, 15.0), is_progressive(scene, 15.0)) == quickness


@pytest.mark.parametrize(
    ("peak", "share", "words"),
    [
        (1.25, "11 %", "and perhaps more, since softening is quick here"),
        (1.49, "0.7 %", "fewer where strength varies .* was seen up to a factor of about 1.3, and 1.49 is beyond"),
    ],
)
def test_what_softening_may_add_depends_on_the_factor_of_safety(peak, share, words):
    """With a standard deviation of 0.2, factors of 1.25 and 1.49 lie 1.25 and 2.45 of them above 1."""
    told = outlook(look(peak, 0.5)._replace(spread=0.2), is_brittle=True)
    assert told.startswith(f"Some realizations slide: {share} if each had one strength everywhere")
    assert re.search(words, told)
    assert "perhaps most" not in told


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("3 kPa", 'but that is a pressure, and a length is needed, for instance "2 m".'),
        ("0.03", "but it must be a share or a length of the mean run-out"),
        ("150 %", "but it must be above 0, and a share below 100 %."),
        ("0 m", "but it must be above 0, and a share below 100 %."),
    ],
)
def test_an_accuracy_is_a_share_or_a_length(text, words):
    with pytest.raises(SceneError, match=re.escape(words)):
        load_scene("ma2023", [f"campaign.accuracy={text}"])


@pytest.mark.parametrize(("text", "metres"), [("3 %", 0.3), ("25 cm", 0.25)])
def test_an_accuracy_is_in_metres_of_a_mean(text, metres):
    asked = load_scene("ma2023", [f"campaign.accuracy={text}"]).campaign.accuracy
    assert tolerance(asked).metres(10.0) == pytest.approx(metres)


def test_who_asks_for_an_accuracy_is_told_what_the_first_runs_cost():
    scene = load_scene("ma2023", ["campaign.accuracy=3 %"])
    text = " ".join(first_look_text(scene, look_at(scene), field_size(scene)).split())
    assert "First 12 realizations with cells of 0.5 m and 32 of each cheaper model" in text
    assert "core-hours for all" not in text


def test_strength_that_grows_with_depth_makes_a_slope_safer_and_is_told():
    plain, grown = (load_scene("ma2023", more) for more in ([], ["soil.cohesion.gradient=2 kPa/m"]))
    assert look_at(grown).peak.factor > 1.2 * look_at(plain).peak.factor
    assert trend_words(grown) == "The mean peak cohesion grows by 2 kPa per metre of depth, from 20 kPa."
    assert trend_words(plain) is None
