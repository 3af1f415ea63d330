"""Copy the orders of convergence from the ladder into README.

python tests/studies/readme_orders.py
"""

from pathlib import Path

LADDER = Path(__file__).with_name("ladder.md")
README = Path(__file__).parents[2] / "README.md"
BEGIN, END = "<!-- orders: from the ladder -->\n", "<!-- orders end -->\n"


def orders():
    """Return the table of all rows of the ladder whose target or result is an order."""
    rows = [line for line in LADDER.read_text("utf-8").splitlines(keepends=True) if line.startswith("| ")]
    head = "| phenomenon | target | observed | error | |\n|---|---|---|---|---|\n"
    return head + "".join(row for row in rows if "| order " in row)


def with_orders(text):
    """Return the text of README with that table between its marks."""
    before, _, rest = text.partition(BEGIN)
    return before + BEGIN + orders() + END + rest.partition(END)[2]


if __name__ == "__main__":
    README.write_text(with_orders(README.read_text("utf-8")), "utf-8")
