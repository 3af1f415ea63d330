"""How to give slides more ground, in the keys of the scene's own kind of geometry."""

from campaign.scene.ground_surface import surface_of
from campaign.scene.scene import Scene
from campaign.terminal import listing, rounded_up


def key_of(scene: Scene, part: str) -> str:
    """Return the key that says how long or deep a part of the ground is, "crest", "plain" or "foundation"."""
    return f"geometry.slope.{part}" if scene.geometry.slope is not None else "geometry.surface"


def behind_crest(scene: Scene) -> str:
    """Say how to move the wall behind the crest away, and what moves with it: x counts from that wall."""
    surface = surface_of(scene.geometry)
    added = rounded_up(max(surface.height, scene.numerics.cell))
    if scene.geometry.slope is not None:
        moved = "".join(f"; add {added} m to the x of each {each}" for each in _placed(scene))
        toe_x = surface.toe_x
        return (
            f"lengthen geometry.slope.crest, for instance by {added} m, which moves the toe from x = {toe_x:.4g} m to "
            f"{toe_x + float(added):.4g} m{moved}"
        )
    shifted = {
        "in the x of all others": True,
        "in geometry.toe": scene.geometry.toe is not None,
    } | {f"in the x of each {each}": True for each in _placed(scene)}
    return (
        f"add ground on the left of geometry.surface, for instance {added} m of it: another point at x = 0 m, and "
        f"{added} m more {listing([place for place, is_there in shifted.items() if is_there])}"
    )


def _placed(scene: Scene) -> list[str]:
    """Return what else has places in a scene."""
    return [name for name, there in {"receptor": scene.receptor, "boring": scene.boring}.items() if there]


def ahead(scene: Scene) -> str:
    """Say how to move the wall ahead of the slope away."""
    if scene.geometry.slope is not None:
        return "lengthen geometry.slope.plain"
    return f"continue geometry.surface beyond x = {surface_of(scene.geometry).width:.4g} m"


def below(scene: Scene) -> str:
    """Say how to move the fixed base away."""
    if scene.geometry.slope is not None:
        return "deepen geometry.slope.foundation"
    return "deepen the ground, with as much added to the elevation of each point of geometry.surface"
