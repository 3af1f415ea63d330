"""Print the verification ladder as a Markdown table; ``ladder.md`` beside this file is what it printed."""

import test_free_block
import test_generalized_vortex
import test_manufactured_axis_aligned
import test_rotation
import test_self_weight_column
import test_two_discs
import test_vibrating_bar

LADDER = (
    test_self_weight_column,
    test_vibrating_bar,
    test_manufactured_axis_aligned,
    test_generalized_vortex,
    test_rotation,
    test_two_discs,
    test_free_block,
)


def main():
    print("Made by `python tests/verification/table.py > tests/verification/ladder.md`. What is expected comes from")
    print("theory and the literature; rows that miss it stay.\n")
    print("| phenomenon | expected | observed | error |")
    print("|---|---|---|---|")
    for phenomenon in LADDER:
        for row in phenomenon.rows():
            print("| " + " | ".join(row) + " |")


if __name__ == "__main__":
    main()
