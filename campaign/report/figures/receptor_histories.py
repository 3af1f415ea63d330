"""What a slide does at a place over time: how deep and how fast the ground is there."""

import numpy as np

from campaign.report.figures.curves import draw_histories, what_is_drawn
from campaign.report.figures.style import COLUMN, Illustration, letter, need, new_figure
from campaign.results.results import Results
from campaign.terminal import counted

PANELS = {"receptor_depth": "depth (m)", "receptor_velocity": "velocity (m/s)"}


def histories(results: Results, receptor: str) -> Illustration:
    """Draw depth and velocity at a receptor over time, for the slides whose front reaches it."""
    data = results.data.sel(receptor=receptor)
    is_reached = data["front_reaches"].values == 1.0
    n, time = int(np.count_nonzero(is_reached)), data["time"].values
    need(n > 0, f"The front of no slide has reached {receptor}.")
    figure, panels = new_figure(3.6, 2, width=COLUMN, sharex=True)
    for axes, (name, label) in zip(panels, PANELS.items(), strict=True):
        draw_histories(axes, time, data[name].values[is_reached])
        axes.set(ylabel=label, ylim=(0, None), xlim=(0, time[-1]))
    panels[0].legend(loc="upper left", fontsize=8)
    panels[1].set_xlabel("time since release (s)")
    letter(panels, ["", ""])
    caption = (
        f"{receptor}: (a) depth and (b) velocity of the moving ground over time, in {counted(n, 'slide')} whose front "
        f"gets there.{what_is_drawn(n)}"
    )
    return Illustration(figure, caption, f"Depth and velocity at {receptor} over time, of {counted(n, 'slide')}.")
