"""What cannot be run is refused from the scene alone, before anything of its size is allocated."""

import numpy as np
import pytest

from campaign.record import missing_values
from campaign.scene import load_scene
from campaign.scene.complaints import sentences
from campaign.scene.cost import dataset_bytes, particle_count, rank_bytes, realization_seconds, record_bytes, step_count
from campaign.scene.limits import pic_loss, refusals
from campaign.simulation.contract import sizes
from campaign.simulation.ground import prepare

GIGABYTE = 1e9


def refused(*overrides, memory=16 * GIGABYTE):
    scene = load_scene("ma2023", overrides)
    return sentences(refusals(scene, memory), scene)


def test_the_built_in_scenes_run_on_a_laptop():
    assert all(refusals(load_scene(name), 8 * GIGABYTE) == [] for name in ("ma2023", "ma2023-printed", "bui2008"))


@pytest.mark.parametrize(
    ("override", "sentence"),
    [
        (
            "numerics.cell=1e-6 m",
            "but the ground of 75 m x 19 m then has 2.85e+15 particles in cells of 1e-06 m",
        ),
        (
            "geometry.slope.plain=1e9 m",
            "but the ground of 1e+09 m x 19 m then has 1.6e+10 particles in cells of 1 m",
        ),
        ("numerics.output_interval=1e-9 s", 'is "1e-9 s", but with 1e+10 output times the results of 1,000'),
        ("campaign.realizations=100000000", "and this machine has 16 GB; use at most 776,"),
        ("soil.softening.internal_length=1e14 m", "but the ground is 75 m wide; use the thickness of a shear band"),
        ("numerics.courant=1e-15", "a realization then takes 2.8e+18 steps of 3.6e-18 s, 1.6e+07 years; check"),
        ("soil.unit_weight=1e-15 N/m^3", "years; check what decides them"),
        ("numerics.flip=0.9", "ends as diverged, so that no slide would count; use 1."),
    ],
)
def test_what_cannot_be_run_is_refused_with_its_remedy(override, sentence):
    found = refused(override)
    assert len(found) == 1
    assert found[0].startswith(f"--set {override.partition('=')[0]} is ")
    assert sentence in found[0]


def test_the_remedy_for_too_many_realizations_is_accepted():
    remedy = refused("campaign.realizations=100000000")[0].rpartition("at most ")[2].rstrip(".").replace(",", "")
    assert refused(f"campaign.realizations={remedy}") == []
    assert refused(f"campaign.realizations={int(remedy) + 10}") != []


def test_memory_follows_the_particles_and_the_realizations():
    small, large = load_scene("ma2023"), load_scene("ma2023", ["numerics.cell=0.1 m"])
    assert rank_bytes(large) - rank_bytes(small) == 1000 * (particle_count(large) - particle_count(small))
    assert dataset_bytes(load_scene("ma2023", ["campaign.realizations=2000"])) == 2 * dataset_bytes(small)


@pytest.mark.parametrize("receptors", ["[]", '[{name="road",x="42 m"},{name="house",x=["45 m","50 m"]}]'])
def test_a_record_is_as_large_as_foreseen(receptors):
    ground = prepare(load_scene("ma2023", ["numerics.gravity=ramp", "numerics.cell=2 m", f"receptor={receptors}"]))
    values = missing_values(ground.quantities, sizes(ground)).values()
    assert record_bytes(ground.scene) == pytest.approx(sum(np.asarray(value).nbytes for value in values), rel=0.1)


def test_output_intervals_shorter_than_the_time_step_decide_the_steps():
    """Each interval takes whole steps, one at least."""
    assert step_count(load_scene("ma2023", ["numerics.output_interval=1e-3 s"])) == 10_000
    long = load_scene("ma2023", ["numerics.output_interval=10 s"])
    fine = load_scene("ma2023", ["numerics.output_interval=1e-4 s"])
    assert realization_seconds(fine) / realization_seconds(long) == pytest.approx(100_000 / 3508)


def test_damping_is_estimated_as_it_was_measured():
    """A flip of 0.9999 took 0.00096 of the work of gravity on cells of 1 m, at a Courant number of 0.6."""
    assert pic_loss(load_scene("ma2023", ["numerics.flip=0.9999", "numerics.courant=0.6"])) == pytest.approx(
        0.00096, rel=0.1
    )
    assert pic_loss(load_scene("ma2023")) == 0.0
