"""Realizations that take the process down with them.

Before it simulates, a rank writes the realization's id into a file of its own, into which `faulthandler` adds a
traceback should the process die of a fault. The next start finds it there. A kill from outside leaves no traceback and
is never held against the realization: the dataset must not depend on when a campaign was killed.
"""

import faulthandler
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from campaign.files import write_atomically
from campaign.storage.layout import ATTEMPTS, CRASHES, EVERY_ATTEMPT, attempt_file

PATIENCE = 2
"""Crashes after which a realization is given up."""


class Attempts:
    """The realizations that ranks have begun in `directory`."""

    def __init__(self, directory: Path) -> None:
        self.directory = directory / ATTEMPTS
        self._crashes = self.directory / CRASHES

    def create(self) -> None:
        """Make the directory."""
        self.directory.mkdir(parents=True, exist_ok=True)

    @contextmanager
    def of(self, rank: int, realization: int) -> Iterator[None]:
        """Leave a trace should the process die in the context."""
        with (self.directory / attempt_file(rank)).open("w") as file:
            file.write(f"{realization}\n")
            file.flush()
            faulthandler.enable(file)
            try:
                yield
            finally:
                faulthandler.disable()
                file.truncate(0)

    def given_up(self) -> dict[int, str]:
        """Take account of the crashes since the last start; returns the reason for each id that had too many."""
        traces = [line.split(" ", 1) for line in self._collect()]
        counts = Counter(int(realization) for realization, _ in traces)
        return {
            int(realization): f"took the process down {counts[int(realization)]} times: {trace}"
            for realization, trace in traces
            if counts[int(realization)] >= PATIENCE
        }

    def _collect(self) -> list[str]:
        """Return a line "id trace" for each crash, old and new."""
        lines = self._crashes.read_text().splitlines() if self._crashes.exists() else []
        files = sorted(self.directory.glob(EVERY_ATTEMPT))
        fresh = [line for file in files if (line := _crash(file.read_text()))]
        if fresh:
            write_atomically(self._crashes, "".join(f"{line}\n" for line in (*lines, *fresh)).encode())
        for file in files:
            file.unlink()
        return lines + fresh


def _crash(text: str) -> str:
    realization, *trace = text.splitlines() or [""]
    return f"{realization} {trace[0]}" if trace else ""
