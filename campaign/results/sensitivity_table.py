"""The variables of the dataset that tell what the run-out owes to the soil and to the inputs: one table.

`python -m campaign.results.sensitivity_table` prints it for README.
"""

from campaign.record import Quantity, markdown_table

MEAN = "mean of a property's logarithm over the ground that moves"
FORETOLD = "foretell of realizations left out"
BOX = ("property", "box_y", "box_x")

ESTIMATES: dict[str, Quantity] = {
    "runout_correlation": Quantity(
        ("property",), "1", f"rank correlation (Spearman) of the slides' final run-out with the {MEAN}"
    ),
    "runout_regression": Quantity(
        ("property",), "1", f"standard deviations of final run-out per standard deviation of the {MEAN}, all together"
    ),
    "slide_correlation": Quantity(("property",), "1", f"rank correlation of sliding (1, else 0) with the {MEAN}"),
    "slide_regression": Quantity(
        ("property",), "1", f"standard deviations of sliding per standard deviation of the {MEAN}, all together"
    ),
    "sensitivity_everywhere": Quantity(
        ("property",), "m", "sum of sensitivity over the boxes: what 10 % more of a property everywhere changes"
    ),
    "input_effect": Quantity(("input",), "m", "mean of input_difference over the pairs"),
}
"""Each has its confidence interval in the variable of the same name with `_ci`."""

OTHERS: dict[str, Quantity] = {
    "runout_explained": Quantity((), "1", f"share of the variance of the slides' run-out that those means {FORETOLD}"),
    "slide_explained": Quantity((), "1", f"share of the variance of sliding (1, else 0) that those means {FORETOLD}"),
    "sensitivity": Quantity(BOX, "m", "change of a slide's final run-out by 10 % more of a property in a box", "f4"),
    "sensitivity_error": Quantity(BOX, "m", "standard error of sensitivity by sampling", "f4"),
    "sensitivity_clear": Quantity(BOX, "1", "1 where sensitivity can be told from none, else 0", "i1"),
    "sensitivity_explained": Quantity(
        (), "1", f"share of the variance of the slides' run-out that the maps {FORETOLD}"
    ),
    "input_difference": Quantity(
        ("input", "input_pair"), "m", "final run-out of a slide with 10 % more of an input minus that without"
    ),
}


def markdown() -> str:
    """Return the variables as a table in Markdown."""
    with_interval = [(f"`{name}`, `{name}_ci`", row) for name, row in ESTIMATES.items()]
    return markdown_table([*with_interval, *((f"`{name}`", row) for name, row in OTHERS.items())])


if __name__ == "__main__":
    print(markdown())
