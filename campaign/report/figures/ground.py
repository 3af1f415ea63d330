"""Where the ground moves: how probable it is for each place in the slope that it belongs to the slide."""

import numpy as np

from campaign.report.figures.particles import Scale, draw_lattice, draw_still
from campaign.report.figures.section import Section
from campaign.report.figures.style import COLUMN, Illustration, need, new_figure
from campaign.results.results import Results
from campaign.terminal import counted


def influence(results: Results, section: Section) -> Illustration:
    """Draw the probability that the ground is displaced, where it was before the slide."""
    n = int(np.count_nonzero(~results.has_failed))
    need(n >= 1, "All realizations failed, so nothing is known about the ground.")
    x, y, share = (results.data[name].values for name in ("particle_x", "particle_y", "influence_probability"))
    figure, (axes,) = new_figure(0.92 * COLUMN * section.panel_height + 1.1, width=COLUMN)
    scale, moves = Scale("viridis_r", 0.0, 100.0), share > 0
    draw_still(axes, (x, y), ~moves, section)
    draw_lattice(axes, x[moves], y[moves], 100.0 * share[moves], scale, section.side)
    section.frame(axes)
    axes.set_xlabel("distance (m)")
    figure.colorbar(scale.mappable, ax=axes, label="probability (%)", location="bottom", shrink=0.7, aspect=40)
    caption = (
        f"Share of {counted(n, 'realization')} with a result in which the ground at a place moves by more than "
        f"{results.scene.slide.displaced:g} m, shown where it was before. Grey: it never moved. Dashed: the ground "
        "before the slide."
    )
    return Illustration(
        figure, caption, f"Map of how probable it is that the ground moves, from {counted(n, 'realization')}."
    )
