"""The random soil of a realization."""

import numpy as np

from campaign.fields.properties import BY_NAME
from campaign.report.figures.particles import Scale, draw_lattice, draw_still
from campaign.report.figures.section import Section
from campaign.report.figures.stack import colour_bar, stack
from campaign.report.figures.style import Illustration, letter, need
from campaign.report.snapshots import ReplayedSlide
from campaign.simulation.ground import Ground
from campaign.terminal import listing


def strengths(section: Section, ground: Ground, slide: ReplayedSlide) -> Illustration:
    """Draw the random soil properties where the particles were at first (figure 4 of the paper)."""
    drawn, lattice, k = ground.random_properties, ground.lattice, slide.realization
    need(drawn, "Nothing is random.")
    shown = lattice.x < section.right
    figure, panels = stack(section, len(drawn), colour_bars=len(drawn))
    for panel, row in zip(panels, drawn, strict=True):
        is_random = ground.is_random(row.name)
        values = slide.soil[row.name][is_random] * row.unit.shown_per_si
        low, high = (float(np.percentile(values, share)) for share in (0.5, 99.5))
        scale = Scale("cividis", low, max(high, low + 1e-9))
        kept, still = shown[is_random], shown & ~is_random
        draw_still(panel, (lattice.x, lattice.y), still, section)
        x, y = lattice.x[is_random][kept], lattice.y[is_random][kept]
        draw_lattice(panel, x, y, values[kept], scale, section.side)
        section.frame(panel)
        colour_bar(figure, [panel], scale, f"{row.long_name} ({row.unit.shown})", extend="both")
    letter(panels, [row.long_name for row in drawn])
    caption = (
        f"The random soil of realization {k}, the slide with the median run-out, before it slid. Dark is weak."
        f"{_grey(ground)}"
        f"{_correlations(ground, slide)}{_raised(slide)}"
    )
    names = listing([row.long_name for row in drawn])
    return Illustration(figure, caption, f"Maps of the slope, one above the other: {names} of realization {k}.")


def _grey(ground: Ground) -> str:
    """Say what grey ground is, if there is any."""
    is_everywhere = all(ground.is_random(row.name).all() for row in ground.random_properties)
    return "" if is_everywhere else " Grey: not random in that layer, or the layer has no such strength."


def _correlations(ground: Ground, slide: ReplayedSlide) -> str:
    within = " within the layers" if ground.scene.layer else ""
    sentences = [
        f" Here {BY_NAME[one].long_name} and {BY_NAME[other].long_name} are correlated by "
        f"{_correlation(ground, slide, one, other):.2f}{within}; the scene asks for {asked:g} over all "
        "realizations."
        for (one, other), asked in ground.scene.field.cross_correlations().items()
    ]
    return "".join(sentences)


def _correlation(ground: Ground, slide: ReplayedSlide, one: str, other: str) -> float:
    """Return the correlation of two properties; that one layer has more of both than another is none."""
    pairs = np.array([slide.soil[one], slide.soil[other]])
    layers = [pairs[:, where] for where in ground.particles_of_layers(one, other) if where.any()]
    deviations = [(each - each.mean(axis=1, keepdims=True)) / each.std(axis=1, keepdims=True) for each in layers]
    return float(np.corrcoef(np.concatenate(deviations, axis=1))[0, 1])


def _raised(slide: ReplayedSlide) -> str:
    sentences = [
        f" In {100 * share:.2g} % of the ground the {BY_NAME[name].long_name} that was drawn is below the residual "
        "one, and is raised to it."
        for name, share in slide.raised_shares.items()
        if share > 0.0
    ]
    return "".join(sentences)
