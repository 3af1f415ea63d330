"""What the terminal is told: whole lines, and lengths of time as a person would write them."""

from datetime import timedelta


def duration(seconds: float) -> str:
    """Return a length of time rounded to its size, "45 s", "12 min", "3.5 h"."""
    if seconds < 100:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"


def clock(seconds: float) -> str:
    """Return a length of time as hours, minutes and seconds, "0:02:05"."""
    return str(timedelta(seconds=int(seconds)))


def say(text: str) -> None:
    """Print a whole line at once, since ranks share the output."""
    print(f"{text}\n", end="", flush=True)
