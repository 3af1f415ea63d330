"""The deterministic slide on its way."""

from campaign.record import FAILED, Status
from campaign.report.figures.particles import Scale
from campaign.report.figures.section import Section
from campaign.report.figures.stack import OUTLINE, colour_bar, draw_slide, stack, upper_limit
from campaign.report.figures.style import Illustration, letter, need
from campaign.report.snapshots import TIMES, ReplayedSlide
from campaign.simulation.ground import Ground
from campaign.statistics.wording import at_least


def configurations(section: Section, ground: Ground, slide: ReplayedSlide) -> Illustration:
    """Draw the deterministic slide at some times, coloured by displacement (figure 3 of the paper)."""
    need(slide.record.status is not Status.no_slide, "With mean strengths everywhere it does not slide.")
    shots = [*(slide.at(time) for time in TIMES if time < slide.end.time), slide.end]
    figure, panels = stack(section, len(shots))
    scale = Scale("viridis", 0.0, upper_limit(slide.end.displacement))
    for panel, shot in zip(panels, shots, strict=True):
        draw_slide(panel, section, ground, shot, shot.displacement, scale)
    letter(panels, [f"{shot.time:.1f} s after release" for shot in shots])
    panels[-1].set_title(f"{panels[-1].get_title(loc='left')}, the end", loc="left")
    colour_bar(figure, panels, scale, "displacement (m)")
    caption = f"The slide with mean strengths everywhere, coloured by displacement. {OUTLINE}"
    if slide.record.status in FAILED:
        caption += f" It failed then: {slide.record.reason}"
    final = f"{at_least(slide.record)}{slide.end.runout:.2f} m"
    alt = f"Cross-sections of the slope at {len(shots)} times; the final run-out is {final}."
    return Illustration(figure, caption, alt)
