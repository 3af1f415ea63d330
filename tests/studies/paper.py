"""The paper's own Monte-Carlo campaign beside ours: `PYTHONPATH=tests/helpers python tests/studies/paper.py [DIR]`.

DIR is a finished campaign of `ma2023-printed`; from it `paper.nc` is taken, the run-outs that the figure is drawn from.
Made by ``campaign run ma2023-printed --set campaign.minimum=1000 --out DIR``.
"""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from scipy import stats

from campaign.report.figures.style import BLACK, BLUE, GREY, ORANGE, WIDTH, in_style

HERE = Path(__file__).parent
RUNOUTS = HERE / "paper.nc"
KEPT = ("runout", "final_runout", "deterministic_runout", "deterministic_final_runout")

# Ma, Rezania and Mousavi Nezhad, section 3.2 and Figures 6 and 7.
N, MEAN, STD, LEAST, LARGEST, DETERMINISTIC, EXCEEDANCE = 1000, 10.80, 0.51, 9.49, 12.23, 10.78, 0.52


def keep(directory):
    """Write the run-outs of a campaign to ``paper.nc``."""
    with xr.open_dataset(Path(directory) / "results.nc", decode_timedelta=False) as data:
        kept = data[list(KEPT)].astype("float32")
    kept.attrs = {"title": data.attrs["title"]}
    kept.to_netcdf(RUNOUTS, encoding={name: {"zlib": True, "complevel": 9} for name in KEPT})


def draw(data):
    """Draw run-out against time (the paper's Figure 6) and its distribution (Figure 7a)."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(WIDTH, 3.0), layout="compressed")
    left.plot(data.time, data.runout.T, color=GREY, linewidth=0.3, alpha=0.3, rasterized=True)
    left.plot(data.time, data.deterministic_runout, color=BLACK, label="mean strengths everywhere")
    left.plot([3.0, 11.0], [1.7, DETERMINISTIC], "o", color=ORANGE, label="the same in the paper")
    left.set(xlabel="time since release (s)", ylabel="run-out (m)", xlim=(0.0, 11.3), ylim=(0.0, 17.0))
    left.legend(loc="upper left")
    final = data.final_runout.values
    right.hist(final, bins=30, density=True, color=BLUE, alpha=0.4, label=f"{final.size} realizations")
    x = np.linspace(8.5, 13.5, 300)
    right.plot(x, stats.norm.pdf(x, final.mean(), final.std(ddof=1)), color=BLUE, label="normal, ours")
    right.plot(x, stats.norm.pdf(x, MEAN, STD), color=ORANGE, label="normal, the paper's")
    right.axvline(float(data.deterministic_final_runout), ymax=0.7, color=BLACK, linewidth=1.0)
    right.set(xlabel="final run-out (m)", ylabel="density (1/m)", xlim=(8.5, 13.5), ylim=(0.0, 1.15))
    right.legend(loc="upper left")
    for panel, title in zip((left, right), ("(a) as Figure 6", "(b) as Figure 7"), strict=True):
        panel.set_title(title)
    return figure


def main():
    """Keep the run-outs of a campaign if one is given, and draw the figure."""
    if len(sys.argv) > 1:
        keep(sys.argv[1])
    with in_style(), xr.open_dataset(RUNOUTS, decode_timedelta=False) as data:
        draw(data).savefig(HERE / "paper.png")


if __name__ == "__main__":
    main()
