"""Scenes are read whole or refused whole: every mistake at once, with its place, its value and its remedy."""

import copy
import json
import pickle
import tomllib
from math import erfc, exp, log1p, pi, sqrt
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from campaign.errors import SceneError
from campaign.scene import Scene, builtin_scenes, differences, load_scene
from campaign.scene.check import mistakes
from campaign.scene.document import Document, key_lines, read_document
from campaign.scene.rules.soil import EXTREME_QUANTILE, largest_allowed_cov
from campaign.scene.scene import flatten
from campaign.scene.sections import SceneFile

EXAMPLE = read_document("ma2023")
SURFACE = [["0 m", "19 m"], ["20 m", "19 m"], ["35 m", "4 m"], ["75 m", "4 m"]]


def complaints(*overrides: str, source: str | Path = "ma2023") -> list[str]:
    with pytest.raises(SceneError) as refusal:
        load_scene(source, overrides)
    return refusal.value.messages


def complaint(*overrides: str, source: str | Path = "ma2023") -> str:
    messages = complaints(*overrides, source=source)
    assert len(messages) == 1, messages
    return messages[0]


def written(directory: Path, *changes: tuple[str, str]) -> Path:
    """Write ma2023 with parts of its text replaced."""
    text = EXAMPLE.text
    for old, new in changes:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    path = directory / "slope.toml"
    path.write_text(text, "utf-8")
    return path


def line_of(text: str, path: Path) -> int:
    return next(number for number, line in enumerate(path.read_text("utf-8").split("\n"), 1) if line.startswith(text))


def found_in(tables: dict[str, Any]) -> list[str]:
    return mistakes(Document("scene", "scene.toml", "", tables), SceneFile, EXAMPLE)


def test_ma2023_has_the_numbers_of_the_paper_in_si() -> None:
    """Ma, Rezania and Mousavi Nezhad, section 3."""
    scene = load_scene("ma2023")
    assert scene.geometry.slope is not None
    assert (scene.geometry.slope.height, scene.geometry.slope.angle) == (15.0, pytest.approx(pi / 4.0))
    assert (scene.soil.unit_weight, scene.soil.young_modulus, scene.soil.poisson_ratio) == (20e3, 100e6, 0.35)
    cohesion, friction = scene.soil.cohesion, scene.soil.friction_angle
    assert (cohesion.mean, cohesion.cov, cohesion.residual) == (20e3, 0.1, 10e3)
    assert (friction.mean, friction.cov, friction.residual) == (
        pytest.approx(pi / 18.0),
        0.1,
        pytest.approx(pi / 36.0),
    )
    assert (scene.field.horizontal, scene.field.vertical, scene.field.cross_correlation) == (20.0, 2.0, -0.5)
    assert (scene.numerics.end_time, scene.campaign.realizations) == (10.0, 1000)


def test_ma2023_printed_has_the_particle_count_of_the_paper() -> None:
    """Particles strictly below the ground, counted row by row, must be the paper's 10,090."""
    scene = load_scene("ma2023-printed")
    slope = scene.geometry.slope
    assert slope is not None
    spacing = scene.numerics.cell / sqrt(scene.numerics.particles_per_cell)
    width = slope.crest + slope.height + slope.plain
    foundation = round(width / spacing) * round(slope.foundation / spacing)
    rows = round(slope.height / spacing)
    above = rows * round(slope.crest / spacing) + sum(range(rows))
    assert foundation + above == 10_090


def test_the_scene_as_printed_differs_only_in_plain_and_method() -> None:
    ours, printed = (load_scene(name).identity() for name in ("ma2023", "ma2023-printed"))
    assert {key for key, _ in ours.items() ^ printed.items()} == {
        "geometry.slope.plain",
        "numerics.cell",
        "numerics.locking",
        "soil.softening.rate",
        "soil.softening.reference_cell",
        "soil.softening.internal_length",
    }


@pytest.mark.parametrize("name", builtin_scenes())
def test_built_in_scenes_write_out_every_key_and_a_source_for_each(name: str) -> None:
    scene = load_scene(name)
    given_keys = flatten(tomllib.loads(scene.text)).keys()
    known = flatten(scene.model_dump(exclude={"name", "text", "overrides", "geometry"})).keys()
    one_of_the_two = {"soil.softening.reference_cell", "soil.softening.internal_length"}
    assert known - one_of_the_two <= given_keys
    assert len(one_of_the_two & given_keys) == 1
    values = [line for line in scene.text.split("\n") if "=" in line.partition("#")[0] and "title" not in line]
    assert all("# paper" in line or "# ours" in line for line in values)


def test_a_scene_keeps_its_name_text_and_overrides_and_survives_pickling(tmp_path: Path) -> None:
    path = written(tmp_path)
    scene = load_scene(path, ["numerics.cell=0.5 m"])
    assert (scene.name, scene.text, scene.overrides) == ("slope", EXAMPLE.text, ("numerics.cell=0.5 m",))
    assert pickle.loads(pickle.dumps(scene)) == scene


def test_a_byte_order_mark_and_windows_line_ends_do_no_harm(tmp_path: Path) -> None:
    path = tmp_path / "slope.toml"
    path.write_bytes(EXAMPLE.text.replace("\n", "\r\n").encode("utf-8-sig"))
    assert load_scene(path).digest() == load_scene("ma2023").digest()


@pytest.mark.parametrize("value", ["0.5 m", '"0.5 m"', "50 cm", " 0.5 m "])
def test_overrides_work_with_and_without_the_quotes_a_shell_strips(value: str) -> None:
    assert load_scene("ma2023", [f"numerics.cell={value}"]).numerics.cell == 0.5


def test_the_last_of_two_overrides_wins() -> None:
    assert load_scene("ma2023", ["campaign.seed=1", "campaign.seed=2"]).campaign.seed == 2


def test_only_the_required_keys_need_to_be_written() -> None:
    tables = copy.deepcopy(EXAMPLE.tables)
    for section, kept in {"numerics": {"cell", "end_time"}, "campaign": set()}.items():
        tables[section] = {key: value for key, value in tables[section].items() if key in kept}
    for key in ("sampler", "resolution", "angle", "cross_correlation_of"):
        del tables["field"][key]
    assert found_in(tables) == []


def test_every_mistake_is_named_at_once_with_its_line(tmp_path: Path) -> None:
    path = written(
        tmp_path,
        ('mean = "20 kPa"', "mean = 20"),
        ('unit_weight = "20 kN/m^3"', 'unit_wight = "20 kN/m^3"'),
        ("realizations = 1000", "realizations = 0"),
        ('cell = "1 m" ', 'cell = "4 m" '),
        ('plain = "40 m"', 'plain = "-40 m"'),
    )
    messages = complaints(source=path)
    starts = [
        f'geometry.slope.plain (slope.toml, line {line_of("plain", path)}) is "-40 m", but it must be greater',
        f'soil.unit_wight (slope.toml, line {line_of("unit_wight", path)}): there is no key "unit_wight"; did you mean',
        f"soil.cohesion.mean (slope.toml, line {line_of('mean = 20', path)}) is 20, but a pressure needs its unit",
        f"campaign.realizations (slope.toml, line {line_of('realizations', path)}) is 0, but it must be 1 or more",
        f'numerics.cell (slope.toml, line {line_of("cell", path)}) is "4 m", but a slope of 15 m must be at least 4',
        f'geometry.slope.foundation (slope.toml, line {line_of("foundation", path)}) is "4 m", but it must span',
    ]
    assert len(messages) == len(starts)
    for start in starts:
        assert any(message.startswith(start) for message in messages), (start, messages)


def test_a_syntax_error_names_the_line_and_the_missing_quotes(tmp_path: Path) -> None:
    path = written(tmp_path, ('mean = "20 kPa"', "mean = 20 kPa"))
    message = complaint(source=path)
    assert f"(at line {line_of('mean = 20', path)}, column" in message
    assert "mean = 20 kPa" in message
    assert 'in quotes, for instance "20 kPa"' in message


def test_an_unknown_scene_lists_the_built_in_ones() -> None:
    message = complaint(source="ma2032")
    assert message.startswith(
        '"ma2032" is neither a file nor a built-in scene; built in are bui2008, ma2023, ma2023-printed.'
    )
    assert message.endswith('Did you mean "ma2023"?')


def test_a_file_that_is_not_text_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "slope.toml"
    path.write_bytes(b"title = '\xff\xfe'")
    assert "cannot be read" in complaint(source=path)


@pytest.mark.parametrize(
    ("override", "expected"),
    [
        # units
        (
            "numerics.cell=0.5",
            '--set numerics.cell is 0.5, but a length needs its unit and quotes, for instance "2 m".',
        ),
        ("soil.cohesion.mean=20 m", '"20 m", but that is a length, and a pressure is needed, for instance "20 kPa".'),
        ("soil.cohesion.mean=20 kpa", '"kpa" is not a unit'),
        # keys
        (
            "soil.cohesionn.mean=1 Pa",
            ': there is no key "cohesionn"; did you mean "cohesion"?',
        ),
        ("soil.cell=1 m", 'it belongs to another section, as "numerics.cell".'),
        ("mesh.size=1 m", "the keys here are title, geometry, soil, field, numerics, slide, campaign."),
        ("title.a=1", "--set title.a: title is a value, not a section"),
        ("nonsense", "--set nonsense has no key and value; write KEY=VALUE"),
        ("=1", "--set =1 has no key and value; write KEY=VALUE"),
        # types
        ("campaign.realizations=10.0", "10.0, but a whole number without quotes is needed."),
        ("campaign.seed=true", "true, but a whole number"),
        ("soil.poisson_ratio=35 %", '"35 %", but a number without unit and quotes is needed.'),
        ("numerics.flip=nan", "a finite number is needed"),
        ("numerics.end_time=1e999 s", "a finite number is needed"),
        ("soil.cohesion=5", "a section of keys is needed here"),
        ("numerics.basis=gimpp", '"gimpp", but it must be "gimp", "linear" or "bspline".'),
        # ranges
        ("geometry.slope.angle=90 deg", "between 0 deg and 90 deg"),
        ("field.vertical=0 m", "it must be greater than zero"),
        ("soil.cohesion.cov=0", "it must be greater than zero"),
        ("soil.poisson_ratio=0.5", "at least 0 and below 0.5"),
        ("soil.dilation_angle=-1 deg", "it must not be negative"),
        ("soil.softening.rate=0", "it must be greater than zero"),
        ("field.cross_correlation=-1", "between -1 and 1, both excluded"),
        ("numerics.particles_per_cell=5", "it must be 1, 4, 9 or 16"),
        ("numerics.particles_per_cell=true", "whole number"),
        ("numerics.courant=0", "above 0 and at most 1.5"),
        ("numerics.flip=1.01", "between 0 and 1"),
        ("numerics.end_time=0 s", "it must be greater than zero"),
        ("campaign.minimum=9", "it must be 10 or more"),
        ("campaign.confidence=95", "95, but it must lie between 0 and 1, both excluded; 95 % is written 0.95."),
        ("campaign.seed=-1", "it must not be negative"),
        # pairs
        ("soil.cohesion.residual=21 kPa", "it must not exceed the mean peak cohesion, 20 kPa"),
        ("soil.friction_angle.residual=11 deg", "it must not exceed the mean peak friction angle, 10 deg"),
        ("soil.dilation_angle=6 deg", "it must not exceed the residual friction angle, 5 deg"),
        ("soil.friction_angle.cov=0.5", "would then reach 90 deg; use less than 0.433."),
        ("field.sampler=kronecker", 'is no product of a horizontal and a vertical one; use "auto" or "circulant"'),
        ("field.resolution=1.5 m", "use at most 1 m"),
        ("numerics.cell=3.8 m", "use at most 3.75 m"),
        ("geometry.slope.crest=1 m", '"1 m", but it must span at least 2 cells of 1 m; use at least 2 m'),
        ("numerics.output_interval=20 s", "the run ends at 10 s"),
    ],
)
def test_an_impossible_value_is_refused_with_its_remedy(override: str, expected: str) -> None:
    messages = complaints(override)
    assert any(expected in message for message in messages), messages
    assert messages[0].startswith(f"--set {override.partition('=')[0]}")


def test_a_rotated_field_is_not_separable() -> None:
    overrides = ("field.correlation=squared-exponential", "field.sampler=kronecker")
    assert load_scene("ma2023", overrides).field.sampler == "kronecker"
    assert "rotated by 30 deg" in complaint(*overrides, "field.angle=30 deg")


def test_a_ramp_must_end_within_the_run() -> None:
    load_scene("ma2023", ["numerics.ramp_time=11 s"])
    assert "before gravity is whole" in complaint("numerics.gravity=ramp", "numerics.ramp_time=11 s")


@pytest.mark.parametrize(("cov", "lowest"), [(0.1, -0.990), (0.2, -0.962), (0.3, -0.917), (0.5, -0.80)])
def test_two_lognormal_fields_cannot_have_any_correlation(cov: float, lowest: float) -> None:
    """The bound is (exp(-s^2) - 1) / COV^2: two comonotone lognormal variables of opposite sign."""
    assert (exp(-log1p(cov**2)) - 1.0) / cov**2 == pytest.approx(lowest, abs=5e-4)
    same = ("field.cross_correlation_of=lognormal", f"soil.cohesion.cov={cov}", f"soil.friction_angle.cov={cov}")
    mean = "soil.friction_angle.mean=6 deg"
    just_above, just_below = (f"field.cross_correlation={lowest + step}" for step in (0.001, -0.001))
    refusals = [message for message in _any_complaints(*same, mean, just_above) if "cross-correlation" in message]
    assert refusals == []
    assert any("can only have a cross-correlation between" in text for text in _any_complaints(*same, mean, just_below))


def test_the_cell_average_needs_a_narrow_basis() -> None:
    """Limit loads with both are 5 % and more too low (verification/test_limit_loads)."""
    text = complaint("numerics.basis=bspline", "numerics.locking=cell-average")
    assert 'use the basis "gimp"' in text


def test_the_time_step_suits_basis_and_stress_update() -> None:
    """The limits are those that tests/stability measures."""
    load_scene("ma2023", ["numerics.courant=0.9"])
    assert "creates energy beyond 0.9; use at most that" in complaint("numerics.courant=0.95")
    assert "beyond 0.4" in complaint("numerics.stress_update=usl")
    assert "unstable at every" in complaint("numerics.basis=linear", "numerics.stress_update=usl")


def test_a_single_particle_in_a_cell_never_rests() -> None:
    one = "numerics.particles_per_cell=1"
    load_scene("ma2023", [one, "numerics.gravity=ramp"])
    assert "never comes to rest under its own weight" in complaint(one)


def test_gaussian_fields_can_have_any_correlation() -> None:
    strong = ("field.cross_correlation=-0.95", "soil.cohesion.cov=0.3", "soil.friction_angle.cov=0.3")
    load_scene("ma2023", strong)
    assert "between -0.917 and" in complaint(*strong, "field.cross_correlation_of=lognormal")


def _any_complaints(*overrides: str) -> list[str]:
    try:
        load_scene("ma2023", overrides)
    except SceneError as refusal:
        return refusal.messages
    return []


def test_the_extreme_quantile_is_rare_in_a_field() -> None:
    """1e5 values, were they independent, exceed it with a probability below 1 %; the bound solves for 90 deg."""
    assert 1e5 * 0.5 * erfc(EXTREME_QUANTILE / sqrt(2.0)) < 0.01
    s = sqrt(log1p(largest_allowed_cov(10.0, 90.0) ** 2))
    assert 10.0 * exp(EXTREME_QUANTILE * s - s**2 / 2.0) == pytest.approx(90.0)


def test_softening_needs_a_rate_only_if_it_has_a_law(tmp_path: Path) -> None:
    without = written(tmp_path, ("rate = 0.189 ", "# rate = 0.189 "))
    assert "is not given, but the exponential law needs it" in complaint(source=without)
    assert load_scene(without, ["soil.softening.law=none"]).soil.softening.rate_at(1.0) == 0.0


def test_the_softening_rate_grows_with_the_cell() -> None:
    softening = load_scene("ma2023-printed").soil.softening
    assert softening.rate_at(0.5) == softening.rate
    assert softening.rate_at(1.0) == 2.0 * softening.rate_at(0.5)


def test_an_internal_length_takes_the_place_of_the_reference_cell(tmp_path: Path) -> None:
    softening = load_scene("ma2023").soil.softening
    assert softening.rate_at(0.5) == softening.rate_at(1.0) == softening.rate
    assert "leave out one of the two" in complaint("soil.softening.reference_cell=1 m")
    assert 'or internal_length = "1 m"' in complaint(source=written(tmp_path, ("internal_length = ", "# ")))


def test_a_missing_key_comes_with_an_example(tmp_path: Path) -> None:
    path = written(tmp_path, ('horizontal = "20 m" ', "# "))
    section = line_of("[field]", path)
    assert complaint(source=path) == (
        f'field (slope.toml, line {section}) has no horizontal; add it, for instance horizontal = "20 m".'
    )


def test_missing_sections_come_with_an_example(tmp_path: Path) -> None:
    path = tmp_path / "empty.toml"
    path.write_text("")
    messages = complaints(source=path)
    assert [message.split(";")[0] for message in messages] == [
        f"empty.toml has no {key}" for key in ("title", "geometry", "soil", "field", "numerics", "campaign")
    ]
    assert 'a section [numerics], for instance with cell = "1 m", end_time = "10 s"' in messages[4]


def test_a_surface_can_replace_the_slope() -> None:
    tables = EXAMPLE.tables | {"geometry": {"surface": SURFACE}}
    assert found_in(tables) == []


def test_slope_and_surface_contradict_each_other() -> None:
    message = complaint(f"geometry.surface={json.dumps(SURFACE)}")
    assert "geometry.slope (ma2023.toml, line" in message
    assert "and --set geometry.surface contradict each other; remove one of them." in message


def test_a_slope_or_a_surface_is_needed() -> None:
    assert "geometry.slope (scene.toml) is not given" in found_in(EXAMPLE.tables | {"geometry": {}})[0]


@pytest.mark.parametrize(
    ("surface", "expected"),
    [
        ([], "have two points or more"),
        ([["0 m", "19 m"]], "have two points or more"),
        ([["1 m", "19 m"], ["20 m", "4 m"]], "start at x = 0"),
        ([["0 m", "19 m"], ["20 m", "4 m"], ["10 m", "4 m"]], "go from left to right"),
        ([["0 m", "19 m"], ["20 m", "-1 m"]], "stay above the base"),
        ([["0 m", "4 m"], ["20 m", "19 m"]], "end lower than it starts"),
    ],
)
def test_a_surface_falls_from_left_to_right_above_the_base(surface: list[list[str]], expected: str) -> None:
    (message,) = found_in(EXAMPLE.tables | {"geometry": {"surface": surface}})
    assert f"it must {expected}" in message


def test_a_surface_may_have_a_vertical_face() -> None:
    surface = [["0 m", "9 m"], ["5 m", "9 m"], ["5 m", "4 m"], ["20 m", "4 m"]]
    assert found_in(EXAMPLE.tables | {"geometry": {"surface": surface}}) == []


def test_a_slope_that_just_fits_its_cells_is_accepted() -> None:
    load_scene("ma2023", ["geometry.slope.height=4 m", "geometry.slope.crest=2 m"])


def test_what_counts_as_a_slide_must_suit_the_height() -> None:
    assert "slide.displaced" in complaint("slide.displaced=2 m")
    assert "a slope of 15 m can fail without moving that far" in complaint("slide.failed=15 m")
    column = [["0 m", "0.1 m"], ["0.2 m", "0.1 m"], ["0.2 m", "0 m"], ["0.8 m", "0 m"]]
    (message,) = found_in(read_document("bui2008").tables | {"slide": {}, "geometry": {"surface": column}})
    assert message.startswith("slide.failed (scene.toml) is not given, but a slope of 0.1 m can fail")


def test_a_wrong_point_is_named_by_its_number() -> None:
    surface = [*SURFACE[:2], ["35 m", 4], ["75 m"], ["1 m", "2 m", "3 m"]]
    unit, short, long = found_in(EXAMPLE.tables | {"geometry": {"surface": surface}})
    assert "point 3) is 4, but a length needs its unit" in unit
    assert 'point 4) is ["75 m"], but a point has two coordinates' in short
    assert "point 5)" in long
    assert "a point has two coordinates" in long


def test_a_surface_too_flat_for_its_cells_is_refused() -> None:
    (message,) = found_in(EXAMPLE.tables | {"geometry": {"surface": [["0 m", "6 m"], ["20 m", "4 m"]]}})
    assert "numerics.cell" in message
    assert "a slope of 2 m must be at least 4 cells high; use at most 0.5 m" in message


def test_the_line_of_a_key_is_found_among_sections_arrays_and_comments() -> None:
    text = 'title = "a"\n[geometry] # [soil]\nsurface = [\n  ["0 m", "1 m"],\n]\n'
    text += '[ soil . cohesion ]\n"mean" = 1\na.b = 2\n'
    assert key_lines(text) == {
        ("title",): 1,
        ("geometry",): 2,
        ("geometry", "surface"): 3,
        ("soil",): 6,
        ("soil", "cohesion"): 6,
        ("soil", "cohesion", "mean"): 7,
        ("soil", "cohesion", "a"): 8,
        ("soil", "cohesion", "a", "b"): 8,
    }


def test_what_decides_a_realization_changes_its_identity() -> None:
    digest = load_scene("ma2023").digest()
    for override in ("numerics.cell=0.5 m", "soil.cohesion.mean=21 kPa", "campaign.seed=1", "field.angle=1 deg"):
        assert load_scene("ma2023", [override]).digest() != digest


@pytest.mark.parametrize(
    "override",
    [
        "title=other",
        "campaign.realizations=10",
        "campaign.minimum=20",
        "campaign.realization_timeout=2 h",
        "campaign.confidence=0.9",
        "numerics.cell=100 cm",
        "numerics.flip=1",
    ],
)
def test_stopping_rules_and_ways_of_writing_leave_the_identity(override: str) -> None:
    assert load_scene("ma2023", [override]).digest() == load_scene("ma2023").digest()


def test_the_identity_survives_json_bit_for_bit() -> None:
    scene = Scene.model_validate(
        EXAMPLE.tables | {"geometry": {"surface": SURFACE}, "name": "a", "text": "", "overrides": ()}
    )
    assert json.loads(json.dumps(scene.identity())) == scene.identity()
    assert scene.identity()["geometry.surface"][0] == [0.0, 19.0]


def test_differences_are_sentences() -> None:
    here = {"numerics.cell": 0.5, "campaign.seed": 1, "field.resolution": 0.25}
    there = {"numerics.cell": 1.0, "campaign.seed": 1}
    assert differences(here, there) == [
        "field.resolution is 0.25 here but absent in the results directory",
        "numerics.cell is 0.5 here but 1.0 in the results directory",
    ]
    assert differences(here, here) == []


JUNK = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-5, 5),
    st.floats(),
    st.sampled_from(["", "1 m", "-3 kPa", "gimp", "20 deg", "1e9 s", "kronecker"]),
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
