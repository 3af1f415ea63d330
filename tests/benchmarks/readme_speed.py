"""Copy what the benchmark has measured into README.

python tests/benchmarks/readme_speed.py
"""

import json
from pathlib import Path

SPEED = Path(__file__).with_name("speed.json")
README = Path(__file__).parents[2] / "README.md"
BEGIN, END = "<!-- speed: from the benchmark -->\n", "<!-- speed end -->\n"


HEAD = """\
| step, cell | speed over the plain loop's | multiply-adds that the core could have done in a particle-step |
|---|---|---|
"""


def section():
    """Return the sentence and the table of ratios, which travel from machine to machine; speeds do not."""
    kept = json.loads(SPEED.read_text("utf-8"))
    peak, speeds = kept["peak"]["multiply-add"]["median"], kept["step"] | kept["other"]
    rows = "".join(
        f"| {_called(name)} | {_spread(ratio)} | {_two_digits(1e3 * peak / speeds[name]['median'])} |\n"
        for name, ratio in kept["ratio"].items()
        if ratio["least"] != ratio["most"]
    )
    machine = f"On one core of an {kept['machine']['processor']} ({kept['machine']['vectors']})"
    return f"{machine}, median of {kept['turns']} turns (least to most):\n\n{HEAD}{rows}\n"


def _spread(ratio):
    return f"{ratio['median']:.1f} ({ratio['least']:.1f} to {ratio['most']:.1f})"


def _two_digits(number):
    return f"{float(f'{number:.2g}'):,.0f}"


def _called(name):
    return f"`{name.partition(',')[0]}`{name[name.index(',') :]}" if name.startswith("ma2023") else name


def with_speed(text):
    """Return the text of README with that table between its marks."""
    before, _, rest = text.partition(BEGIN)
    return before + BEGIN + section() + END + rest.partition(END)[2]


if __name__ == "__main__":
    README.write_text(with_speed(README.read_text("utf-8")), "utf-8")
