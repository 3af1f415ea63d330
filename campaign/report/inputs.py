"""Which inputs matter, in sentences and rows, for the terminal and the report."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from campaign.fields.properties import BY_NAME
from campaign.record import FINAL_RUNOUT, Status
from campaign.results.results import Results
from campaign.results.sensitivity import Outcome, effects_of, map_of, ranking_of
from campaign.scene.inputs import MORE, Input, by_key, raised, shown
from campaign.statistics import sensitivity
from campaign.statistics.changed_inputs import InputEffects
from campaign.statistics.intervals import Interval
from campaign.statistics.sensitivity import Ranking
from campaign.statistics.sensitivity_map import SensitivityMap
from campaign.statistics.wording import chance
from campaign.terminal import counted, listing

TENTH = f"{100 * MORE:g} % more"

NAMED = 3
"""Inputs that are named in a sentence."""


UNKNOWN = "not known: the runs failed or the wall ahead was in their way"


class EffectRow(NamedTuple):
    """An input, its values, what more of it changes, and what one standard deviation does where the scene gives one."""

    name: str
    values: str
    change: str
    pairs: str
    per_deviation: str


class PropertyRow(NamedTuple):
    """A random property: correlation and regression of an outcome, and the change by more of it everywhere."""

    name: str
    correlation: str
    regression: str
    everywhere: str


class PropertyTable(NamedTuple):
    """What follows the random properties, and a row for each of these."""

    outcome: str
    rows: list[PropertyRow]


def sentences(results: Results) -> list[str]:
    """Return what can be said about the inputs, the most important first."""
    named = names(results)
    told = [
        _largest(results),
        _followed("Whether the slope slides", ranking_of(results.data, "slide"), named),
        _followed("The run-out of a slide", ranking_of(results.data, "runout"), named),
        _mapped(results, map_of(results.data)),
        _left_out(results, ranking_of(results.data, "runout")),
    ]
    return [sentence for sentence in told if sentence] or [_nothing(results)]


def names(results: Results) -> list[str]:
    """Return what the random properties are called."""
    return [BY_NAME[name].long_name for name in results.data["property"].values] if "property" in results.data else []


def effect_rows(results: Results) -> list[EffectRow]:
    """Return a row for each input, that with the largest effect first."""
    found = effects_of(results)
    if found is None:
        return []
    standing = _stood(results, found)
    return [_effect_row(results, key, effect, standing[key]) for key, effect in found.ranked().items()]


def property_tables(results: Results) -> list[PropertyTable]:
    """Return how sliding and run-out follow the random properties; an outcome that is not known well enough is not."""
    tables = [
        PropertyTable("whether the slope slides", property_rows(results, "slide")),
        PropertyTable("the run-out", property_rows(results, "runout")),
    ]
    return [table for table in tables if table.rows]


def property_rows(results: Results, outcome: Outcome) -> list[PropertyRow]:
    """Return a row for each random property; without enough slides there is none."""
    ranking, found = ranking_of(results.data, outcome), map_of(results.data) if outcome == "runout" else None
    if ranking is None:
        return []
    everywhere = [""] * len(ranking.correlation) if found is None else [_changed(each) for each in found.everywhere]
    rows = zip(names(results), ranking.correlation, ranking.regression, everywhere, strict=True)
    return [PropertyRow(name, _signed(alone), _signed(joint), total) for name, alone, joint, total in rows]


def _effect_row(results: Results, key: str, effect: Interval, standing: int) -> EffectRow:
    changed, scene = by_key(results.scene)[key], results.scene
    value, cov = changed.value(scene) or 0.0, changed.cov(scene)
    values = f"{shown(raised(scene, changed), changed)} instead of {shown(value, changed)}"
    is_in_proportion = cov and effect.n and not standing  # where slopes stand with more of it, the effect is not
    deviation = f"{_changed(_times(effect, cov / MORE))} for {100 * cov:g} %" if cov and is_in_proportion else ""
    return EffectRow(changed.name, values, _changed(effect, standing), str(effect.n), deviation)


def _stood(results: Results, found: InputEffects) -> dict[str, int]:
    """Return how many of the slides that were computed again no longer slid with more of each input."""
    runouts = results.data[FINAL_RUNOUT[results.scene.slide.front]].values[[*found.realizations]]
    has_lost_all = np.isclose(found.differences, -runouts, rtol=0.0, atol=1e-9)
    return dict(zip(found.keys, np.count_nonzero(has_lost_all, axis=1).tolist(), strict=True))


def _no_longer_slide(standing: Mapping[str, int], slides: int, named: Mapping[str, Input]) -> str:
    """Say with more of which inputs slopes stand."""
    told = [f"{count} with {TENTH} {named[key].name}" for key, count in standing.items() if count]
    return f" Of {counted(slides, 'slide')} no longer slide at all: {listing(told)}." if told else ""


def _times(effect: Interval, factor: float) -> Interval:
    """Return a positive multiple of an effect."""
    return Interval(factor * effect.estimate, factor * effect.lower, factor * effect.upper, effect.n)


def _largest(results: Results) -> str:
    """Name the inputs that change the run-out most, of those whose effect can be told from none."""
    found = effects_of(results)
    known = {} if found is None else found.known()
    if found is None or not known:
        return ""
    slides, whole = len(found.realizations), min(effect.n for effect in known.values())
    of_all = f"Of {counted(len(known), 'input')}, each raised alone by {100 * MORE:g} %,"
    unhindered = f", {whole} or more without the wall ahead or a failure in the way" if whole < slides else ""
    again = f"{counted(slides, 'slide')} {'was' if slides == 1 else 'were'} computed again for each{unhindered}."
    standing, named = _stood(results, found), by_key(results.scene)
    clear = {key: effect for key, effect in known.items() if standing[key] or key in found.clear()}
    if not clear:
        return (
            f"{of_all} none has an effect on the run-out of a slide that can be told from none: {again} A larger "
            "campaign.sensitivity_pairs may tell more."
        )
    (key, effect), *others = [*clear.items()][:NAMED]
    then = " and ".join(f"{named[other].name}, {_changed(each, standing[other])}" for other, each in others)
    next_come = f"; next {'comes' if len(others) == 1 else 'come'} {then}" if others else ""
    unclear = [each for each in known if each not in clear]
    most = "most" if not unclear else "most of those whose effect can be told from none"
    return (
        f"{of_all} {named[key].name} changes the run-out of a slide {most}, by {_changed(effect, standing[key])}"
        f"{next_come}.{_no_longer_slide(standing, slides, named)}{_unclear(unclear, named)}"
        f" {again[0].upper()}{again[1:]}"
    )


def _unclear(keys: list[str], named: Mapping[str, Input]) -> str:
    """Name the inputs whose effect cannot be told from none, which may be large for all that."""
    if not keys:
        return ""
    them = listing([named[key].name for key in keys])
    return f" {them[0].upper()}{them[1:]} {'has an effect' if len(keys) == 1 else 'have effects'} lost in the scatter."


def _followed(what: str, ranking: Ranking | None, named: list[str]) -> str:
    """Say which property an outcome follows most closely."""
    if ranking is None:
        return ""
    place = int(np.argmax([abs(each.estimate) for each in ranking.correlation]))
    closest = ranking.correlation[place]
    most = " most closely" if len(named) > 1 else ""
    follows = f"follows the mean {named[place]} of all the ground that moves{most}"
    means = {1: "that mean explains", 2: "both means together explain"}.get(
        len(named), f"all {len(named)} means together explain"
    )
    if closest.lower <= 0 <= closest.upper:
        return _followed_together(what, ranking, named)
    bounds = f"{closest.estimate:+.2f}, between {closest.lower:+.2f} and {closest.upper:+.2f}"
    return f"{what} {follows} (rank correlation {bounds}); {means} {_share(ranking.explained)}."


def _followed_together(what: str, ranking: Ranking, named: list[str]) -> str:
    """Say which property an outcome follows where the others stay the same, as none is seen to count by itself."""
    clear = {
        name: each for name, each in zip(named, ranking.regression, strict=True) if not each.lower <= 0 <= each.upper
    }
    if not clear:
        return f"{what} does not visibly follow the mean of a random property over all the ground that moves."
    closest = max(clear, key=lambda name: abs(clear[name].estimate))
    return (
        f"{what} follows the mean {closest} of all the ground that moves most closely where the others stay the same "
        f"(regression {_signed(clear[closest])}); alone none is seen to matter, as they vary together."
    )


def _mapped(results: Results, found: SensitivityMap | None) -> str:
    """Say how much it matters where the ground is strong, and where most."""
    if found is None:
        return ""
    if found.explained <= 0 or not found.is_clear.any():
        return "Which places of the ground are strong does not visibly matter to the run-out."
    clear = np.where(found.is_clear, found.change, 0.0)
    places = [np.unravel_index(extreme(clear), clear.shape) for extreme in (np.argmin, np.argmax)]
    told = [_at(results, place, float(clear[place])) for place in places if clear[place]]
    width, height = (float(np.diff(results.data[f"box_{axis}"].values[:2])[0]) for axis in "xy")
    return (
        f"The same properties place by place, instead of their means, explain {_share(found.explained)} of the "
        f"run-out: {TENTH} in a box of {width:.1f} m by {height:.1f} m changes it by {' and '.join(told)}."
    )


def _left_out(results: Results, ranking: Ranking | None) -> str:
    """Say which slides have no part in what the soil makes of the run-out, and which have less than they might."""
    given, unsettled = results.outcomes, results.by_status()[Status.not_settled]
    told = []
    if ranking is not None and given.slides - ranking.correlation[0].n >= given.hindered > 0:
        told.append(
            f"What the soil makes of the run-out is told without the {given.hindered:,} of "
            f"{counted(given.slides, 'slide')} that the wall ahead stopped; with their whole run-outs it may be "
            "another."
        )
    if unsettled and (ranking is not None or effects_of(results) is not None):
        whose, count = ("slide whose front", "counts") if unsettled == 1 else ("slides whose fronts", "count")
        told.append(
            f"{unsettled:,} {whose} may have come farther after the end {count} with the distance until then, also "
            "where slides are computed again with more of an input."
        )
    return " ".join(told)


def _at(results: Results, place: tuple[np.intp, ...], change: float) -> str:
    number, row, column = place
    x, y = float(results.data["box_x"][column]), float(results.data["box_y"][row])
    return f"{change:+.2f} m ({names(results)[number]} around x = {x:.0f} m, {y:.0f} m above the base)"


def _share(explained: float) -> str:
    return f"{chance(explained)} of the scatter" if explained > 0 else "nothing of the scatter"


def _nothing(results: Results) -> str:
    """Say why nothing is known of the inputs."""
    slides, stopped = results.outcomes.unhindered, results.outcomes.hindered
    which = " that the wall ahead does not stop" if stopped else ""
    matters = "which property of the soil matters"
    soil = f"It takes {sensitivity.FEWEST} slides{which} to say {matters}, and there are {slides:,}"
    if slides >= sensitivity.FEWEST:
        soil = f"The {counted(slides, 'slide')}{which} do not say {matters}"
    return f"{soil}; {_why_no_effects(results)}."


def _why_no_effects(results: Results) -> str:
    """Say why no slide was computed again with more of an input."""
    if not results.scene.campaign.sensitivity_pairs:
        return "what the inputs do is computed with campaign.sensitivity_pairs above 0"
    if not results.outcomes.slides:
        return "what the inputs do is told by slides computed again, and nothing slid"
    if results.outcomes.hindered == results.outcomes.slides:
        return "what the inputs do is told by slides that the wall ahead does not stop, and it stopped all of them"
    return "the slides to say what the inputs do were not computed again"


def _changed(change: Interval, standing: int = 0) -> str:
    """Write a change of the run-out with its bounds, "-1.39 m (-1.58 to -1.20 m)".

    Where some slopes stand and others slide, Student's t bounds nothing: a slope loses no more than its run-out.
    """
    if change.n == 0:
        return UNKNOWN
    if 0 < standing < change.n:
        return f"{change.estimate:+.2f} m ({standing} of {change.n} slides then stand)"
    bounds = f"{change.lower:+.2f} to {change.upper:+.2f} m" if change.is_known else "too few slides for an interval"
    return f"{change.estimate:+.2f} m ({bounds})"


def _signed(number: Interval) -> str:
    """Write a correlation or a coefficient with its bounds."""
    return f"{number.estimate:+.2f} ({number.lower:+.2f} to {number.upper:+.2f})"
