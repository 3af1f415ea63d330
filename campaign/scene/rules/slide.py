"""A slope can fail, and has a sliding mass when it has."""

from campaign.scene.ground_surface import surface_through
from campaign.scene.rules.measures import Points
from campaign.scene.rules.rule import Rules

RULES = Rules()


@RULES.on("slide.failed", "geometry.slope.height")
def _failure_within_height(failed: float, height: float) -> str | None:
    if failed >= height:
        return f"a slope of {height:g} m can fail without moving that far; use about a fifteenth of its height"
    return None


@RULES.on("slide.failed", "geometry.surface")
def _failure_within_surface(failed: float, surface: Points | None) -> str | None:
    return None if surface is None else _failure_within_height(failed, surface_through(surface).height)


@RULES.on("slide.displaced", "slide.failed")
def _displaced_before_failed(displaced: float, failed: float) -> str | None:
    if displaced > failed:
        return f"a slope that has failed, by {failed:g} m, must have a sliding mass; use at most that"
    return None
