"""What comes to the places asked about, as the page says it."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from campaign.record import Status
from campaign.report.distribution import Distribution, distribution
from campaign.results.results import Results
from campaign.scene.ground_surface import surface_of
from campaign.scene.sections import Receptor
from campaign.statistics.receptors import (
    AHEAD,
    EFFECTS,
    REACHED,
    RISE,
    ReceptorEstimate,
    may_still_come,
    receptor_estimates,
    still_moves,
)
from campaign.statistics.wording import chances, estimated_chance
from campaign.terminal import counted, listing

ARRIVALS = {
    "moved_ground_arrival": "arrival of any moved ground after the release",
    "front_arrival": "arrival of the front",
}
"""When something comes, and what that is called."""

NEAR_A_WALL = 5.0
"""In cells: distance of a place from the wall ahead, up to which that has a part in what is seen there."""


class Reach(NamedTuple):
    """How probable it is that the front, and that any moved ground, reaches a receptor."""

    front: ReceptorEstimate
    moved: ReceptorEstimate

    @property
    def is_pushed_farther(self) -> bool:
        """Whether ground that is pushed or thrown ahead gets there more often than the front."""
        return self.moved.interval.estimate > self.front.interval.estimate


class Place(NamedTuple):
    """A receptor: where it is, how probable it is that something comes, and what comes with the front and ahead of it.

    Attributes
    ----------
    slides : int
        In which the front comes, and of which the effects are.
    effects : list of Distribution
        From the arrival of the front on.
    pushed : str
        In which slides ground is pushed or thrown here ahead of the front, "" if in none.
    ahead : list of Distribution
        What that ground does.
    thrown_back : str
        That the wall ahead has a part in it, "" if it has none.
    so_far : str
        In how many slides ground still moved at the end, and how many more may come, "" if none.
    """

    name: str
    where: str
    chances: list[tuple[str, str, str]]
    slides: int
    effects: list[Distribution]
    pushed: str
    ahead: list[Distribution]
    thrown_back: str
    so_far: str


def reach_estimates(results: Results) -> list[Reach]:
    """Return for each receptor how probable it is that a slide gets there, if that is known."""
    known = [each for each in receptor_estimates(results.data, results.confidence) if each.interval.n]
    fronts, moved = ([each for each in known if each.quantity == called] for called in REACHED.values())
    return [Reach(*pair) for pair in zip(fronts, moved, strict=True)]


def places(results: Results) -> list[Place]:
    """Return what the campaign says of each receptor."""
    estimated = receptor_estimates(results.data, results.confidence)
    reach = [each for each in estimated if each.quantity in REACHED.values() and each.interval.n]
    return [_place(results, receptor, reach) for receptor in results.scene.receptor]


def ended_or_was_there(results: Results) -> str:
    """Say why a place and the table of distances may count other slides, "" where they count the same."""
    if results.front == "tip":
        return "The table is of the front-most particle; what reaches a place is the front of the mass, behind it."
    toe_x = float(results.data.attrs["toe_x"])
    came_back = {
        receptor.name: int(np.count_nonzero(_has_front(results, receptor) & (toe_x + results.runouts < receptor.x[0])))
        for receptor in results.scene.receptor
        if receptor.x[0] > toe_x
    }
    told = [f"{n:,} came back from {name}" for name, n in came_back.items() if n]
    if not told:
        return ""
    return f"The table counts fronts that ended beyond a distance, a place those that were ever there: {listing(told)}."


def _has_front(results: Results, receptor: Receptor) -> NDArray[np.bool_]:
    """Whether the front of a slide was ever at a receptor, (realization,)."""
    return np.asarray(results.data["front_reaches"].sel(receptor=receptor.name).values == 1.0)


def _place(results: Results, receptor: Receptor, reach: list[ReceptorEstimate]) -> Place:
    name = receptor.name
    probabilities = [
        (each.quantity.removeprefix("probability that "), estimated_chance(each.interval), chances(each.interval))
        for each in reach
        if each.receptor == name
    ]
    data = results.data.sel(receptor=name)
    with_front, with_ahead = _has_front(results, receptor), data["receptor_ahead_depth"].values > 0.0
    moves, named = still_moves(data), {**ARRIVALS, **EFFECTS}
    effects = _distributions(data, named, with_front, results.confidence, moves)
    # Once the front has come, what came ahead of it is known.
    ahead = _distributions(data, AHEAD, with_ahead, results.confidence, moves & ~with_front)
    alone = {RISE: f"{EFFECTS[RISE]} where the front does not come"}
    ahead += _distributions(data, alone, with_ahead & ~with_front, results.confidence, moves)
    slides, pushed = int(np.count_nonzero(with_front)), _pushed(with_ahead, with_front)
    comes = with_front | with_ahead
    later = int(np.count_nonzero(may_still_come(data)["front_reaches"] & ~with_front))
    so_far = _so_far(comes, moves, later)
    return Place(
        name,
        receptor.where,
        probabilities,
        slides,
        effects,
        pushed,
        ahead,
        _thrown_back(results, receptor, comes),
        so_far,
    )


def _so_far(comes: NDArray[np.bool_], moves: NDArray[np.bool_], later: int) -> str:
    """Say in how many of the slides that come to a place ground still moved at the end, and of how many more may come.

    It is "" if in none.
    """
    moving, slides = int(np.count_nonzero(comes & moves)), counted(int(np.count_nonzero(comes)), "slide")
    told = []
    if moving:
        told.append(
            f"In {moving:,} of the {slides} that come here, ground somewhere still moved when the run ended: the "
            "largest depths, velocities, fluxes and pressures are lower bounds there, and the rise of the ground is "
            "not the final one. Raise numerics.end_time."
        )
    if later:
        told.append(
            f"In {later:,} more the front may come that was cut short; what arrives then, and when, is in no table."
        )
    return " ".join(told)


def _thrown_back(results: Results, receptor: Receptor, comes: NDArray[np.bool_]) -> str:
    """Say that the wall ahead is near a receptor and has stopped slides that come there, "" if it has none."""
    far = receptor.x[1]
    away = surface_of(results.scene.geometry).width - far
    stopped = int(np.count_nonzero(comes & results.has_status([Status.reached_wall])))
    if not stopped or away > NEAR_A_WALL * results.scene.numerics.cell:
        return ""
    of_those = f"{stopped:,} of the {counted(int(np.count_nonzero(comes)), 'slide')} that come here"
    return (
        f"The wall ahead, {away:g} m from here, stopped {of_those}. Ground piles up at it and is thrown back, so "
        "that depths, velocities and pressures are not those of the slope alone."
    )


def _pushed(with_ahead: NDArray[np.bool_], with_front: NDArray[np.bool_]) -> str:
    """Say in which slides ground comes ahead of the front, "" if in none."""
    slides, alone = int(np.count_nonzero(with_ahead)), int(np.count_nonzero(with_ahead & ~with_front))
    if not slides:
        return ""
    told = f"In {counted(slides, 'slide')} with ground here that is pushed or thrown ahead of the front"
    if not alone:
        return told
    return f"{told}, which {'does not come' if alone == slides else f'in {alone:,} of them does not come'}"


def _distributions(
    data: xr.Dataset,
    named: Mapping[str, str],
    where: NDArray[np.bool_],
    confidence: float,
    may_grow: NDArray[np.bool_],
) -> list[Distribution]:
    """Return what some quantities are in some realizations; nothing without any.

    Those of which the largest is told are lower bounds where they `may_grow`.
    """
    if not where.any():
        return []
    of_largest = {*EFFECTS, *AHEAD} - {RISE}
    return [
        distribution(
            name, data[each].values[where], data[each].units, confidence, (may_grow & (each in of_largest))[where]
        )
        for each, name in named.items()
    ]
