"""What cannot be run, known from the scene alone: found before anything of its size is allocated."""

from math import sqrt

from campaign.scene import Scene
from campaign.scene.complaints import Complaint, found
from campaign.scene.cost import (
    dataset_bytes,
    output_count,
    particle_count,
    rank_bytes,
    realization_seconds,
    record_bytes,
    step_count,
    time_step,
)
from campaign.scene.ground_surface import surface_of
from campaign.scene.more_ground import key_of
from campaign.terminal import data_size
from solver.constants import STANDARD_GRAVITY

ALLOWED_LOSS = 0.005
"""Of the work of gravity: a slide that loses more to a blend with PIC is reported as diverged, see `solver.march`."""

LOSS_PER_STEP = 0.003
"""Share of the work of gravity lost in a step, times the share of PIC, in the 6 sqrt(H / g) that a slide lasts. Runs of
`ma2023` with a flip of 0.99999 and 0.9999 lost 0.0028 of it, one with 0.999 0.002."""


LONG_GROUND = 100.0
"""Width over height of ground that is meant to be shorter."""

YEAR = 365.25 * 86400.0
"""Seconds that a realization may take: nobody has waited for one so long."""

COPIES = 2
"""Of the results that rank 0 holds when it writes them: as records, and as a dataset."""


def refusals(scene: Scene, memory: float) -> list[Complaint]:
    """Return why a scene cannot be run on a machine with so much memory (bytes); nothing if it can."""
    size = too_many_particles(scene, memory) or too_large_results(scene, memory) or endless(scene)
    return found((size, too_long_average(scene), too_much_damping(scene)))


def too_many_particles(scene: Scene, memory: float) -> Complaint | None:
    """Complain about ground that does not fit into the memory of one rank."""
    if rank_bytes(scene) <= memory:
        return None
    ground = surface_of(scene.geometry)
    long = key_of(scene, "plain")
    return Complaint(
        long if ground.width > LONG_GROUND * ground.top else "numerics.cell",
        f"the ground of {ground.width:g} m x {ground.top:g} m then has {particle_count(scene):,.3g} particles in cells "
        f"of {scene.numerics.cell:g} m, which take {data_size(rank_bytes(scene))} of memory on each rank, and this "
        f"machine has {data_size(memory)}; use a shorter ground or larger cells",
    )


def too_large_results(scene: Scene, memory: float) -> Complaint | None:
    """Complain about results that rank 0 cannot hold."""
    needed = COPIES * dataset_bytes(scene)
    if needed <= memory:
        return None
    outputs, wanted = output_count(scene), scene.campaign.realizations
    sizes = f"{data_size(needed)} of memory when they are written, and this machine has {data_size(memory)}"
    if outputs > particle_count(scene):
        text = f"with {outputs:,.3g} output times the results of {wanted:,.6g} realizations take {sizes}"
        return Complaint("numerics.output_interval", f"{text}; use a longer interval")
    largest = int(memory / (COPIES * record_bytes(scene)))
    return Complaint("campaign.realizations", f"their results take {sizes}; use at most {largest:,}")


def endless(scene: Scene) -> Complaint | None:
    """Complain about realizations that nobody lives to see, under the key that is farthest from what is usual."""
    seconds, step, numerics = realization_seconds(scene), time_step(scene), scene.numerics
    if seconds <= YEAR:
        return None
    beyond_usual = {
        "numerics.courant": 0.3 / numerics.courant,
        "numerics.end_time": numerics.end_time / 100.0,
        "numerics.output_interval": step / numerics.output_interval,
        "numerics.cell": particle_count(scene) / 1e5,
        "soil.young_modulus": sqrt(max(soil.young_modulus for soil in scene.soils) / 1e8),
        "soil.unit_weight": sqrt(2e4 / min(soil.unit_weight for soil in scene.soils)),
    }
    return Complaint(
        max(beyond_usual, key=beyond_usual.__getitem__),
        f"a realization then takes {step_count(scene):.2g} steps of {step:.2g} s, {seconds / YEAR:.2g} years; check "
        "what decides them (courant, cell, young_modulus, unit_weight, end_time)",
    )


def too_long_average(scene: Scene) -> Complaint | None:
    """Complain about an average of plastic strain over more than the ground."""
    length, width = scene.soil.softening.internal_length, surface_of(scene.geometry).width
    if length is None or length <= width:
        return None
    return Complaint(
        "soil.softening.internal_length",
        f"the ground is {width:g} m wide; use the thickness of a shear band, or what a few cells resolve",
    )


def too_much_damping(scene: Scene) -> Complaint | None:
    """Complain about a blend with PIC that takes more than three times the energy that a result may lose."""
    loss = pic_loss(scene)
    if loss <= 3.0 * ALLOWED_LOSS:
        return None
    return Complaint("numerics.flip", f"{damping(loss)}, so that no slide would count; use 1")


def damping(loss: float) -> str:
    """Say what a loss means."""
    return (
        f"this damping takes about {100 * min(loss, 1.0):.1f} % of the work of gravity from a slide, and one that "
        f"loses more than {100 * ALLOWED_LOSS:.1f} % ends as diverged"
    )


def pic_loss(scene: Scene) -> float:
    """Return the share of the work of gravity that a blend with PIC takes from a slide, roughly."""
    lasts = min(6.0 * sqrt(surface_of(scene.geometry).height / STANDARD_GRAVITY), scene.numerics.end_time)
    return LOSS_PER_STEP * (1.0 - scene.numerics.flip) * lasts / time_step(scene)
