"""Whether the toe is where slides come out: run-out is measured from it, and only ground upslope of it is a front."""

from campaign.scene import Scene
from campaign.scene.complaints import Complaint
from campaign.scene.first_look import FirstLook
from campaign.scene.limit_equilibrium import SlipCircle

BELOW, ABOVE = 0.1, 0.4
"""Of the height of a critical circle: how far it may come out below the toe, on ground that falls, and above it."""


def misplaced_toe(scene: Scene, look: FirstLook) -> Complaint | None:
    """Warn of a toe that is far from where the critical slip circle comes out."""
    if look.peak is None or scene.geometry.slope is not None:
        return None
    rise = _rise(look, look.peak)
    if -BELOW <= rise <= ABOVE:
        return None
    exit_, toe_y = look.peak.exit, look.surface.toe[1]
    circle = f"the critical slip circle comes out at x = {exit_:.3g} m"
    if rise < 0.0:
        text = f"{circle}, below the toe at elevation {toe_y:.3g} m: what slides beyond the toe is no front there"
        return Complaint(_key(scene), f'{text}; use geometry.toe = "{exit_:.3g} m"')
    text = f"{circle}, high above the toe: a slide that stops before the toe, x = {look.surface.toe_x:.3g} m, runs 0 m"
    return Complaint(_key(scene), f'{text}; use geometry.toe = "{exit_:.3g} m" if that slide is meant')


def _key(scene: Scene) -> str:
    return "geometry.surface" if scene.geometry.toe is None else "geometry.toe"


def _rise(look: FirstLook, circle: SlipCircle) -> float:
    """Return how high a circle comes out above the toe, in heights of the circle."""
    upper, lower = circle.elevation_of_ends(look.surface)
    return (lower - look.surface.toe[1]) / max(upper - lower, 1e-9)
