"""Strength falls and never grows, and stays what a soil can have."""

from collections.abc import Callable
from math import exp, expm1, inf, log, log1p, sqrt
from typing import Any

from campaign.fields.properties import PROPERTIES, SoilProperty
from campaign.scene.rules.measures import degrees
from campaign.scene.rules.rule import Rules

# A standard Gaussian value exceeds 5.5 once in 5e7. A field has far fewer independent values than points, so a campaign
# of 1000 realizations draws such a value with a probability of the order of 1 %; that realization is then reported as
# crashed with its reason, never clipped.
EXTREME_QUANTILE = 5.5

FRICTIONLESS = "tresca"
"""The law without a friction angle."""

WITH_CUTOFF = "mohr-coulomb"
"""The law that may have a cut-off of tension."""

SOFTENING_LAW = "soil.softening.law"

NO_STRENGTH = "soil without cohesion and friction is a liquid, which stands at no slope; give one of both"

RULES = Rules()


def largest_allowed_cov(mean: float, limit: float) -> float:
    """Return the coefficient of variation at which a lognormal field's extreme value reaches `limit`.

    With s^2 = ln(1 + COV^2) the extreme is mean exp(q s - s^2 / 2), q = `EXTREME_QUANTILE`; solved for s.
    """
    if limit == inf:
        return inf
    s = EXTREME_QUANTILE - sqrt(max(EXTREME_QUANTILE**2 - 2.0 * log(limit / mean), 0.0))
    return sqrt(expm1(s**2))


def least_value(mean: float, cov: float) -> float:
    """Return the value below which a lognormal field is as rarely as it is above its extreme one."""
    s = sqrt(log1p(cov**2))
    return mean * exp(-EXTREME_QUANTILE * s - s**2 / 2.0)


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


@RULES.on("soil.cohesion.mean", "soil.friction_angle.mean", "soil.cohesion.gradient", "soil.friction_angle.gradient")
def _some_strength(*means_and_gradients: float | None) -> str | None:
    return None if any(means_and_gradients) else NO_STRENGTH


@RULES.on("soil.cohesion.mean", "soil.law", "soil.cohesion.gradient")
def _some_undrained_strength(cohesion: float, law: str, gradient: float | None) -> str | None:
    return NO_STRENGTH if law == FRICTIONLESS and not cohesion and not gradient else None


@RULES.on("soil.k0", "numerics.gravity")
def _stress_at_rest(k0: float | None, gravity: str) -> str | None:
    if k0 is None or gravity == "release":
        return None
    return (
        "a ramp of gravity builds up the stress of the ground, nu / (1 - nu) where it stays elastic; leave it out, or "
        'use gravity = "release"'
    )


@RULES.on("soil.tension_cutoff", "soil.law")
def _tension_cutoff(cutoff: float | None, law: str) -> str | None:
    if cutoff is None or law == WITH_CUTOFF:
        return None
    return f'only the law "{WITH_CUTOFF}" has one; leave it out'


@RULES.on("soil.dilation_angle", "soil.law")
def _undrained_dilation(dilation: float, law: str) -> str | None:
    if law == FRICTIONLESS and dilation > 0.0:
        return "undrained soil keeps its volume; use 0 deg"
    return None


def _add_rules_of(row: SoilProperty) -> None:
    """Add the rules that the table of properties asks for, one property at a time."""

    def not_above_peak(floor: float | None, mean: float, law: str) -> str | None:
        if floor is not None and floor > mean and law != "none":
            return (
                f"it must not exceed the mean {row.long_name}, {row.unit.show(mean)}; soil that hardens is not modelled"
            )
        return None

    def within_limit(cov: float | None, mean: float | None, gradient: float | None) -> str | None:
        if not cov or mean is None or (gradient and not mean):
            return None
        if mean <= 0.0:
            return (
                f"a lognormal {row.long_name} needs a mean above zero, in {row.mean_key}; raise that, or leave this out"
            )
        largest = largest_allowed_cov(mean, row.limit)
        if cov >= largest:
            return (
                f"somewhere in a thousand realizations a lognormal {row.long_name} of mean {row.unit.show(mean)} "
                f"would then reach {row.unit.show(row.limit)}; use less than {_rounded_down(largest)}"
            )
        return None

    if row.floor_key:
        RULES.on(row.floor_key, row.mean_key, SOFTENING_LAW)(not_above_peak)
    RULES.on(row.cov_key, row.mean_key, row.gradient_key)(within_limit)

    def at_depth(gradient: float | None, mean: float | None, cov: float | None, depth: float) -> str | None:
        if not gradient or mean is None:
            return None
        deepest = mean + gradient * depth
        if deepest >= row.limit or (cov and cov >= largest_allowed_cov(deepest, row.limit)):
            return (
                f"{depth:g} m below the surface a {row.long_name} of {row.unit.show(deepest)} would "
                f"{'somewhere ' if deepest < row.limit else ''}reach {row.unit.show(row.limit)}; use a smaller one"
            )
        return None

    def not_above_peak_at_depth(
        gradient: float | None,
        floor: float | None,
        peak_gradient: float | None,
        peak: float,
        law: str,
        depth: float,
    ) -> str | None:
        if floor is None or law == "none":
            return None
        here, there = floor + (gradient or 0.0) * depth, peak + (peak_gradient or 0.0) * depth
        if gradient and here > there:
            return (
                f"{depth:g} m below the surface it would be {_of_floor(row).unit.show(here)}, above the mean "
                f"{row.long_name}, {row.unit.show(there)}; use at most the gradient of that"
            )
        return None

    _on_deepest(at_depth, row.gradient_key, row.mean_key, row.cov_key)
    if row.floor_key:
        keys = _of_floor(row).gradient_key, row.floor_key, row.gradient_key, row.mean_key, SOFTENING_LAW
        _on_deepest(not_above_peak_at_depth, *keys)


def _of_floor(row: SoilProperty) -> SoilProperty:
    return next(each for each in PROPERTIES if each.mean_key == row.floor_key)


def _on_deepest(check: Callable[..., str | None], *keys: str) -> None:
    """Add a rule on some keys of the soil and the largest depth in m of the ground, however that is given."""

    def of_slope(*values: float) -> str | None:
        *soil, height, foundation = values
        return check(*soil, height + foundation)

    def of_surface(*values: Any) -> str | None:
        *soil, surface = values
        return None if surface is None else check(*soil, max(y for _, y in surface))

    RULES.on(*keys, "geometry.slope.height", "geometry.slope.foundation")(of_slope)
    RULES.on(*keys, "geometry.surface")(of_surface)


for _row in PROPERTIES:
    _add_rules_of(_row)


@RULES.on(
    "soil.dilation_angle",
    SOFTENING_LAW,
    "soil.friction_angle.mean",
    "soil.friction_angle.cov",
    "soil.friction_angle.residual",
    "soil.friction_angle.residual_cov",
    "soil.friction_angle.residual_share",
)
def _dilation(
    dilation: float,
    law: str,
    mean: float,
    cov: float,
    residual: float | None,
    residual_cov: float | None,
    share: float | None,
) -> str | None:
    if law == "none":
        name, value, scatter = "friction angle", mean, cov
    elif share is not None:
        name, value, scatter = "residual friction angle", share * mean, cov
    else:
        name, value, scatter = "residual friction angle", residual or 0.0, residual_cov or 0.0
    least = least_value(value, scatter)
    if dilation > least:
        return (
            f"it must not exceed the {'least ' if scatter else ''}{name}, {degrees(least)}, or softened soil would "
            "create energy; use 0 deg"
        )
    return None


@RULES.on("soil.softening.rate", "soil.softening.slip_to_residual", "soil.softening.law")
def _softening_rate(rate: float | None, slip: float | None, law: str) -> str | None:
    if rate is None and slip is None and law != "none":
        return (
            f'the {law} law needs it; add for instance rate = 0.35, or slip_to_residual = "0.3 m" as a ring shear test '
            'gives it, or choose law = "none"'
        )
    return None


@RULES.on("soil.softening.slip_to_residual", "soil.softening.rate", "soil.softening.internal_length")
def _slip_to_residual(slip: float | None, rate: float | None, internal_length: float | None) -> str | None:
    if slip is None:
        return None
    if rate is not None:
        return "the rate says the same in other terms; leave out one of the two"
    if internal_length is None:
        return (
            "slip softens a band of a known thickness, and local softening has none: its bands are 1 cell thick along "
            "the grid, 2.1 cells across it, and 4.4 where locking thickens them; give an internal_length instead of "
            "the reference_cell, or a rate"
        )
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
