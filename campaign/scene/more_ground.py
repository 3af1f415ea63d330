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
        moved = "".join(f"; add {added} m to the x of {each}" for each in _placed(scene))
        toe_x = surface.toe_x
        return (
            f"lengthen geometry.slope.crest, for instance by {added} m, which moves the toe from x = {toe_x:.4g} m to "
            f"{toe_x + float(added):.4g} m{moved}"
        )
    shifted = {
        "in the x of all others": True,
        "in geometry.toe": scene.geometry.toe is not None,
    } | {f"in the x of {each}": True for each in _placed(scene)}
    return (
        f"add ground on the left of geometry.surface, for instance {added} m of it: another point at x = 0 m, and "
        f"{added} m more {listing([place for place, is_there in shifted.items() if is_there])}"
    )


def ahead(scene: Scene) -> str:
    """Say how to move the wall ahead of the slope away, and what has to go on to it."""
    if scene.geometry.slope is not None:
        return f"lengthen geometry.slope.plain{lines_with_it(scene)}"
    return f"continue geometry.surface beyond x = {surface_of(scene.geometry).width:.4g} m{lines_with_it(scene)}"


def lines_with_it(scene: Scene) -> str:
    """Say which lines go on with the ground to a wall ahead that is moved away, "" without any."""
    lines = lines_across(scene)
    return f", and {listing(lines)} with it" if lines else ""


def below(scene: Scene) -> str:
    """Say how to move the fixed base away, and what moves with it: elevations count from that base."""
    if scene.geometry.slope is not None:
        return f"deepen geometry.slope.foundation{raised_with_it(scene)}"
    moved = listing(["each point of geometry.surface", *elevations(scene)])
    return f"deepen the ground, with as much added to the elevation of {moved}"


def raised_with_it(scene: Scene) -> str:
    """Say to which elevations a deeper foundation adds as much, "" without any."""
    raised = elevations(scene)
    return f", with as much added to the elevation of {listing(raised)}" if raised else ""


def elevations(scene: Scene) -> list[str]:
    """Return what else is drawn at elevations above the base."""
    return [
        name
        for name, is_there in {
            "each layer's top": any(layer.top is not None for layer in scene.layer),
            "water.table": scene.water.table is not None,
            "water.level": scene.water.level is not None,
            "the data of each boring": any(boring.by == "elevation" for boring in scene.boring),
        }.items()
        if is_there
    ]


def lines_across(scene: Scene) -> list[str]:
    """Return the lines that are drawn from wall to wall, apart from the surface; a level has no ends."""
    tops = [f"layer.{number}.top" for number, layer in enumerate(scene.layer, start=1) if len(layer.top or ()) > 1]
    return [*tops, *(["water.table"] if len(scene.water.table or ()) > 1 else [])]


def _placed(scene: Scene) -> list[str]:
    """Return what else has places in a scene, all of whose x count from the wall behind the crest."""
    marks = {"each receptor": scene.receptor, "each boring": scene.boring}
    drawn = (f"each point of {line}" for line in lines_across(scene))
    return [*(name for name, there in marks.items() if there), *drawn]
