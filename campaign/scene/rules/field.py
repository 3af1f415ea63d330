"""The fields must exist, and their sampler be one for them."""

from math import exp, expm1, log1p, pi, sqrt

from campaign.fields.correlation import KERNELS
from campaign.scene.rules.measures import degrees
from campaign.scene.rules.rule import Rules
from campaign.scene.rules.soil import FRICTIONLESS

RULES = Rules()


@RULES.on(
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


@RULES.on("field.cross_correlation", "soil.law")
def _correlation_of_two(correlation: float, law: str) -> str | None:
    if law == FRICTIONLESS and correlation != 0.0:
        return f'with the law "{law}" the cohesion is the only strength, with nothing to be correlated to; use 0'
    return None


@RULES.on("field.sampler", "field.correlation")
def _separable_kernel(sampler: str, correlation: str) -> str | None:
    if sampler == "kronecker" and not KERNELS[correlation].is_separable:
        products = " or ".join(f'"{name}"' for name, kernel in KERNELS.items() if kernel.is_separable)
        return (
            f'the "{correlation}" correlation is no product of a horizontal and a vertical one; '
            f'use "auto" or "circulant", or the correlation {products}'
        )
    return None


@RULES.on("field.sampler", "field.angle")
def _unrotated_kernel(sampler: str, angle: float) -> str | None:
    if sampler == "kronecker" and angle % pi != 0.0:
        return f'a field rotated by {degrees(angle)} is no product along the axes; use "auto" or "circulant"'
    return None


@RULES.on("field.resolution", "field.horizontal", "field.vertical")
def _resolved_field(resolution: float | None, horizontal: float, vertical: float) -> str | None:
    shortest = min(horizontal, vertical)
    if resolution is not None and resolution > shortest / 2.0:
        return f"a correlation over {shortest:g} m needs two points or more; use at most {shortest / 2.0:g} m"
    return None
