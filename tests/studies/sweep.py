"""Bases and stress updates against the Courant number: the runs and their figure."""

import numpy as np

from solver.timestep import LARGEST_COURANT

COURANTS = [round(0.1 * k, 1) for k in range(1, 17)]
LOSS_SHOWN = GAIN_SHOWN = 1.0  # of the vibration energy
NOISE = 0.01
LIMIT_COLOUR = "#1a9641"


def sweep(body, bases, schemes, courants=COURANTS):
    """Return the energy gained by ``body(basis, scheme, courant)``, by basis and scheme, one value a Courant number."""
    return {(b, s): np.array([body(b, s, courant) for courant in courants]) for b in bases for s in schemes}


def draw(maps, path):
    """Draw one map of energy gained for each body, with the limit that scenes are held to."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt
    from matplotlib.colors import SymLogNorm
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    figure, panels = plt.subplots(1, len(maps), sharey=True, figsize=(9.5, 4.2), layout="constrained")
    norm = SymLogNorm(NOISE, vmin=-LOSS_SHOWN, vmax=GAIN_SHOWN)
    colours = plt.get_cmap("RdBu_r").with_extremes(over="black", under="black", bad="black")
    for panel, (title, gains) in zip(panels, maps.items(), strict=True):
        values = np.array(list(gains.values()))
        image = panel.pcolormesh(
            COURANTS, np.arange(len(gains)), values, norm=norm, cmap=colours, edgecolors="white", linewidth=0.6
        )
        for row, pair in enumerate(gains):
            limit = LARGEST_COURANT[pair] + 0.05
            panel.plot([limit, limit], [row - 0.5, row + 0.5], color=LIMIT_COLOUR, linewidth=3)
        panel.set(title=title, xlabel="Courant number", xticks=COURANTS[1::2])
        panel.set_yticks(range(len(gains)), [f"{basis}, {scheme.upper()}" for basis, scheme in gains])
        panel.tick_params(length=0)
    panels[0].invert_yaxis()
    bar = figure.colorbar(image, ax=panels, extend="both", ticks=[-1, -0.1, -0.01, 0, 0.01, 0.1, 1])
    bar.set_ticklabels(["−100", "−10", "−1", "0", "+1", "+10", "+100"])
    bar.set_label("energy created (% of the vibration)")
    marks = [
        Line2D([], [], color=LIMIT_COLOUR, linewidth=3, label="largest Courant number a scene may have"),
        Patch(color="black", label="energy doubled, or explosion"),
    ]
    figure.legend(handles=marks, loc="outside lower left", ncols=2, frameon=False)
    figure.savefig(path, dpi=130)
    plt.close(figure)
