"""Where the ground moves, and what the surface looks like afterwards, over all realizations."""

import numpy as np

from campaign.report.figures.section import Section
from campaign.report.figures.style import BLUE, WIDTH, Illustration, letter, need, new_figure
from campaign.results.results import Results


def influence(results: Results, section: Section) -> Illustration:
    """Draw the probability that the ground is displaced, and the surface of the deposit with its spread."""
    n = int(np.count_nonzero(~results.has_failed))
    need(n >= 1, "All realizations failed, so nothing is known about the ground.")
    data = results.data
    figure, panels = new_figure(2 * (0.92 * WIDTH * section.panel_height + 0.3) + 1.0, 2, sharex=True)
    share = data["influence_probability"].values
    particles = section.draw(panels[0], data["particle_x"].values, data["particle_y"].values, share, "cividis", (0, 1))
    figure.colorbar(particles, ax=panels[0], label="probability (-)", location="bottom", shrink=0.6, aspect=40)
    surfaces = data["deposit_surface"].values[~results.has_failed]
    q = np.quantile(surfaces, [0.05, 0.5, 0.95], axis=0)
    x = data["x"].values
    panels[1].fill_between(x, q[0], q[2], color=BLUE, alpha=0.3, linewidth=0, label="5 to 95 %")
    panels[1].plot(x, q[1], color=BLUE, label="median")
    section.frame(panels[1])
    panels[1].legend(loc="upper right")
    panels[1].set_xlabel("distance (m)")
    letter(panels, ["probability of belonging to the slide", "ground surface after the slide"])
    caption = (
        f"(a) Share of the {n} realizations without failure in which the ground at a place is displaced by more "
        "than slide.displaced, shown where it was before the slide. (b) The ground surface after the slide: median and "
        "the range from the 5 % to the 95 % quantile, column by column. Dashed: the ground before the slide."
    )
    alt = f"Map of the probability of displacement, and the final surface with its spread, from {n} realizations."
    return Illustration(figure, caption, alt)
