"""Sentences about a slide that ran to its end and yet is not the slope's own."""

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from campaign.record import Value
from campaign.scene import Scene, more_ground
from campaign.terminal import as_sentence

if TYPE_CHECKING:  # with Numba, for which those who only read the sentences do not wait
    from solver.model import Model
    from solver.walls import Walls

CAME_APART = "The front-most ground has come apart from the slide; final_runout is the place of that debris."
CREST_WALL = (
    "The slide has reached the wall behind the crest (x = 0 m): its volume and what it takes behind the crest are "
    "lower bounds, and the wall disturbs its run-out, which may be longer or shorter with more ground there."
)
AHEAD_WALL = "The slide has reached the wall ahead of it (x = {width:g} m): its run-out is a lower bound."
ON_THE_BASE = "The slip surface runs along the fixed base under {percent:.0f} % of the sliding ground."

REMEDIES: dict[str, Callable[[Scene], str]] = {
    "the wall behind the crest": more_ground.behind_crest,
    "the wall ahead of it": more_ground.ahead,
    "along the fixed base": more_ground.below,
    "left the grid on the left": more_ground.behind_crest,
    "left the grid on the right": more_ground.ahead,
}
"""What a sentence on a realization tells of, and what can be done about it in the scene."""

MUCH_CONTACT = 0.1
"""Share of the sliding ground that slips along the base, from which on the base and not the soil shapes the slide."""


def flags(model: "Model", walls: "Walls", values: Mapping[str, Value]) -> str:
    """Return what has to be said of a march that did not fail; "" if nothing.

    Ground that stands on the base itself, like a heap on a floor, has no foundation that could be too thin.
    """
    has_foundation = model.surface.toe[1] >= model.cell_size
    on_the_base = has_foundation and float(values["base_contact"]) > MUCH_CONTACT
    sentences = {
        CAME_APART: float(values["detached_volume"]) > 0.0,
        CREST_WALL: walls.left,
        AHEAD_WALL.format(width=model.surface.width): walls.right,
        ON_THE_BASE.format(percent=100.0 * float(values["base_contact"])): on_the_base,
    }
    return " ".join(sentence for sentence, holds in sentences.items() if holds)


def with_remedy(reason: str, scene: Scene) -> str:
    """Return a reason, that of a failure too, with what can be done about it in the scene."""
    remedies = (remedy(scene) for what, remedy in REMEDIES.items() if what in reason)
    return " ".join([reason, *map(as_sentence, remedies)])


def without_debris(reason: str) -> str:
    """Return what has to be said of a march, but for debris ahead of it, which is in nobody's way."""
    return reason.replace(CAME_APART, "").strip()
