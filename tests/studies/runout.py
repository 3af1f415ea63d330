"""How far from converged the run-out of ``ma2023`` is: cells, particles, time step, lattice, domain, release and end.

    python tests/studies/runout.py

computes what ``runout.json`` lacks (two hours on two cores if it is empty, most of it the cell of 0.125 m) and writes
``runout.md`` and ``runout.png``. All runs are deterministic, with mean strengths; run-out is ``final_runout_mass``.
"""

import json
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

import runout_report
from runout_ladders import LADDERS, NOISE, key_of

from campaign.scene import load_scene
from campaign.seeds import BASELINE
from campaign.simulation.ground import prepare

STORE = Path(__file__).with_suffix(".json")
KEPT = ("final_runout_mass", "final_runout", "sliding_volume", "settle_time", "energy_error", "wall_time")


def compute(scene, overrides):
    """Return the status of the deterministic run and the values that are kept."""
    record = prepare(load_scene(scene, overrides)).simulate(BASELINE)
    return {"status": record.status.name} | {name: float(record.values[name]) for name in KEPT}


def main():
    """Compute what is missing, coarse cells first, then write the report."""
    results = json.loads(STORE.read_text()) if STORE.exists() else {}
    wanted = {key_of(run): run for ladder in (*LADDERS, *NOISE) for run in ladder.runs}
    missing = sorted(wanted.keys() - results.keys(), key=lambda key: -wanted[key].cell)
    with ProcessPoolExecutor() as pool:
        running = {pool.submit(compute, wanted[key].scene, wanted[key].overrides): key for key in missing}
        for done in as_completed(running):
            results[running[done]] = done.result()
            STORE.write_text(json.dumps(results, indent=1, sort_keys=True) + "\n")
            print(f"{running[done]}: {results[running[done]]['final_runout_mass']:.2f} m", flush=True)
    runout_report.write(results, STORE.with_suffix(".md"), STORE.with_suffix(".png"))


if __name__ == "__main__":
    main()
