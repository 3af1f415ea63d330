"""Print the verification ladder in Markdown; ``ladder.md`` beside this file is what it printed. It takes minutes."""

import test_column_collapse
import test_conservation
import test_field_moments
import test_free_block
import test_generalized_vortex
import test_incline
import test_limit_loads
import test_manufactured_axis_aligned
import test_mohr_coulomb_paths
import test_return_regions
import test_rotation
import test_self_weight_column
import test_softening_ring
import test_softening_strip
import test_sudden_gravity
import test_two_discs
import test_vibrating_bar
import test_weights

LADDER = {
    "Weights": (test_weights,),
    "Conservation": (test_conservation, test_free_block, test_rotation),
    "Soil law": (test_return_regions, test_mohr_coulomb_paths),
    "Elastic bodies": (
        test_self_weight_column,
        test_sudden_gravity,
        test_vibrating_bar,
        test_manufactured_axis_aligned,
        test_generalized_vortex,
        test_two_discs,
    ),
    "Ground that yields": (
        test_incline,
        test_limit_loads,
        test_softening_ring,
        test_softening_strip,
        test_column_collapse,
    ),
    "Random fields": (test_field_moments,),
}

INTRODUCTION = """\
Made by `python tests/verification/table.py > tests/verification/ladder.md`.

Targets come from closed forms, theory, other methods or experiments; the file of each phenomenon derives them. A row
that misses its target says so and stays. Orders are those between successive grids, each twice as fine. The linear
basis, USL, and plain uGIMP under limit loads are here to show where they fail; [the atlas](../stability/atlas.md) maps
that."""


def main():
    print(INTRODUCTION)
    for group, phenomena in LADDER.items():
        print(f"\n## {group}\n")
        print("| phenomenon | target | observed | error | |")
        print("|---|---|---|---|---|")
        for phenomenon in phenomena:
            for *texts, is_met in phenomenon.rows():
                print("| " + " | ".join([*texts, "met" if is_met else "**misses**"]) + " |", flush=True)


if __name__ == "__main__":
    main()
