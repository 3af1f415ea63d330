"""Strength falls and never grows, and stays what a soil can have."""

from math import expm1, log, radians, sqrt

from campaign.scene.rules.measures import degrees
from campaign.scene.rules.rule import Rules

# A standard Gaussian value exceeds 5.5 once in 5e7. A field has far fewer independent values than points, so a campaign
# of 1000 realizations draws such a value with a probability of the order of 1 %; that realization is then reported as
# crashed with its reason, never clipped.
EXTREME_QUANTILE = 5.5

FRICTIONLESS = "tresca"
"""The law without a friction angle."""

RULES = Rules()


def largest_allowed_cov(mean: float, limit: float) -> float:
    """Return the coefficient of variation at which a lognormal field's extreme value reaches `limit`.

    With s^2 = ln(1 + COV^2) the extreme is mean exp(q s - s^2 / 2), q = `EXTREME_QUANTILE`; solved for s.
    """
    s = EXTREME_QUANTILE - sqrt(max(EXTREME_QUANTILE**2 - 2.0 * log(limit / mean), 0.0))
    return sqrt(expm1(s**2))


@RULES.on("soil.friction_angle", "soil.law")
def _needed_friction_angle(_none: None, law: str) -> str | None:
    if law == FRICTIONLESS:
        return None
    return (
        f'the law "{law}" needs it; add a section [soil.friction_angle], for instance with mean = "10 deg", '
        f'cov = 0.1, residual = "5 deg", or choose law = "{FRICTIONLESS}"'
    )


@RULES.on("soil.friction_angle.mean", "soil.law")
def _friction_angle_that_is_not_read(_mean: float, law: str) -> str | None:
    if law == FRICTIONLESS:
        return f'the law "{law}" knows undrained strength alone, which is the cohesion; remove the friction_angle'
    return None


@RULES.on("soil.dilation_angle", "soil.law")
def _undrained_dilation(dilation: float, law: str) -> str | None:
    if law == FRICTIONLESS and dilation > 0.0:
        return "undrained soil keeps its volume; use 0 deg"
    return None


@RULES.on("soil.cohesion.residual", "soil.cohesion.mean")
def _residual_cohesion(residual: float, mean: float) -> str | None:
    if residual > mean:
        return f"it must not exceed the mean peak cohesion, {mean / 1e3:g} kPa; soil that hardens is not modelled"
    return None


@RULES.on("soil.friction_angle.residual", "soil.friction_angle.mean")
def _residual_friction_angle(residual: float, mean: float) -> str | None:
    if residual > mean:
        return f"it must not exceed the mean peak friction angle, {degrees(mean)}; soil that hardens is not modelled"
    return None


@RULES.on("soil.dilation_angle", "soil.friction_angle.residual")
def _dilation(dilation: float, residual: float) -> str | None:
    if dilation > residual:
        return (
            f"it must not exceed the residual friction angle, {degrees(residual)}, "
            "or softened soil would create energy; use 0 deg"
        )
    return None


@RULES.on("soil.friction_angle.cov", "soil.friction_angle.mean")
def _friction_tail(cov: float, mean: float) -> str | None:
    largest = largest_allowed_cov(mean, radians(90.0))
    if cov >= largest:
        return (
            f"somewhere in a thousand realizations a lognormal friction angle of mean {degrees(mean)} "
            f"would then reach 90 deg; use less than {_rounded_down(largest)}"
        )
    return None


@RULES.on("soil.softening.rate", "soil.softening.law")
def _softening_rate(rate: float | None, law: str) -> str | None:
    if rate is None and law != "none":
        return f'the {law} law needs it; add for instance rate = 0.35, or choose law = "none"'
    return None


@RULES.on("soil.softening.reference_cell", "soil.softening.internal_length", "soil.softening.law")
def _softening_scale(reference_cell: float | None, internal_length: float | None, law: str) -> str | None:
    if reference_cell is not None and internal_length is not None:
        return (
            "with an internal_length the rate holds for every cell; leave out one of the two: reference_cell for "
            "softening with an average over that length, internal_length for local softening"
        )
    if reference_cell is None and internal_length is None and law != "none":
        return (
            f'the {law} law needs the cell at which its rate holds; add for instance reference_cell = "0.5 m", '
            'or internal_length = "1 m" for softening with an average over that length'
        )
    return None


def _rounded_down(number: float) -> float:
    return int(number * 1000.0) / 1000.0
