"""The models of a scene, and how well the mean run-out is known from them, in words."""

from campaign.accuracy.mesh_limit import MeshLimit
from campaign.accuracy.pursuit import PILOT, PILOT_OF_FINEST, PILOT_OF_QUARTER, Ladder, Pursuit
from campaign.accuracy.settings import Models
from campaign.scene import Scene
from campaign.scene.constraints import tolerance
from campaign.scene.units import PRESSURE, shown_in_unit
from campaign.terminal import counted, duration


def setting(scene: Scene) -> str:
    """Say what makes a model, "with cells of 0.5 m and E = 100 MPa"."""
    return f"with cells of {scene.numerics.cell:g} m and E = {shown_in_unit(scene.soil.young_modulus, PRESSURE)}"


def plan(models: Models, scene: Scene) -> str:
    """Say what is going to be run and what it costs, before anything is."""
    first, *finer = models.ladders
    own = scene.numerics.cell
    known = f"{duration(_pilot_seconds(first, PILOT_OF_FINEST))} of CPU time"
    further = ""
    if finer:
        least = duration(PILOT_OF_QUARTER * finer[0][0].cost)
        further = (
            f" If the mesh then takes too much of that, cells of {own / 4:g} m follow, {PILOT_OF_QUARTER} or more "
            f"realizations of them in {least}."
        )
    return (
        f"{scene.campaign.accuracy} of the mean run-out are wanted for sampling and mesh together. "
        f"First {PILOT_OF_FINEST} realizations with cells of {own / 2:g} m and {PILOT} of each cheaper model tell "
        f"scatter and correlation, in {known}; then as many of each as cost least.{further}"
    )


def _pilot_seconds(ladder: Ladder, of_finest: int) -> float:
    finest, *others = ladder
    return of_finest * finest.cost + PILOT * sum(model.cost for model in others)


def verdict(found: Pursuit, scene: Scene) -> str:
    """Say whether the accuracy is reached, and if not, what stands in the way."""
    if found.limit is None:
        return "no accuracy of a run-out: too few of the realizations slid"
    wanted = tolerance(scene.campaign.accuracy or "")
    told = f"the mean run-out is known to {error_of(found.limit)}, {scene.campaign.accuracy} were asked"
    if found.is_reached:
        return f"accuracy reached: {told}"
    mesh, asked = found.limit.mesh, wanted.metres(found.limit.counted.estimate)
    why = (
        f"the mesh alone takes {mesh:.2f} m; start from a smaller numerics.cell"
        if mesh > asked / 2
        else f"it takes more than the {counted(scene.campaign.realizations, 'realization')} of campaign.realizations"
    )
    return f"accuracy not reached: {told}; {why}"


def error_of(limit: MeshLimit) -> str:
    """Return the total error in m and as a share, "±0.29 m (2.9 %)"."""
    return f"±{limit.error:.2f} m ({100 * limit.error / limit.counted.estimate:.2g} %)"
