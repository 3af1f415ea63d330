"""Scenes are refused whole: every mistake at once, with its place, its value and its remedy."""

from pathlib import Path

import pytest
from scene_complaints import complaint, complaints, line_of, written


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
        (
            "mesh.size=1 m",
            "the keys here are title, geometry, soil, layer, water, field, numerics, slide, receptor, boring, campaign",
        ),
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
        ("soil.cohesion.cov=-0.1", "it must not be negative"),
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
        # sizes
        ("soil.cohesion.cov=1e300", "1e+300, but nothing is of that size; give 0, or from 1e-15 to 1e+15."),
        ("soil.softening.rate=1e300", "nothing is of that size"),
        ("geometry.slope.height=1e300 m", "nothing is of that size; give 0, or from 1e-15 m to 1e+15 m."),
        ("campaign.discretisation_pairs=100000000000000000000000000000", "it must be at most 1,000,000,000."),
        ("campaign.realizations=100000000000000000000000000000", "it must be at most 1,000,000,000."),
        ("campaign.seed=10000000000000000000", "it must be below 2^63"),
        (f"campaign.seed={'9' * 5000}", "but a whole number without quotes is needed."),
        (f"{'.'.join('a' * 3000)}=1", "nested too deeply"),
        ('title="a\\u0000b"', '"a\\u0000b", but it must be a line of text without control characters.'),
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
    assert messages[0].startswith(f"--set {override.partition('=')[0]}"[:60])


@pytest.mark.parametrize(
    "text", ["a = " + "[" * 100_000, "a = " + "[" * 400 + "]" * 400, ".".join("a" * 3000) + " = 1"]
)
def test_nesting_without_end_is_a_sentence(tmp_path: Path, text: str) -> None:
    path = tmp_path / "slope.toml"
    path.write_text(text)
    assert complaint(source=path).startswith("slope.toml is not valid TOML: tables and lists are nested too deeply")


def test_a_number_without_end_is_a_sentence(tmp_path: Path) -> None:
    path = written(tmp_path, ("seed = 2023", f"seed = {'9' * 5000}"))
    assert complaint(source=path) == "slope.toml is not valid TOML: a number has thousands of digits."


def test_a_name_with_a_nul_is_a_sentence() -> None:
    assert complaint(source="a\0b").startswith('The scene "a\\u0000b" cannot be read: ')


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
