"""What can be run but hardly be meant, or will not give the answer that is asked for: warnings before a campaign."""

from collections.abc import Iterator
from math import ceil

from campaign.scene import Scene
from campaign.scene.boring_data import unlikely_data
from campaign.scene.complaints import Complaint, found
from campaign.scene.cost import core_seconds, output_count, particle_count, realization_seconds, step_count, time_step
from campaign.scene.first_look import LONGEST_SLIDE, TYPICAL_SLIDE, FirstLook, critical_circles
from campaign.scene.front import front_of_particles, front_of_the_slide
from campaign.scene.layer_soil import gives
from campaign.scene.layers import random_properties
from campaign.scene.limit_equilibrium import SlipCircle
from campaign.scene.limits import ALLOWED_LOSS, damping, pic_loss
from campaign.scene.more_ground import behind_crest, key_of, lines_with_it, raised_with_it
from campaign.scene.odd_layers import odd_layers
from campaign.scene.odd_sections import odd_sections
from campaign.scene.open_cracks import open_cracks
from campaign.scene.outlook import may_slide
from campaign.scene.raised_peaks import raised_peaks
from campaign.scene.sections import Campaign
from campaign.scene.softening import is_brittle
from campaign.scene.toe import misplaced_toe
from campaign.terminal import duration, rounded_down, rounded_up
from solver.surface import Surface

ABSURD_FACTOR = 5.0
"""Factor of safety beyond which a strength is more likely a slip of the pen than a soil."""

RUNOUTS, BRITTLE_RUNOUTS = (0.3, 1.2), (1.3, 3.3)
"""In heights of the slope. Deterministic runs of `ma2023` and its variants (mean factors of safety of 0.6 to 0.9,
residual ones of 0.1 to 0.5, 30 to 60 degrees, 6 to 30 m high), and realizations of brittle slopes of 12 and 18 m."""

CLEARANCE = 1.1
"""Length of the ground beyond the toe over the longest of those, from which on it is not remarked on."""

CLEAR_CELLS = 2.0
"""Distance of a slip surface from a wall, in cells, below which the wall decides where it begins."""

THINNEST_SLIDE = 4.0
"""In cells."""

SOILS = (
    ("soil.unit_weight", 5e3, 40e3, "5 to 40 kN/m^3"),
    ("soil.young_modulus", 1e5, 1e11, "0.1 MPa (very soft) to 100 GPa (rock)"),
    ("soil.cohesion.cov", 0.0, 1.0, "0.1 to 0.6, and a field beyond 1 is nearly 0 nearly everywhere"),
    ("soil.friction_angle.cov", 0.0, 1.0, "0.05 to 0.2"),
    ("soil.softening.rate", 1e-4, 1e3, "about 0.1 to 10, and a rate far from that is no softening or a sudden one"),
    ("soil.softening.slip_to_residual", 1e-3, 10.0, "residual strength after 0.01 to 1 m of slip"),
)
"""Keys, the SI values between which they are not remarked on, and what soils have."""

FEWEST_PAIRS = 4
"""With half the cell, of which Student's t makes a 95 % interval of 1.6 standard deviations to either side; of 3 it is
2.5 and of 2 it is 9."""

MANY_HOURS = 1e5
"""Core-hours beyond which a campaign is more likely a slip of the pen than a plan."""


def warnings(scene: Scene, look: FirstLook) -> list[Complaint]:
    """Return what a user should know of a scene that can be run, but for `expected_of_slides`."""
    toe = misplaced_toe(scene, look)
    # The height above a toe that is not the slope's gives an area that is not, either.
    fronts = (front_of_particles, front_of_the_slide) if toe is None or scene.slide.front_area is not None else ()
    return found(
        (
            far_from_failure(look),
            *odd_sections(scene, look.surface),
            *odd_layers(scene, look),
            *raised_peaks(scene),
            *open_cracks(scene),
            coarse_cells(scene, look),
            toe,
            *(front(scene, look) for front in fronts),
            short_interval(scene),
            damped_slide(scene),
            short_timeout(scene),
            few_pairs(scene),
            nothing_random(scene),
            *(Complaint(*each) for each in unlikely_data(scene)),
            large_campaign(scene),
            *(unusual_soil(scene, *row) for row in SOILS),
            *_unusual_layers(scene),
        )
    )


def expected_of_slides(scene: Scene, look: FirstLook) -> list[Complaint]:
    """Return what may stop slides before their end, by experience with others; a slide that was computed knows it."""
    return found(
        (
            short_run(scene, look),
            short_ground(scene, look),
            short_crest(scene, look),
            thin_foundation(scene, look),
        )
    )


def far_from_failure(look: FirstLook) -> Complaint | None:
    """Warn of a strength that no slope of this size needs."""
    if look.peak is None or look.peak.factor < ABSURD_FACTOR:
        return None
    return Complaint(
        "soil.cohesion.mean",
        f"the factor of safety is then {look.peak.factor:.3g}, far above 1, and no realization will slide; check the "
        "unit of the strength and the height of the slope",
    )


def short_run(scene: Scene, look: FirstLook) -> Complaint | None:
    """Warn of an end before half of the slides are at rest."""
    numerics = scene.numerics
    ramp_time = numerics.ramp_time if numerics.gravity == "ramp" else 0.0
    typical, longest = (each * look.time_scale for each in (TYPICAL_SLIDE, LONGEST_SLIDE))
    if numerics.end_time >= 0.95 * typical + ramp_time or not _driven(look):
        return None
    ramp = f" after the ramp of {numerics.ramp_time:g} s" if ramp_time else ""
    return Complaint(
        "numerics.end_time",
        f"{_should_it_slide(look)}half of comparable slides take more than {typical:.2g} s{ramp} to come to rest, and "
        f'what still moves at the end counts as not settled; use "{rounded_up(longest + ramp_time)} s", which costs '
        "nothing where slides rest earlier",
    )


def short_ground(scene: Scene, look: FirstLook) -> Complaint | None:
    """Warn of a wall that slides will reach."""
    length = look.surface.width - look.surface.toe_x
    shortest, longest = BRITTLE_RUNOUTS if is_brittle(scene, look.height) else RUNOUTS
    if length >= CLEARANCE * longest * look.height or not _driven(look):
        return None
    needed = CLEARANCE**2 * longest * look.height
    text = (
        f"{_should_it_slide(look)}slides of {look.height:.3g} m mostly run out {shortest:g} to {longest:g} times their "
        f"height, and the wall {length:g} m beyond the toe would hold them back"
    )
    return longer_plain(scene, look.surface, needed, text)


def longer_plain(scene: Scene, surface: Surface, needed: float, text: str) -> Complaint:
    """Complain, for the reason in `text`, that the ground does not go on for `needed` m beyond the toe."""
    with_it = lines_with_it(scene)
    if scene.geometry.slope is not None:
        return Complaint("geometry.slope.plain", f'{text}; use at least "{rounded_up(needed)} m"{with_it}')
    end = surface.toe_x + needed
    return Complaint("geometry.surface", f"{text}; continue the ground to x = {rounded_up(end)} m or farther{with_it}")


def short_crest(scene: Scene, look: FirstLook) -> Complaint | None:
    """Warn of a slip surface that begins at the left wall."""
    clear = CLEAR_CELLS * scene.numerics.cell
    if not any(circle.entry <= clear for circle in _driven(look)):
        return None
    key = key_of(scene, "crest")
    text = "the critical slip circle begins at the wall on the left, which decides how much ground slides"
    return Complaint(key, f"{text}; {behind_crest(scene)}")


def thin_foundation(scene: Scene, look: FirstLook) -> Complaint | None:
    """Warn of a slip surface that goes down to the fixed base, or would if there was ground, and of one along it."""
    toe_y, key = look.surface.toe[1], key_of(scene, "foundation")
    with_it = raised_with_it(scene)
    remedy = f"if there is no rock, deepen the foundation until the factor of safety no longer falls{with_it}"
    band = max(scene.numerics.cell, scene.soil.softening.internal_length or 0.0)
    if not (driven := _driven(look)) or toe_y < scene.numerics.cell:  # else it is a heap on a floor
        return None
    deeper = critical_circles(scene, added=look.height)
    lowest = min(circle.lowest - look.height for circle in deeper if circle is not None)
    if lowest < min(scene.numerics.cell, toe_y - scene.numerics.cell):
        down = f"comes down to {lowest:.2g} m above the fixed base"
        if lowest < 0.0:
            down = f"would go {-lowest:.2g} m below the fixed base if there was soil"
        return Complaint(key, f"the critical slip circle {down}, and the base then holds the slope; {remedy}")
    if toe_y < 2.0 * band and min(circle.lowest for circle in driven) < 2.0 * band:
        return Complaint(
            key,
            f"the critical slip circle comes out at the toe, {toe_y:.2g} m above the fixed base, and a band of "
            f"{band:g} m may run along that; if there is no rock, deepen the foundation to {rounded_up(2.0 * band)} m"
            f"{with_it}",
        )
    return None


def coarse_cells(scene: Scene, look: FirstLook) -> Complaint | None:
    """Warn of a sliding body that is only a few cells thick."""
    if look.peak is None or look.peak.depth(look.surface) >= THINNEST_SLIDE * scene.numerics.cell:
        return None
    depth = look.peak.depth(look.surface)
    return Complaint(
        "numerics.cell",
        f"the critical slip circle is {depth:.3g} m deep, and a body of less than {THINNEST_SLIDE:g} cells slides "
        f'badly; use "{rounded_down(depth / THINNEST_SLIDE)} m" or less',
    )


def short_interval(scene: Scene) -> Complaint | None:
    """Warn of output times that shorten the time step."""
    interval, step = scene.numerics.output_interval, time_step(scene)
    longest = ceil(scene.numerics.end_time / step)
    if step_count(scene) <= 1.5 * longest or 10.0 * step > scene.numerics.end_time:
        return None
    return Complaint(
        "numerics.output_interval",
        f"the time step could be {step:.2g} s, and {output_count(scene):,} intervals of {interval:.2g} s need "
        f'{step_count(scene):,} steps instead of {longest:,}; use "{rounded_up(10.0 * step)} s" or more',
    )


def damped_slide(scene: Scene) -> Complaint | None:
    """Warn of damping that slides may not survive; what they cannot survive is refused."""
    loss = pic_loss(scene)
    if loss <= ALLOWED_LOSS:
        return None
    return Complaint("numerics.flip", f"{damping(loss)}; use 1")


def short_timeout(scene: Scene) -> Complaint | None:
    """Warn of realizations that cannot end in time."""
    needed, allowed = realization_seconds(scene), scene.campaign.realization_timeout
    if needed <= allowed:
        return None
    return Complaint(
        "campaign.realization_timeout",
        f"a realization of {particle_count(scene):,} particles and {step_count(scene):,} steps may take "
        f'{duration(needed)}; use at least "{rounded_up(2.0 * needed / 3600.0)} h", or larger cells',
    )


def few_pairs(scene: Scene) -> Complaint | None:
    """Warn of pairs with half the cell that are too few for Student's t to tell what the mesh does."""
    pairs = scene.campaign.discretisation_pairs
    if not 0 < pairs < FEWEST_PAIRS:
        return None
    return Complaint(
        "campaign.discretisation_pairs",
        "so few pairs hardly bound what half the cell changes, and the total interval may be many times as wide as the "
        f"slides scatter; use {Campaign.model_fields['discretisation_pairs'].default}, or 0 to leave the mesh out",
    )


def nothing_random(scene: Scene) -> Complaint | None:
    """Warn of realizations that are all the same."""
    if random_properties(scene) or scene.campaign.realizations == 1:
        return None
    return Complaint(
        "campaign.realizations",
        "no property has a coefficient of variation above 0: all realizations are the same, and 1 is enough",
    )


def large_campaign(scene: Scene) -> Complaint | None:
    """Warn of a campaign that nobody can wait for."""
    hours = core_seconds(scene) / 3600.0
    if hours <= MANY_HOURS:
        return None
    return Complaint(
        "campaign.realizations", f"all of them take about {hours:,.2g} core-hours; use fewer, or larger cells"
    )


def unusual_soil(scene: Scene, key: str, least: float, most: float, usual: str) -> Complaint | None:
    """Warn of a value that hardly any soil has."""
    value = scene.identity().get(key)
    if value is None or least <= value <= most:
        return None
    return Complaint(key, f"soils have {usual}; check the number and the unit")


def _unusual_layers(scene: Scene) -> Iterator[Complaint | None]:
    for number, layer in enumerate(scene.layer):
        for key, least, most, usual in SOILS:
            if gives(layer, key):
                yield unusual_soil(scene, f"layer.{number}.{key.partition('.')[2]}", least, most, usual)


def _driven(look: FirstLook) -> list[SlipCircle]:
    """Return the critical circles on which something could slide."""
    if look.peak is not None and look.peak.factor >= ABSURD_FACTOR:
        return []
    return [circle for circle in (look.peak, look.residual) if circle is not None]


def _should_it_slide(look: FirstLook) -> str:
    """Say first that no slide is expected, where that is so."""
    return "" if may_slide(look) else "no slide is expected, but should there be one, "
