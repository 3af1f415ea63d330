"""What the terminal is told: whole lines, and lengths of time as a person would write them."""

import os
import sys
from collections.abc import Sequence
from contextlib import suppress
from datetime import timedelta
from io import TextIOWrapper
from math import ceil, floor, log10
from shutil import get_terminal_size
from textwrap import fill

CLEAR = "\x1b[H\x1b[J"  # cursor home, and nothing after it (ECMA-48)


WIDEST = 100
"""Characters of a line of text, at most."""


def width() -> int:
    """Return how many characters of text a line has: those of the terminal, up to `WIDEST`."""
    return min(WIDEST, get_terminal_size((WIDEST, 24)).columns)


def paragraph(heading: str, text: str, margin: int) -> str:
    """Return a text behind its heading, in lines that begin at a margin."""
    return fill(text, width(), initial_indent=f"  {heading}".ljust(margin), subsequent_indent=" " * margin)


def aligned(rows: Sequence[Sequence[str]]) -> list[str]:
    """Return the lines of a table: a name to the left, numbers to the right, and a remark as long as it is."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return [
        "  ".join([name.ljust(widths[0]), *map(str.rjust, numbers, widths[1:]), remark]).rstrip()
        for name, *numbers, remark in rows
    ]


def duration(seconds: float) -> str:
    """Return a length of time rounded to its size, "45 s", "12 min", "3.5 h"."""
    if seconds < 100:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"


def data_size(n_bytes: float) -> str:
    """Return an amount of data rounded to its size, "12 MB", "3.5 GB"."""
    units = ["kB", "MB", "GB", "TB"]
    size, unit = n_bytes / 1e3, units.pop(0)
    while size >= 999.5 and units:
        size, unit = size / 1e3, units.pop(0)
    return f"{size:.2g} {unit}" if size < 99.5 else f"{size:,.0f} {unit}" if size < 1e6 else f"{size:.2g} {unit}"


def rounded_up(number: float) -> str:
    """Write a number with two digits, not below it."""
    unit = 10.0 ** (floor(log10(number)) - 1)
    return f"{ceil(number / unit - 1e-9) * unit:g}"


def rounded_down(number: float) -> str:
    """Write a number with two digits, not above it."""
    unit = 10.0 ** (floor(log10(number)) - 1)
    return f"{floor(number / unit + 1e-9) * unit:.6g}"


def clock(seconds: float) -> str:
    """Return a length of time as hours, minutes and seconds, "0:02:05"."""
    return str(timedelta(seconds=int(seconds)))


def counted(number: int, noun: str) -> str:
    """Return a number with its noun, "1 rank", "2 ranks"."""
    return f"{number:,} {noun}{'' if number == 1 else 's'}"


def listing(names: list[str]) -> str:
    """Return names with an "and"."""
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def as_sentence(clause: str) -> str:
    """Return a clause with a capital and a full stop."""
    return f"{clause[0].upper()}{clause[1:]}."


def refresh(text: str) -> None:
    """Print text as the one thing on the screen; below the last one where the output is not a terminal.

    Raises
    ------
    OSError
        When nobody reads it, so that it need not be refreshed any more.
    """
    print(f"{CLEAR if sys.stdout.isatty() else ''}{printable(text)}\n", end="", flush=True)


def say(text: object) -> None:
    """Print a whole line at once, since ranks share the output; nobody needs to hear it.

    Where the output is a closed pipe or a full disk this and all that follows is lost, and no work with it.
    """
    try:
        print(f"{printable(str(text))}\n", end="", flush=True)
    except OSError:
        _hush()


def let_go() -> None:
    """Write what is left of the output, at the end of the program, whether or not somebody still reads it."""
    try:
        sys.stdout.flush()
    except OSError:
        _hush()


def _hush() -> None:
    """Send the output to nowhere from now on, what has not been written of it included."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def complain(text: object) -> None:
    """Print a whole line to where errors go."""
    with suppress(OSError):
        print(f"{printable(str(text))}\n", end="", flush=True, file=sys.stderr)


def printable(text: str) -> str:
    """Return text without what a terminal takes for a command, as titles and names of files may hold; lines stay."""
    return "".join(each if each.isprintable() or each in "\n\t" else "?" for each in text)


def show_all() -> None:
    """Let the output show "?" for what its encoding lacks: that it cannot show something ends nothing."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="replace")
