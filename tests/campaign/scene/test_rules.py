"""Values that contradict each other, or the method, are refused with a remedy."""

from math import erfc, exp, log1p, sqrt

import pytest
from scene_complaints import any_complaints, complaint, found_in

from campaign.scene import load_scene
from campaign.scene.document import read_document
from campaign.scene.rules.soil import EXTREME_QUANTILE, largest_allowed_cov


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
    refusals = [message for message in any_complaints(*same, mean, just_above) if "cross-correlation" in message]
    assert refusals == []
    assert any("can only have a cross-correlation between" in text for text in any_complaints(*same, mean, just_below))


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


def test_stress_at_rest_is_given_or_built_up() -> None:
    assert "a ramp of gravity builds up the stress" in complaint("soil.k0=0.6", "numerics.gravity=ramp")
    assert "it must be above 0 and at most 3" in complaint("soil.k0=0")


def test_a_single_particle_in_a_cell_never_rests() -> None:
    one = "numerics.particles_per_cell=1"
    load_scene("ma2023", [one, "numerics.gravity=ramp"])
    assert "never comes to rest under its own weight" in complaint(one)


def test_gaussian_fields_can_have_any_correlation() -> None:
    strong = ("field.cross_correlation=-0.95", "soil.cohesion.cov=0.3", "soil.friction_angle.cov=0.3")
    load_scene("ma2023", strong)
    assert "between -0.917 and" in complaint(*strong, "field.cross_correlation_of=lognormal")


def test_the_extreme_quantile_is_rare_in_a_field() -> None:
    """1e5 values, were they independent, exceed it with a probability below 1 %; the bound solves for 90 deg."""
    assert 1e5 * 0.5 * erfc(EXTREME_QUANTILE / sqrt(2.0)) < 0.01
    s = sqrt(log1p(largest_allowed_cov(10.0, 90.0) ** 2))
    assert 10.0 * exp(EXTREME_QUANTILE * s - s**2 / 2.0) == pytest.approx(90.0)


def test_dilation_is_within_the_least_residual_friction_angle() -> None:
    """5 deg exp(-5.5 s - s^2 / 2), s^2 = ln(1 + 0.2^2), is 1.65 deg."""
    scatter = "soil.friction_angle.residual_cov=0.2"
    assert "the least residual friction angle, 1.64" in complaint(scatter, "soil.dilation_angle=2 deg")
    load_scene("ma2023", [scatter, "soil.dilation_angle=1.6 deg"])
    share = "soil.friction_angle.residual_share=0.5"
    assert "the least residual friction angle, 2.87" in complaint(share, "soil.dilation_angle=3 deg")
    assert "the least friction angle, 5.7" in complaint("soil.softening.law=none", "soil.dilation_angle=6 deg")


def test_what_counts_as_a_slide_must_suit_the_height() -> None:
    assert "slide.displaced" in complaint("slide.displaced=2 m")
    assert "a slope of 15 m can fail without moving that far" in complaint("slide.failed=15 m")
    column = [["0 m", "0.1 m"], ["0.2 m", "0.1 m"], ["0.2 m", "0 m"], ["0.8 m", "0 m"]]
    (message,) = found_in(read_document("bui2008").tables | {"slide": {}, "geometry": {"surface": column}})
    assert message.startswith("slide.failed (scene.toml) is not given, but a slope of 0.1 m can fail")


def test_a_height_is_that_above_the_toe_wherever_it_is_told() -> None:
    """The plain falls by 2 m beyond a slope of 15 m."""
    falling = 'geometry={surface=[["0 m","22 m"],["20 m","22 m"],["35 m","7 m"],["75 m","5 m"]]}'
    assert "a slope of 15 m must be at least 4 cells high" in complaint(falling, "numerics.cell=4 m")


@pytest.mark.parametrize("key", ["soil.cohesion.cov", "soil.friction_angle.residual_cov"])
def test_a_coefficient_of_variation_in_per_cent_is_refused(key: str) -> None:
    assert "at most 10; 30 % is written 0.3" in complaint(f"{key}=30.0")


NO_COHESION = ("soil.cohesion.mean=0 kPa", "soil.cohesion.residual=0 kPa")
NO_FRICTION = ("soil.friction_angle.mean=0 deg", "soil.friction_angle.residual=0 deg")


def test_a_property_may_be_certain_or_absent() -> None:
    load_scene("ma2023", ["soil.cohesion.cov=0", "field.cross_correlation_of=lognormal"])
    load_scene("ma2023", [*NO_COHESION, "soil.cohesion.cov=0"])
    load_scene("ma2023", [*NO_FRICTION, "soil.friction_angle.cov=0"])


def test_what_is_certain_or_absent_does_not_vary() -> None:
    assert "a lognormal peak cohesion needs a mean above zero" in complaint(*NO_COHESION)
    nothing = complaint(*NO_COHESION, *NO_FRICTION, "soil.cohesion.cov=0", "soil.friction_angle.cov=0")
    assert "soil without cohesion and friction is a liquid" in nothing


@pytest.mark.parametrize(
    ("overrides", "expected"),
    [
        (
            ["soil.cohesion.gradient=2 kPa"],
            "that is a pressure, and a pressure per length is needed",
        ),
        (["soil.cohesion.gradient=2"], 'a pressure per length needs its unit and quotes, for instance "2 kPa/m"'),
        (["soil.cohesion.gradient=2 mPa/m"], "m is milli, M is mega"),
        (["soil.cohesion.gradient=-1 kPa/m"], "it must not be negative; ground that is weaker below is a layer"),
        (
            ["soil.friction_angle.gradient=5 deg/m"],
            "19 m below the surface a peak friction angle of 105 deg would reach",
        ),
        (["soil.friction_angle.gradient=3 deg/m"], "of 67 deg would somewhere reach 90 deg; use a smaller one"),
        (["soil.cohesion.residual_gradient=2 kPa/m"], "it would be 48 kPa, above the mean peak cohesion, 20 kPa; use"),
    ],
)
def test_a_gradient_that_cannot_be_is_refused(overrides: list[str], expected: str) -> None:
    assert expected in complaint(*overrides)


def test_a_gradient_may_start_from_nothing_and_none_leaves_a_scene_as_it_was() -> None:
    load_scene("ma2023", [*NO_COHESION, "soil.cohesion.gradient=2 kPa/m"])
    none = ["soil.cohesion.gradient=0 kPa/m", "soil.friction_angle.residual_gradient=0 deg/m"]
    assert load_scene("ma2023", none).digest() == load_scene("ma2023").digest()
