"""Pairs of random soil properties in a scene: each named once, both random, and possible together."""

import pickle
from pathlib import Path

import pytest
from scene_complaints import UNDRAINED, complaint, complaints, line_of, written

from campaign.scene import load_scene

RANDOM = ("soil.cohesion.residual_cov=0.3", "soil.friction_angle.residual_cov=0.2")
HALF = "field.pairs.cohesion.cohesion_residual=0.5"


def test_a_scene_gives_the_cross_correlation_of_each_pair(tmp_path: Path) -> None:
    path = written(
        tmp_path,
        (
            "[numerics]",
            "[field.pairs]\ncohesion.cohesion_residual = 0.5\nfriction_angle_residual.cohesion = -0.2\n\n[numerics]",
        ),
    )
    scene = load_scene(path, RANDOM)
    assert scene.field.cross_correlations() == {
        ("cohesion", "friction_angle"): -0.5,
        ("cohesion", "cohesion_residual"): 0.5,
        ("friction_angle_residual", "cohesion"): -0.2,
    }
    assert scene.identity()["field.pairs.cohesion.cohesion_residual"] == 0.5
    assert pickle.loads(pickle.dumps(scene)) == scene


def test_no_scatter_of_the_residual_is_the_scene_without_the_key() -> None:
    """Campaigns from before the key go on with scenes that write it out."""
    scene = load_scene("ma2023", ["soil.cohesion.residual_cov=0", "soil.friction_angle.residual_cov=0.0"])
    assert scene.soil.cohesion.residual_cov is None
    assert not [key for key in scene.identity() if "residual_cov" in key or "pairs" in key]


@pytest.mark.parametrize(
    ("override", "expected"),
    [
        ("field.pairs.cohesion.cohesion_residul=0.5", 'no key "cohesion_residul"; did you mean "cohesion_residual"?'),
        (
            "field.pairs.porosity.cohesion=0.5",
            "the keys here are cohesion, friction_angle, cohesion_residual, friction",
        ),
        ("field.pairs.cohesion=0.5", "a section of keys is needed here"),
        ("field.pairs.cohesion.cohesion_residual=1", "between -1 and 1, both excluded"),
        ("field.pairs.cohesion.cohesion=0.5", "a property has a correlation of 1 with itself; leave it out"),
        ("field.pairs.cohesion.friction_angle=0.5", "has its key, field.cross_correlation; give it there"),
        ("field.pairs.friction_angle.cohesion=0.5", "has its key, field.cross_correlation; give it there"),
        (HALF, "the residual cohesion is the same everywhere; give soil.cohesion.residual_cov, or leave the pair out"),
        ("soil.cohesion.residual_cov=-0.1", "it must not be negative"),
        ("soil.friction_angle.residual_cov=0.7", "of mean 5 deg would then reach 90 deg; use less than 0.598"),
    ],
)
def test_a_pair_or_scatter_that_cannot_be_is_refused_with_its_remedy(override: str, expected: str) -> None:
    message = complaint(override)
    assert message.startswith(f"--set {override.partition('=')[0]}")
    assert expected in message


def test_a_pair_is_given_once() -> None:
    message = complaint(*RANDOM, HALF, "field.pairs.cohesion_residual.cohesion=0.4")
    assert message.startswith(
        "--set field.pairs.cohesion_residual.cohesion is 0.4, but this pair is given as field.pairs."
    )


def test_a_residual_of_zero_cannot_scatter() -> None:
    assert "needs a mean above zero" in complaint("soil.cohesion.residual=0 Pa", "soil.cohesion.residual_cov=0.1")


def test_a_matrix_that_is_not_positive_definite_is_refused_with_a_remedy_that_helps(tmp_path: Path) -> None:
    """-0.5, 0.9 and 0.8: a residual close to both peaks, of which one is high where the other is low."""
    pairs = "[field.pairs]\ncohesion_residual.cohesion = {}\ncohesion_residual.friction_angle = {}\n\n[numerics]"
    path = written(tmp_path, ("[numerics]", pairs.format(0.9, 0.8)))
    message = complaint(*RANDOM, source=path)
    assert message.startswith(f"field.pairs (slope.toml, line {line_of('[field.pairs]', path)}) is ")
    assert message.endswith(
        "not positive definite; bring them nearer to 0, for instance all of them to 65 % of what they are."
    )
    nearer = written(tmp_path, ("[numerics]", pairs.format(0.9 * 0.65, 0.8 * 0.65)))
    load_scene(nearer, [*RANDOM, f"field.cross_correlation={-0.5 * 0.65}"])
    barely = written(tmp_path, ("[numerics]", pairs.format(0.9 * 0.71, 0.8 * 0.71)))
    assert "positive definite" in complaint(*RANDOM, f"field.cross_correlation={-0.5 * 0.71}", source=barely)


def test_every_lognormal_pair_has_its_bounds() -> None:
    """Least correlation (exp(-s s_r) - 1) / (COV COV_r), with COV 0.1 and 2."""
    wide = ("field.cross_correlation_of=lognormal", "soil.cohesion.residual_cov=2")
    messages = complaints(*wide, "field.pairs.cohesion.cohesion_residual=-0.6")
    assert len(messages) == 1
    assert "cross-correlation between -0.594 and 0.675" in messages[0]
    load_scene("ma2023", [*wide, "field.pairs.cohesion.cohesion_residual=-0.4"])


def test_a_pair_with_what_the_law_leaves_out_is_refused(tmp_path: Path) -> None:
    """Undrained ground has no friction angle, neither peak nor residual, but a residual cohesion."""
    undrained = written(tmp_path, *UNDRAINED)
    scatter = "soil.cohesion.residual_cov=0.3"
    message = complaint(scatter, "field.pairs.friction_angle_residual.cohesion=0.5", source=undrained)
    assert message.startswith(
        "--set field.pairs.friction_angle_residual.cohesion is 0.5, but the scene has no such property"
    )
    assert load_scene(undrained, [scatter, HALF]).field.cross_correlations() == {("cohesion", "cohesion_residual"): 0.5}
