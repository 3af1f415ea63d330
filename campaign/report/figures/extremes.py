"""How the shortest, the median and the longest slide ended."""

from collections.abc import Mapping

import numpy as np

from campaign.report.figures.particles import Scale
from campaign.report.figures.section import Section
from campaign.report.figures.stack import OUTLINE, colour_bar, draw_slide, stack, upper_limit
from campaign.report.figures.style import Illustration, letter
from campaign.report.snapshots import ReplayedSlide
from campaign.simulation.ground import Ground
from campaign.statistics.wording import at_least
from campaign.terminal import listing


def extremes(section: Section, ground: Ground, slides: Mapping[str, ReplayedSlide]) -> Illustration:
    """Draw plastic strain at the end of some slides, by what they are called (figure 5 of the paper)."""
    figure, panels = stack(section, len(slides))
    strain = np.concatenate([slide.end.plastic_strain for slide in slides.values()])
    scale = Scale("magma_r", 0.0, upper_limit(strain))
    for panel, slide in zip(panels, slides.values(), strict=True):
        draw_slide(panel, section, ground, slide.end, slide.end.plastic_strain, scale)
    letter(panels, [f"{called}: realization {slide.realization}" for called, slide in slides.items()])
    colour_bar(figure, panels, scale, "plastic strain (-)")
    named = listing(
        [f"{called} ({at_least(slide.record)}{slide.end.runout:.2f} m)" for called, slide in slides.items()]
    )
    caption = (
        f"The end of the slide with the {named} run-out. Dark is where the ground has sheared most, its slip surfaces "
        f"(plastic strain; the largest value is {strain.max():.2g}). {OUTLINE}"
    )
    return Illustration(figure, caption, f"Cross-sections of deposits with their plastic strain: the {named} run-out.")
