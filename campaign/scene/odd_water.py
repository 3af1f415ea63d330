"""Water that can be computed, but not to the end of a slide."""

from campaign.scene.complaints import Complaint
from campaign.scene.ground_water import most_carried
from campaign.scene.scene import Scene

MUCH_CARRIED = 0.55
"""Share of the weight above that pores carry, beyond which slides drive themselves apart. Of 3 realizations of
two slopes each none failed with r_u = 0.4, 2 of 6 with 0.5, all with 0.6; with a table at the surface none at 0.55, 1
of 3 at 0.59, all at 0.65."""


def afloat(scene: Scene) -> Complaint | None:
    """Warn of ground that nearly floats: its pore pressure does not fall where it comes apart, and drives it on."""
    share = most_carried(scene)
    if share <= MUCH_CARRIED:
        return None
    key = "water.r_u" if scene.water.r_u else "water.level" if scene.water.table is None else "water.table"
    return Complaint(
        key,
        f"pore pressure then carries up to {100 * share:.0f} % of the weight above, and beyond "
        f"{100 * MUCH_CARRIED:.0f} % slides mostly drive themselves apart until they end as diverged or left_domain; "
        "their ground is a fluid rather than a soil",
    )
