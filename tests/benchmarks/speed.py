"""Measure the speed of the step on this machine, beside what it can do at most and beside two other codes.

    python tests/benchmarks/speed.py             a table, for you
    python tests/benchmarks/speed.py --keep      the same, and speed.json and README's section anew

Everything is measured in turns, so that whatever else the machine does disturbs all alike; processor time of one
core, median of the turns, least and most in brackets. Taichi is measured where it is installed.
"""

import argparse
import json
import platform
import statistics
import time
from pathlib import Path
from typing import NamedTuple

import frozen_step
import llvmlite
import numba
import numpy as np
import step_operations
import taichi_step
from peaks import multiply_adds, triad_over

from campaign.scene import load_scene
from campaign.seeds import BASELINE
from campaign.simulation.ground import prepare
from solver.constants import STANDARD_GRAVITY
from solver.march import March
from solver.particles import copy_particles
from solver.sorting import fill_tiles
from solver.step import allocate_workspace, take_steps
from solver.timestep import stable_step

KEPT = Path(__file__).with_name("speed.json")
TURNS = 11
IN_FULL_SLIDE = 2.0  # s
STEPS = {0.5: 200, 0.25: 60}  # a turn, about half a second of each
FROZEN_STEPS = 40
FROZEN, TAICHI = "plain scalar loop, 0.5 m", "Taichi: MLS-MPM, Drucker-Prager, 0.5 m"
CASES = [(scene, cell) for cell in (0.5, 0.25) for scene in ("ma2023-printed", "ma2023")]


class Sliding:
    """A scene with mean strengths in full slide, which is put back to where it was before each turn.

    It is put into other memory, too: where its arrays lie decides a sixth of the speed, and no turn may stand for all.
    """

    def __init__(self, scene, cell):
        self.scene, self.cell = scene, cell
        self.ground = prepare(load_scene(scene, [f"numerics.cell={cell} m"]))
        self.model = self.ground.model
        march = March(self.model, self.ground.released(BASELINE))
        march.advance_to(IN_FULL_SLIDE)
        self.start = march.particles
        self.dt = stable_step(self.model.courant, self.model.cell_size, self.model.wave_speed, 5.0)
        self._place()

    def _place(self):
        self.particles, self.grid = copy_particles(self.start), self.model.allocate_grid()
        self.work = allocate_workspace(self.start.x.size)
        self.tiles = fill_tiles(self.particles, self.grid, self.work.tiles)
        self._take(0, are_new=True)

    def back(self):
        """Go back to the start in other memory."""
        before = self.particles, self.grid, self.work
        self._place()
        del before

    def steps(self, steps):
        """Take so many steps."""
        self._take(steps, are_new=False)

    def _take(self, steps, are_new):
        model, gravity = self.model, STANDARD_GRAVITY
        self.tiles, _ = take_steps(
            self.tiles, self.grid, self.work, model.laws, model.scheme, gravity, 0.0, self.dt, steps, are_new
        )

    @property
    def name(self):
        return f"{self.scene}, {self.cell:g} m"


class Turns(NamedTuple):
    """What was measured, in the same unit in every turn."""

    unit: str
    values: list

    def summary(self):
        return {
            "unit": self.unit,
            "median": statistics.median(self.values),
            "least": min(self.values),
            "most": max(self.values),
        }


def processor_time(function):
    """Return the seconds of processor time that a call takes."""
    begin = time.process_time()
    function()
    return time.process_time() - begin


class Contestants:
    """All that is measured, warm."""

    def __init__(self, cases, with_taichi):
        self.peaks = list(_peaks())
        self.slides = [Sliding(*case) for case in cases]
        slide = self.slides[0]
        law, dt = slide.model.materials[0].law, slide.dt
        self.frozen = frozen_step.copied(slide.start, slide.grid)
        self.constants = law.bulk_modulus, law.shear_modulus, law.softening.rate, STANDARD_GRAVITY, dt
        self.taichi = None
        if with_taichi:
            self.taichi = taichi_step.TaichiSlope(slide.start, slide.grid, *self.constants[:2], dt)
        self.turn()  # compiles

    def turn(self):
        """Measure all once; return values in the unit of each, by kind and name."""
        found = {("peak", name): (unit, amount / processor_time(go) / 1e9) for name, unit, go, amount in self.peaks}
        for slide in self.slides:
            slide.back()
            steps = STEPS[slide.cell]
            seconds = processor_time(lambda slide=slide, steps=steps: slide.steps(steps)) / steps
            n = slide.ground.n_particles
            found["step", slide.name] = ("million particle-steps/s", n / seconds / 1e6)
            slide.back()
            parts = step_operations.seconds_of_parts(slide.particles, slide.grid, slide.work, slide.model, slide.dt)
            per_step = [part / step_operations.STEPS for part in parts]
            rest = max(0.0, seconds - sum(per_step))
            for part, took in zip((*step_operations.PARTS, "sort"), (*per_step, rest), strict=True):
                found["part", f"{slide.name}: {part}"] = ("ns a particle-step", took / n * 1e9)
        return found | self._others()

    def _others(self):
        n = self.slides[0].ground.n_particles
        found = {("other", FROZEN): ("million particle-steps/s", FROZEN_STEPS * n / processor_time(self._frozen) / 1e6)}
        if self.taichi is not None:
            speed = taichi_step.STEPS * n / processor_time(self.taichi.take_steps) / 1e6
            found["other", TAICHI] = ("million particle-steps/s", speed)
        return found

    def _frozen(self):
        """Take steps of the plain loop from the start, like all others."""
        ground, nodes = self.frozen
        ground = frozen_step.Ground(*(array.copy() for array in ground))
        frozen_step.take_steps(ground, nodes, np.empty_like(ground.x), *self.constants, FROZEN_STEPS)


def _peaks():
    go, amount = multiply_adds()
    yield "multiply-add", "billion multiply-adds/s", go, amount
    for mebibytes, place in ((1, "1 MiB"), (96, "96 MiB")):
        go, amount = triad_over(mebibytes)
        yield f"triad over {place}", "GB/s", go, amount


def measure(cases=CASES, with_taichi=taichi_step.IS_INSTALLED, turns=TURNS):
    """Return, by kind and name, what was measured in each turn."""
    contestants = Contestants(cases, with_taichi)
    measured = [contestants.turn() for _ in range(turns)]
    return {key: Turns(measured[0][key][0], [turn[key][1] for turn in measured]) for key in measured[0]}


def as_json(measured):
    """Return measurements as they are kept, with the ratio of each speed to that of the plain loop, turn by turn."""
    frozen = measured["other", FROZEN].values
    kept = {"machine": machine(), "turns": len(frozen)}
    for (kind, name), turns in measured.items():
        kept.setdefault(kind, {})[name] = turns.summary()
        if kind in ("step", "other"):
            ratios = [one / other for one, other in zip(turns.values, frozen, strict=True)]
            kept.setdefault("ratio", {})[name] = Turns("times the plain scalar loop", ratios).summary()
    return kept


def machine():
    """Return what the figures depend on."""
    return {
        "processor": _processor(),
        "vectors": _vectors(),
        "python": platform.python_version(),
        "numba": numba.__version__,
        "llvm": ".".join(map(str, llvmlite.binding.llvm_version_info)),
    }


def _vectors():
    features = llvmlite.binding.get_host_cpu_features()
    known = {"avx512f": "AVX-512", "avx2": "AVX2", "neon": "NEON"}
    return next((name for feature, name in known.items() if features.get(feature)), "none of these")


def _processor():
    try:
        lines = Path("/proc/cpuinfo").read_text("utf-8").splitlines()
    except OSError:
        return platform.processor()
    return next((line.partition(": ")[2] for line in lines if line.startswith("model name")), platform.machine())


def table(kept):
    """Return what was measured as text."""
    lines = [", ".join(f"{name} {value}" for name, value in kept["machine"].items()), ""]
    for kind in ("peak", "step", "other", "ratio", "part"):
        for name, of in kept[kind].items():
            spread = f"({of['least']:.4g} to {of['most']:.4g})"
            lines.append(f"{name:62s} {of['median']:8.4g} {spread:22s} {of['unit']}")
        lines.append("")
    return "\n".join(lines)


def main():
    """Measure, print, and keep if asked to."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--keep", action="store_true", help="write speed.json and README's section")
    parser.add_argument("--json", type=Path, help="write the measurements to this file")
    options = parser.parse_args()
    kept = as_json(measure())
    print(table(kept))
    for path in filter(None, (options.json, KEPT if options.keep else None)):
        path.write_text(json.dumps(kept, indent=1) + "\n", "utf-8")
    if options.keep:
        from readme_speed import README, with_speed

        README.write_text(with_speed(README.read_text("utf-8")), "utf-8")


if __name__ == "__main__":
    main()
