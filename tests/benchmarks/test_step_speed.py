"""Speed of the whole step with plasticity, on one core: `python tests/benchmarks/test_step_speed.py` prints it."""

import statistics
import time

import pytest

from campaign.scene import load_scene
from campaign.seeds import BASELINE
from campaign.simulation.ground import prepare
from solver.constants import STANDARD_GRAVITY
from solver.march import March
from solver.step import advance
from solver.timestep import stable_step

TARGET = 12e6  # particle-steps a second: what one core of a server of 2023 did before particles went eight at once
STEPS = 300
RUNS = 7
IN_FULL_SLIDE = 2.0  # s


def particle_steps_per_second() -> list[float]:
    """Return the speed in each of `RUNS` stretches of the printed scene (10,090 particles) in full slide."""
    ground = prepare(load_scene("ma2023-printed"))
    march = March(ground.model, ground.released(BASELINE))
    march.advance_to(IN_FULL_SLIDE)
    model = ground.model
    dt = stable_step(model.courant, model.cell_size, model.wave_speed, 5.0)
    speeds = []
    for _ in range(RUNS):
        begin = time.perf_counter()
        taken = advance(
            march.particles, march.grid, march.work, model.laws, model.scheme, STANDARD_GRAVITY, 0.0, dt, STEPS
        )
        speeds.append(taken * ground.n_particles / (time.perf_counter() - begin))
    return speeds


@pytest.mark.slow
def test_the_whole_step_reaches_12_million_particle_steps_a_second():
    """Median of seven stretches; the target holds for one core of a server of 2023, run with nothing beside it."""
    assert statistics.median(particle_steps_per_second()) > TARGET


def main() -> None:
    """Print the speed and the machine."""
    speeds = [speed / 1e6 for speed in particle_steps_per_second()]
    print(
        f"{statistics.median(speeds):.1f} million particle-steps/s "
        f"(median of {RUNS}; {min(speeds):.1f} to {max(speeds):.1f}), double precision, one core"
    )


if __name__ == "__main__":
    main()
