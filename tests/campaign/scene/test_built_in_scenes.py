"""The built-in scenes have the numbers of their papers, and write out every key with a source."""

import tomllib
from math import pi, sqrt

import numpy as np
import pytest

from campaign.fields.properties import PROPERTIES, RESIDUALS
from campaign.scene import builtin_scenes, load_scene
from campaign.scene.scene import flatten
from campaign.simulation.scene_sampler import correlation_of


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


def test_the_scene_as_printed_differs_only_in_plain_method_and_field() -> None:
    ours, printed = (load_scene(name).identity() for name in ("ma2023", "ma2023-printed"))
    assert {key for key, _ in ours.items() ^ printed.items()} == {
        "geometry.slope.plain",
        "numerics.cell",
        "numerics.locking",
        "soil.softening.rate",
        "soil.softening.reference_cell",
        "soil.softening.internal_length",
        "field.horizontal",
        "field.length_kind",
    }


def test_the_field_as_printed_is_that_of_equations_1_and_2() -> None:
    """Isotropic, exp(-tau / theta) with a theta of four field cells, 1 m."""
    scene = load_scene("ma2023-printed")
    correlation = correlation_of(scene.field)
    lag = np.array([0.0, 0.5, 1.0, 3.0])
    none = np.zeros_like(lag)
    np.testing.assert_allclose(correlation(lag, none), np.exp(-lag))
    np.testing.assert_allclose(correlation(none, lag), np.exp(-lag))
    assert 4.0 * scene.field.resolution == 1.0


@pytest.mark.parametrize("name", builtin_scenes())
def test_built_in_scenes_write_out_every_key_and_a_source_for_each(name: str) -> None:
    scene = load_scene(name)
    given_keys = flatten(tomllib.loads(scene.text)).keys()
    own_or_none_in_the_paper = ("name", "text", "overrides", "geometry", "field.pairs", "layer", "water", "boring")
    only_elsewhere = {
        "soil.saturated_unit_weight",
        "soil.tension_cutoff",
        "soil.k0",
        *(row.gradient_key for row in PROPERTIES),
    }
    residual_or_share = {key for row in RESIDUALS for key in (row.mean_key, row.cov_key, row.share_key)}
    known = {key for key in flatten(scene.model_dump()) if not key.startswith(own_or_none_in_the_paper)}
    undrained = scene.soil.friction_angle is None
    known -= {"soil.friction_angle"} if undrained else set()
    one_of_the_two = {"soil.softening.reference_cell", "soil.softening.internal_length"}
    rate_or_slip = {"soil.softening.rate", "soil.softening.slip_to_residual"}
    assert (
        known - one_of_the_two - rate_or_slip - residual_or_share - only_elsewhere - {"campaign.accuracy"} <= given_keys
    )
    for row in RESIDUALS[:1] if undrained else RESIDUALS:
        assert (row.share_key in given_keys) != ({row.mean_key, row.cov_key} <= given_keys)
    assert len(one_of_the_two & given_keys) == len(rate_or_slip & given_keys) == 1
    values = [line for line in scene.text.split("\n") if "=" in line.partition("#")[0] and "title" not in line]
    assert all("# paper" in line or "# ours" in line for line in values)
