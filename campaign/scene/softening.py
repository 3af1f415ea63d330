"""What a scene says of softening, as a rate and as the slip after which strength is residual."""

from campaign.scene.scene import Scene
from campaign.scene.sections import Softening
from solver.domain import half_length_in_cells
from solver.internal_length import BAND_THICKNESS, rate_on_cells
from solver.slip_to_residual import SHARE_LEFT, rate_of, slip_of

LOCKED_BAND_THICKNESS = 4.4
"""In cells, of bands that volumetric locking thickens: plain uGIMP in `ma2023-printed`."""

BRITTLE = 0.1
"""Slip to residual strength in heights of the slope, up to which a slope is brittle."""

SPREADING = 1.0
"""The same, up to which failure may spread from where the ground is weak. In a benched cut of 14 m with a factor of
safety of 1.06, for which one strength everywhere foretells 26 %, 67 % of 30 realizations slid with a slip to residual
strength of 1.5 m, 45 % of 40 with 4 m, 38 % with 15 m and 20 % with 50 m."""

RING_SHEAR = "ring shear tests on clay need 0.1 to 0.5 m"


def known_rate(softening: Softening) -> float | None:
    """Return the rate per unit plastic strain over the internal length or at the reference cell, None without one."""
    if softening.slip_to_residual is None or softening.internal_length is None:
        return softening.rate
    return rate_of(softening.slip_to_residual, softening.internal_length, softening.law == "linear")


def softening_rate(scene: Scene) -> float:
    """Return the rate, per unit plastic strain, at which the strength of a scene softens on its cells."""
    softening, numerics = scene.soil.softening, scene.numerics
    rate = known_rate(softening)
    if softening.law == "none" or rate is None:
        return 0.0
    half_length = half_length_in_cells(numerics.basis, numerics.particles_per_cell)
    internal_length = softening.internal_length or 0.0
    return rate_on_cells(rate, numerics.cell, half_length, internal_length, softening.reference_cell)


def share_left(softening: Softening, slip: float, is_locked: bool) -> float:
    """Return the share of the drop from peak to residual strength that is left after a slip in m.

    Local softening depends on bands: those along the grid, or those that locking thickens.
    """
    rate, is_linear = known_rate(softening), softening.law == "linear"
    if softening.law == "none" or not rate:
        return 1.0
    cells = LOCKED_BAND_THICKNESS if is_locked else BAND_THICKNESS
    thickness = softening.internal_length or cells * (softening.reference_cell or 0.0)
    slips = slip / slip_of(rate, thickness, is_linear)
    return float(max(0.0, 1.0 - slips) if is_linear else SHARE_LEFT**slips)


def is_brittle(scene: Scene, height: float) -> bool:
    """Whether strength is residual after a slip of a tenth of the height in m: a slide then breaks up as it begins.

    One layer of such soil is enough.
    """
    return _is_residual_after(BRITTLE * height, scene)


def is_progressive(scene: Scene, height: float) -> bool:
    """Whether strength is residual after a slip of the height in m: a slide may then begin in one place and spread."""
    return _is_residual_after(SPREADING * height, scene)


def _is_residual_after(slip: float, scene: Scene) -> bool:
    is_locked = scene.numerics.locking == "none"
    return any(share_left(soil.softening, slip, is_locked) <= SHARE_LEFT for soil in scene.soils)


def softening_words(softening: Softening) -> str:
    """Say when a band is residual, and at which rate: "95 % of the drop is lost after 0.30 m of slip (rate 21.6)"."""
    rate, is_linear = known_rate(softening), softening.law == "linear"
    if softening.law == "none" or rate is None:
        return "none"
    share = "all" if is_linear else f"{100 * (1 - SHARE_LEFT):g} %"
    lost = f"{share} of the drop from peak to residual strength is lost"
    if softening.internal_length is not None:
        slip = slip_of(rate, softening.internal_length, is_linear)
        return f"{lost} after {slip:.2g} m of slip (rate {rate:.3g})"
    cells = BAND_THICKNESS, LOCKED_BAND_THICKNESS
    cell = softening.reference_cell or 0.0
    thin, thick = (slip_of(rate, each * cell, is_linear) for each in cells)
    return (
        f"{lost} after {thin:.2g} m of slip in bands {cells[0]:g} cells thick, as cell averages give, and after "
        f"{thick:.2g} m in bands of {cells[1]:g} cells, as locking gives (rate {rate:.3g} on cells of {cell:g} m)"
    )
