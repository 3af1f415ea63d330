"""Rules that tie several keys of a scene together."""

from collections.abc import Callable, Iterator, Mapping
from math import exp, expm1, log, log1p, pi, radians, sqrt
from typing import Any, NamedTuple

from solver.timestep import LARGEST_COURANT

Check = Callable[..., str | None]
Points = list[list[float]]

# A standard Gaussian value exceeds 5.5 once in 5e7. A field has far fewer independent values than points, so a campaign
# of 1000 realizations draws such a value with a probability of the order of 1 %; that realization is then reported as
# crashed with its reason, never clipped.
EXTREME_QUANTILE = 5.5
LEAST_CELLS_OF_HEIGHT = 4
LEAST_CELLS_OF_LENGTH = 2


class Rule(NamedTuple):
    """A check on the values of some keys; a complaint is reported at the first of them."""

    keys: tuple[str, ...]
    check: Check


RULES: list[Rule] = []


def rule(*keys: str) -> Callable[[Check], Check]:
    """Register a check that takes the values of `keys` and returns a complaint, worded to follow "..., but"."""

    def register(check: Check) -> Check:
        RULES.append(Rule(keys, check))
        return check

    return register


def broken_rules(values: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield key and complaint of every broken rule whose keys all have a value.

    Parameters
    ----------
    values
        SI values by dotted key; keys that are absent or wrong by themselves are left out.
    """
    for keys, check in RULES:
        if all(key in values for key in keys) and (complaint := check(*(values[key] for key in keys))):
            yield keys[0], complaint


def largest_allowed_cov(mean: float, limit: float) -> float:
    """Return the coefficient of variation at which a lognormal field's extreme value reaches `limit`.

    With s^2 = ln(1 + COV^2) the extreme is mean exp(q s - s^2 / 2), q = `EXTREME_QUANTILE`; solved for s.
    """
    s = EXTREME_QUANTILE - sqrt(max(EXTREME_QUANTILE**2 - 2.0 * log(limit / mean), 0.0))
    return sqrt(expm1(s**2))


@rule("numerics.cell", "geometry.slope.height")
def _cells_of_height(cell: float, height: float) -> str | None:
    if cell * LEAST_CELLS_OF_HEIGHT > height:
        return (
            f"a slope of {height:g} m must be at least {LEAST_CELLS_OF_HEIGHT} cells high; "
            f"use at most {height / LEAST_CELLS_OF_HEIGHT:g} m"
        )
    return None


@rule("numerics.cell", "geometry.surface")
def _cells_of_relief(cell: float, surface: Points | None) -> str | None:
    if surface is None:
        return None
    return _cells_of_height(cell, _relief(surface))


@rule("geometry.slope.crest", "numerics.cell")
@rule("geometry.slope.plain", "numerics.cell")
@rule("geometry.slope.foundation", "numerics.cell")
def _cells_of_length(length: float, cell: float) -> str | None:
    if length < cell * LEAST_CELLS_OF_LENGTH:
        return (
            f"it must span at least {LEAST_CELLS_OF_LENGTH} cells of {cell:g} m; "
            f"use at least {LEAST_CELLS_OF_LENGTH * cell:g} m or a smaller numerics.cell"
        )
    return None


@rule("numerics.courant", "numerics.basis", "numerics.stress_update")
def _stable_step(courant: float, basis: str, stress_update: str) -> str | None:
    largest = LARGEST_COURANT[basis, stress_update]
    if largest == 0.0:
        return (
            f'the basis "{basis}" with the stress update "{stress_update}" is unstable at every Courant number as '
            'particles cross cells; use the basis "gimp" or the stress update "musl"'
        )
    if courant > largest:
        return (
            f'the basis "{basis}" with the stress update "{stress_update}" creates energy beyond {largest:g}; '
            "use at most that"
        )
    return None


@rule("numerics.locking", "numerics.basis")
def _cell_average_of_wide_basis(locking: str, basis: str) -> str | None:
    if locking == "cell-average" and basis == "bspline":
        return (
            'the domain of a "bspline" particle spans two cells, and averaged over both the ground is too weak; '
            'use the basis "gimp"'
        )
    return None


@rule("numerics.particles_per_cell", "numerics.gravity")
def _ground_that_rests(particles_per_cell: int, gravity: str) -> str | None:
    if particles_per_cell == 1 and gravity == "release":
        return (
            "a single particle in the middle of a cell feels no forces that alternate from node to node, so the ground "
            'never comes to rest under its own weight; use 4, or gravity = "ramp"'
        )
    return None


@rule("slide.failed", "geometry.slope.height")
def _failure_within_height(failed: float, height: float) -> str | None:
    if failed >= height:
        return f"a slope of {height:g} m can fail without moving that far; use about a fifteenth of its height"
    return None


@rule("slide.failed", "geometry.surface")
def _failure_within_relief(failed: float, surface: Points | None) -> str | None:
    return None if surface is None else _failure_within_height(failed, _relief(surface))


@rule("slide.displaced", "slide.failed")
def _displaced_before_failed(displaced: float, failed: float) -> str | None:
    if displaced > failed:
        return f"a slope that has failed, by {failed:g} m, must have a sliding mass; use at most that"
    return None


@rule("soil.cohesion.residual", "soil.cohesion.mean")
def _residual_cohesion(residual: float, mean: float) -> str | None:
    if residual > mean:
        return f"it must not exceed the mean peak cohesion, {mean / 1e3:g} kPa; soil that hardens is not modelled"
    return None


@rule("soil.friction_angle.residual", "soil.friction_angle.mean")
def _residual_friction_angle(residual: float, mean: float) -> str | None:
    if residual > mean:
        return f"it must not exceed the mean peak friction angle, {_degrees(mean)}; soil that hardens is not modelled"
    return None


@rule("soil.dilation_angle", "soil.friction_angle.residual")
def _dilation(dilation: float, residual: float) -> str | None:
    if dilation > residual:
        return (
            f"it must not exceed the residual friction angle, {_degrees(residual)}, "
            "or softened soil would create energy; use 0 deg"
        )
    return None


@rule("soil.friction_angle.cov", "soil.friction_angle.mean")
def _friction_tail(cov: float, mean: float) -> str | None:
    largest = largest_allowed_cov(mean, radians(90.0))
    if cov >= largest:
        return (
            f"somewhere in a thousand realizations a lognormal friction angle of mean {_degrees(mean)} "
            f"would then reach 90 deg; use less than {_rounded_down(largest)}"
        )
    return None


@rule("soil.softening.rate", "soil.softening.law")
def _softening_rate(rate: float | None, law: str) -> str | None:
    if rate is None and law != "none":
        return f'the {law} law needs it; add for instance rate = 0.35, or choose law = "none"'
    return None


@rule("soil.softening.reference_cell", "soil.softening.internal_length", "soil.softening.law")
def _softening_scale(reference_cell: float | None, internal_length: float | None, law: str) -> str | None:
    if reference_cell is not None and internal_length is not None:
        return (
            "with an internal_length the rate holds for every cell; leave out one of the two: reference_cell for "
            "softening that is the same on every mesh, internal_length for local softening"
        )
    if reference_cell is None and internal_length is None and law != "none":
        return (
            f'the {law} law needs the cell at which its rate holds; add for instance reference_cell = "0.5 m", '
            'or internal_length = "1 m" for softening that is the same on every mesh'
        )
    return None


@rule(
    "field.cross_correlation",
    "field.cross_correlation_of",
    "soil.cohesion.cov",
    "soil.friction_angle.cov",
)
def _feasible_correlation(correlation: float, of: str, cohesion_cov: float, friction_cov: float) -> str | None:
    """Refuse what no Gaussian pair gives: rho_G = ln(1 + rho d_c d_phi) / (s_c s_phi) must lie in (-1, 1)."""
    product = cohesion_cov * friction_cov
    scale = sqrt(log1p(cohesion_cov**2) * log1p(friction_cov**2))
    lowest, highest = (exp(-scale) - 1.0) / product, expm1(scale) / product
    if of == "lognormal" and not lowest < correlation < highest:
        return (
            f"lognormal fields with these coefficients of variation can only have a cross-correlation "
            f'between {lowest:.3f} and {highest:.3f}; choose one, or set cross_correlation_of = "gaussian"'
        )
    return None


@rule("field.sampler", "field.correlation")
def _separable_kernel(sampler: str, correlation: str) -> str | None:
    if sampler == "kronecker" and correlation == "exponential":
        return (
            'the "exponential" correlation is no product of a horizontal and a vertical one; '
            'use "auto" or "circulant", or the correlation "separable-exponential"'
        )
    return None


@rule("field.sampler", "field.angle")
def _unrotated_kernel(sampler: str, angle: float) -> str | None:
    if sampler == "kronecker" and angle % pi != 0.0:
        return f'a field rotated by {_degrees(angle)} is no product along the axes; use "auto" or "circulant"'
    return None


@rule("field.resolution", "field.horizontal", "field.vertical")
def _resolved_field(resolution: float | None, horizontal: float, vertical: float) -> str | None:
    shortest = min(horizontal, vertical)
    if resolution is not None and resolution > shortest / 2.0:
        return f"a correlation over {shortest:g} m needs two points or more; use at most {shortest / 2.0:g} m"
    return None


@rule("numerics.output_interval", "numerics.end_time")
def _output_within_run(interval: float, end_time: float) -> str | None:
    if interval > end_time:
        return f"the run ends at {end_time:g} s; use at most that"
    return None


@rule("numerics.ramp_time", "numerics.end_time", "numerics.gravity")
def _ramp_within_run(ramp_time: float, end_time: float, gravity: str) -> str | None:
    if gravity == "ramp" and ramp_time >= end_time:
        return f"the run ends at {end_time:g} s, before gravity is whole; shorten the ramp or run longer"
    return None


def _relief(surface: Points) -> float:
    elevations = [elevation for _, elevation in surface]
    return max(elevations) - min(elevations)


def _degrees(angle: float) -> str:
    return f"{angle * 180.0 / pi:g} deg"


def _rounded_down(number: float) -> float:
    return int(number * 1000.0) / 1000.0
