"""Whatever is written in a scene file, the answer is a list of sentences."""

import copy
from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st
from scene_complaints import EXAMPLE, found_in

from campaign.scene.document import key_lines
from campaign.scene.sections import FrictionAngle, Layer, SceneFile, Softening

JUNK = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-5, 5),
    st.sampled_from([10**4000, -(10**30), 1e300, 1e-300]),
    st.floats(),
    st.sampled_from(["", "1 m", "-3 kPa", "gimp", "20 deg", "1e9 s", "1e300 m", "1 m**9**9", "1 m\0", "kronecker"]),
    st.lists(st.sampled_from([[], ["0 m", "1 m"], ["1 m"], 3, "a"]), max_size=3),
    st.dictionaries(st.sampled_from(["mean", "height", "cell", "x"]), st.integers(), max_size=2),
)
KEYS = sorted({key[:n] for key in key_lines(EXAMPLE.text) for n in range(1, len(key) + 1)})


@settings(max_examples=300, deadline=None, derandomize=True)
@given(st.lists(st.tuples(st.sampled_from(KEYS), st.one_of(JUNK, st.just(...))), min_size=1, max_size=6))
def test_whatever_is_written_the_answer_is_a_list_of_sentences(changes: list[tuple[tuple[str, ...], Any]]) -> None:
    """Any keys replaced by anything or removed: never an exception, and every message ends as a sentence does."""
    tables = copy.deepcopy(EXAMPLE.tables)
    for (*sections, name), value in changes:
        table: Any = tables
        for section in sections:
            table = table.get(section, {}) if isinstance(table, dict) else {}
        if isinstance(table, dict):
            table.pop(name, None)
            if value is not ...:
                table[name] = copy.deepcopy(value)
    messages = found_in(tables)
    assert all(message.endswith((".", "?")) for message in messages)
    if not messages:
        SceneFile.model_validate(tables)


PARTS = st.dictionaries(st.sampled_from([*FrictionAngle.model_fields, *Softening.model_fields]), JUNK, max_size=3)
LAYER = st.dictionaries(st.sampled_from([*Layer.model_fields, "colour"]), st.one_of(JUNK, PARTS), max_size=5)
WITH_NAME = st.builds(lambda table, name: {"name": name, "top": "3 m"} | table, LAYER, st.sampled_from(["a", "b", "c"]))


@settings(max_examples=300, deadline=None, derandomize=True)
@given(st.lists(st.one_of(WITH_NAME, LAYER, JUNK), max_size=3), st.booleans())
def test_whatever_is_written_of_layers_the_answer_is_a_list_of_sentences(layers: list[Any], has_friction: bool) -> None:
    """Below soil with a friction angle, from which they may take it, and without."""
    tables = copy.deepcopy(EXAMPLE.tables) | {"layer": layers}
    if not has_friction:
        del tables["soil"]["friction_angle"]
        tables["soil"]["law"], tables["field"]["cross_correlation"] = "tresca", 0.0
    messages = found_in(tables)
    assert all(message.endswith((".", "?")) for message in messages)
    if not messages:
        SceneFile.model_validate(tables)
