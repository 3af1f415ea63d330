"""Print the verification ladder in Markdown; ``ladder.md`` beside this file is what it printed. It takes minutes.

PYTHONPATH=tests/helpers python tests/studies/ladder.py > tests/studies/ladder.md
"""

from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

VERIFICATION = Path(__file__).parents[1] / "verification"

LADDER = {
    "Weights": ("weights",),
    "Conservation": ("conservation", "free_block", "rotation"),
    "Soil law": ("return_regions", "mohr_coulomb_paths", "tension_cutoff"),
    "Elastic bodies": (
        "self_weight_column",
        "sudden_gravity",
        "vibrating_bar",
        "manufactured_axis_aligned",
        "generalized_vortex",
        "two_discs",
    ),
    "Ground that yields": (
        "incline",
        "limit_loads",
        "softening_ring",
        "softening_strip",
        "column_collapse",
        "granular_column",
    ),
    "Random fields": ("field_moments",),
}

INTRODUCTION = """\
Made by `PYTHONPATH=tests/helpers python tests/studies/ladder.py > tests/studies/ladder.md`.

Targets come from closed forms, theory, other methods or experiments; the file of each phenomenon derives them. A row
that misses its target says so and stays. Orders are those between successive grids, each twice as fine. The linear
basis, USL, and plain uGIMP under limit loads are here to show where they fail; [the atlas](atlas.md) maps that."""


def load(phenomenon):
    """Return the test module of a phenomenon. It lies in no package, so it is found by its path."""
    place = spec_from_file_location(phenomenon, VERIFICATION / f"test_{phenomenon}.py")
    module = module_from_spec(place)
    place.loader.exec_module(module)
    return module


def main():
    print(INTRODUCTION)
    for group, phenomena in LADDER.items():
        print(f"\n## {group}\n")
        print("| phenomenon | target | observed | error | |")
        print("|---|---|---|---|---|")
        for phenomenon in phenomena:
            for *texts, is_met in load(phenomenon).rows():
                print("| " + " | ".join([*texts, "met" if is_met else "**misses**"]) + " |", flush=True)


if __name__ == "__main__":
    main()
