"""Whatever is written in a scene file, the answer is a list of sentences, or a scene that can be run."""

import copy
import json
import re
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scene_complaints import EXAMPLE, found_in

from campaign.scene import Scene
from campaign.scene.boring_data import impossible_data
from campaign.scene.cost import (
    core_seconds,
    dataset_bytes,
    particle_count,
    rank_bytes,
    realization_seconds,
    step_count,
    time_step,
)
from campaign.scene.document import key_lines
from campaign.scene.foresight import MANY_HOURS, large_campaign
from campaign.scene.limits import COPIES, YEAR, refusals
from campaign.scene.sections import FrictionAngle, Layer, Softening

MEMORY = 16e9
NUMBER = re.compile(r"[+-]?\d+(\.\d+)?")
JUNK = st.one_of(
    st.booleans(),
    st.integers(-5, 5),
    st.sampled_from([10**4000, -(10**30), 1e300, 1e-300]),
    st.floats(),
    st.sampled_from(["", "1 m", "-3 kPa", "gimp", "20 deg", "1e9 s", "1e300 m", "1 m**9**9", "1 m\0", "kronecker"]),
    st.lists(st.sampled_from([[], ["0 m", "1 m"], ["1 m"], 3, "a"]), max_size=3),
    st.dictionaries(st.sampled_from(["mean", "height", "cell", "x"]), st.integers(), max_size=2),
)


def _inner(table: Any, name: str | int) -> Any:
    if isinstance(table, dict):
        return table.get(name, {})
    return table[name] if isinstance(table, list) and isinstance(name, int) and len(table) > name else {}


POWERS = st.integers(-12, 12)
OF_A_SITE: list[tuple[Any, ...]] = [
    *(("soil", "cohesion", name) for name in ("gradient", "residual_gradient", "residual_share")),
    ("soil", "friction_angle", "gradient"),
    ("soil", "tension_cutoff"),
    ("soil", "k0"),
    *(("boring", 0, name) for name in ("name", "x", "by", "noise", "cohesion", "friction_angle")),
    ("boring",),
]
OF_EXAMPLE = sorted({key[:n] for key in key_lines(EXAMPLE.text) for n in range(1, len(key) + 1)})
KEYS = [*OF_EXAMPLE, *OF_A_SITE]
BORING = {"name": "B1", "x": "30 m", "cohesion": [["1 m", "20 kPa"]]}
"""For keys that the example does not have."""

QUANTITIES = [key for key in OF_EXAMPLE if NUMBER.match(str(EXAMPLE.value(key)))]
Change = tuple[tuple[Any, ...], Callable[[Any], Any]]


def replaced(value: Any) -> Callable[[Any], Any]:
    return lambda _: copy.deepcopy(value)


def scaled(power: int) -> Callable[[Any], Any]:
    """Multiply a number by a power of ten, whatever its unit; the slip of a pen, or of a unit."""

    def scale(value: Any) -> Any:
        if isinstance(value, str):
            return NUMBER.sub(lambda number: f"{number[0]}e{power}", value, count=1)
        return type(value)(value * 10.0**power) if isinstance(value, int | float) else value

    return scale


def removed(_: Any) -> Any:
    return ...


JUNKED = st.lists(
    st.tuples(st.sampled_from(KEYS), st.one_of(JUNK.map(replaced), st.just(removed))),
    min_size=1,
    max_size=6,
)
SCALED = st.lists(st.tuples(st.sampled_from(QUANTITIES), POWERS.map(scaled)), min_size=1, max_size=3)
PARTS = st.dictionaries(st.sampled_from([*FrictionAngle.model_fields, *Softening.model_fields]), JUNK, max_size=3)
LAYER = st.dictionaries(st.sampled_from([*Layer.model_fields, "colour"]), st.one_of(JUNK, PARTS), max_size=5)
WITH_NAME = st.builds(lambda table, name: {"name": name, "top": "3 m"} | table, LAYER, st.sampled_from(["a", "b", "c"]))
LAYERS = st.lists(st.one_of(WITH_NAME, LAYER, JUNK), max_size=3)


def changed(changes: list[Change]) -> dict[str, Any]:
    """Return the tables of the example with some of its keys replaced or removed."""
    tables = copy.deepcopy(EXAMPLE.tables) | {"boring": [dict(BORING)]}
    for (*sections, name), change in changes:
        table: Any = tables
        for section in sections:
            table = _inner(table, section)
        if isinstance(table, dict):
            value = change(table.pop(name, None))
            if value is not ...:
                table[name] = value
    return tables


def layered(layers: list[Any], has_friction: bool) -> dict[str, Any]:
    """Return the tables of the example with layers below soil with a friction angle, or without."""
    tables = copy.deepcopy(EXAMPLE.tables) | {"layer": layers}
    if not has_friction:
        del tables["soil"]["friction_angle"]
        tables["soil"]["law"], tables["field"]["cross_correlation"] = "tresca", 0.0
    return tables


OF_KEYS, OF_POWERS, OF_LAYERS = JUNKED.map(changed), SCALED.map(changed), st.builds(layered, LAYERS, st.booleans())


def assert_sensible(tables: dict[str, Any]) -> None:
    """The answer ends as sentences do; where there is none, it is a scene of finite numbers that somebody may wait for.

    That is: it fits into the memory, its realizations take less than a year, and a campaign of many years is remarked
    on, or else `validate` refuses it with a sentence.
    """
    messages = found_in(tables)
    assert all(message.endswith((".", "?")) for message in messages)
    if messages:
        return
    scene = Scene.model_validate(tables | {"name": "scene", "text": "", "overrides": ()})
    if impossible := [*impossible_data(scene)]:
        assert all(complaint for _, complaint in impossible)
        return
    json.dumps(scene.identity(), allow_nan=False)
    if refused := refusals(scene, MEMORY):
        assert all(complaint.text for complaint in refused)
        return
    sizes = particle_count(scene), step_count(scene), time_step(scene), dataset_bytes(scene), scene.front_area
    assert all(0.0 < size < 1e15 for size in sizes)
    assert max(rank_bytes(scene), COPIES * dataset_bytes(scene)) <= MEMORY
    assert realization_seconds(scene) <= YEAR
    assert core_seconds(scene) <= 3600.0 * MANY_HOURS or large_campaign(scene)


@settings(max_examples=75, deadline=None, derandomize=True)
@given(OF_KEYS)
def test_whatever_is_written_the_answer_is_a_list_of_sentences(tables: dict[str, Any]) -> None:
    """Any keys replaced by anything or removed: never an exception."""
    assert_sensible(tables)


@settings(max_examples=75, deadline=None, derandomize=True)
@given(OF_LAYERS)
def test_whatever_is_written_of_layers_the_answer_is_a_list_of_sentences(tables: dict[str, Any]) -> None:
    assert_sensible(tables)


@settings(max_examples=50, deadline=None, derandomize=True)
@given(OF_POWERS)
def test_a_slip_of_powers_of_ten_is_refused_or_can_be_run(tables: dict[str, Any]) -> None:
    assert_sensible(tables)


@pytest.mark.slow
@settings(max_examples=1000, deadline=None, derandomize=True)
@given(st.one_of(OF_KEYS, OF_LAYERS, OF_POWERS))
def test_of_a_thousand_scenes_none_is_absurd(tables: dict[str, Any]) -> None:
    assert_sensible(tables)
