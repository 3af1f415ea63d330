"""The sampler must be one for the fields, and the grid fine enough."""

from math import pi

from campaign.fields.correlation import KERNELS
from campaign.scene.rules.measures import degrees
from campaign.scene.rules.rule import Rules

RULES = Rules()


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
