"""Single slides: how one goes, the strength it had, and how far the shortest, the median and the longest came."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from campaign.fields.properties import BY_NAME
from campaign.record import FAILED
from campaign.report.figures.section import MOVED, Section
from campaign.report.figures.style import WIDTH, Illustration, letter, new_figure, upper_limit
from campaign.report.snapshots import ReplayedSlide
from campaign.simulation.ground import Ground

CAPTION_OUTLINE = "Dashed: the ground before the slide; orange: run-out from the initial toe."


def configurations(section: Section, slide: ReplayedSlide) -> Illustration:
    """Draw the deterministic slide at its snapshots, coloured by displacement (figure 3 of the paper)."""
    shots = slide.snapshots
    figure, panels = _stack(section, len(shots))
    limits = (0.0, upper_limit(shots[-1].displacement))
    for panel, shot in zip(panels, shots, strict=True):
        particles = section.draw(panel, shot.x, shot.y, shot.displacement, "viridis", limits, MOVED)
        section.mark_runout(panel, shot.runout)
    letter(panels, [f"{shot.time:.1f} s" for shot in shots])
    panels[-1].set_title(f"{panels[-1].get_title(loc='left')}, the end", loc="left")
    _colour_bar(figure, panels, particles, "displacement (m)")
    caption = (
        f"The deterministic slide, with mean strengths everywhere, from the release of strength to its end after "
        f"{shots[-1].time:.1f} s, coloured by displacement. {CAPTION_OUTLINE}"
    )
    if slide.record.status in FAILED:
        caption += f" It failed then: {slide.record.reason}"
    alt = f"Cross-sections of the slope at {len(shots)} times; the final run-out is {shots[-1].runout:.2f} m."
    return Illustration(figure, caption, alt)


def strengths(section: Section, ground: Ground, slide: ReplayedSlide) -> Illustration:
    """Draw the random soil properties where the particles were at first (figure 4 of the paper)."""
    drawn, lattice, k = ground.random_properties, ground.lattice, slide.realization
    figure, panels = _stack(section, len(drawn), colour_bars=len(drawn))
    for panel, row in zip(panels, drawn, strict=True):
        values = slide.soil[row.name] * row.unit.shown_per_si
        low, high = (float(np.percentile(values, share)) for share in (0.5, 99.5))
        particles = section.draw(panel, lattice.x, lattice.y, values, "cividis", (low, max(high, low + 1e-9)))
        _colour_bar(figure, [panel], particles, f"{row.long_name} ({row.unit.shown})", extend="both")
    letter(panels, [row.long_name for row in drawn])
    caption = (
        f"The random soil of realization {k}, whose final run-out is the median of all, where the particles were "
        f"before the slide. Dark is low.{_correlations(ground, slide)}{_raised(slide)}"
    )
    names = _listing([row.long_name for row in drawn])
    alt = f"Maps of the slope, one above the other: {names} of realization {k}, in layers longer than high."
    return Illustration(figure, caption, alt)


def _correlations(ground: Ground, slide: ReplayedSlide) -> str:
    sentences = [
        f" Over these particles {BY_NAME[one].long_name} and {BY_NAME[other].long_name} are correlated by "
        f"{np.corrcoef(slide.soil[one], slide.soil[other])[0, 1]:.2f}; asked, over all realizations, was {asked:g}."
        for (one, other), asked in ground.scene.field.cross_correlations().items()
    ]
    return "".join(sentences)


def _raised(slide: ReplayedSlide) -> str:
    sentences = [
        f" At {100 * share:.2g} % of them the {BY_NAME[name].long_name} that was drawn is below the residual one, and "
        "is raised to it."
        for name, share in slide.raised_shares.items()
        if share > 0.0
    ]
    return "".join(sentences)


def outcomes(section: Section, slides: Mapping[str, ReplayedSlide]) -> Illustration:
    """Draw plastic strain at the end of some slides, by what they are called (figure 5 of the paper)."""
    figure, panels = _stack(section, len(slides))
    strain = np.concatenate([slide.end.plastic_strain for slide in slides.values()])
    limits = (0.0, upper_limit(strain))
    for panel, slide in zip(panels, slides.values(), strict=True):
        end = slide.end
        particles = section.draw(panel, end.x, end.y, end.plastic_strain, "magma_r", limits, MOVED)
        section.mark_runout(panel, end.runout)
    letter(panels, [f"{called}: realization {slide.realization}" for called, slide in slides.items()])
    _colour_bar(figure, panels, particles, "plastic strain (-)", extend="max")
    named = _listing([f"{called} ({slide.end.runout:.2f} m)" for called, slide in slides.items()])
    caption = (
        f"Plastic strain at the end of the slide with the {named} final run-out. The colours end where "
        f"0.5 % of the particles lie beyond; the largest value is {strain.max():.2g}. {CAPTION_OUTLINE}"
    )
    alt = f"Cross-sections of deposits with their plastic strain: the {named} final run-out."
    return Illustration(figure, caption, alt)


def _stack(section: Section, rows: int, colour_bars: int = 1) -> tuple[Figure, list[Axes]]:
    figure, panels = new_figure(
        rows * (0.86 * WIDTH * section.panel_height + 0.27) + 0.75 * colour_bars, rows, sharex=True
    )
    panels[-1].set_xlabel("distance (m)")
    return figure, panels


def _colour_bar(
    figure: Figure, panels: Sequence[Axes], particles: PolyCollection, label: str, extend: str = "max"
) -> None:
    bar: dict[str, Any] = {
        "location": "bottom",
        "shrink": 0.6,
        "aspect": 40,
        "extend": extend,
        "pad": 0.08 / len(panels),
    }
    figure.colorbar(particles, ax=list(panels), label=label, **bar)


def _listing(names: list[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
