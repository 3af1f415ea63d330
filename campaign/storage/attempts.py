"""Realizations that take the process down with them.

Before it simulates, a rank writes the realization's id into a file of its own, into which `faulthandler` adds a
traceback should the process die of a fault. The next start finds it there. A kill from outside leaves no traceback and
is never held against the realization: the dataset must not depend on when a campaign was killed.
"""

import faulthandler
import re
from collections import Counter
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TextIO

from campaign.files import file_names, write_atomically
from campaign.storage.layout import ATTEMPTS, CRASHES, attempt_file, is_attempt

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
    def of(self, rank: int, realization: int) -> Iterator[TextIO]:
        """Leave a trace should the process die in the context, which is given the file where it goes."""
        with (self.directory / attempt_file(rank)).open("w") as file:
            file.write(f"{realization}\n")
            file.flush()
            faulthandler.enable(file)
            try:
                yield file
            finally:
                faulthandler.disable()
                file.truncate(0)

    def given_up(self) -> dict[int, str]:
        """Take account of the crashes since the last start; returns the reason for each id that had too many."""
        traces = self._collect()
        counts = Counter(realization for realization, _ in traces)
        return {
            realization: f"took the process down {counts[realization]} times: {trace}"
            for realization, trace in traces
            if counts[realization] >= PATIENCE
        }

    def note(self, rank: int, realization: int, trace: str) -> None:
        """Hold something against the realization that a rank has begun, as a crash would be."""
        (self.directory / attempt_file(rank)).write_text(f"{realization}\n{trace}\n")

    def fresh(self) -> list[int]:
        """Return the realizations that took a rank down in the last start."""
        return [realization for realization, _ in self._fresh(self._files())]

    def _collect(self) -> list[tuple[int, str]]:
        """Return id and trace of each crash, old and new."""
        files = self._files()
        fresh = self._fresh(files)
        if fresh:
            self._keep([*self._noted(), *fresh])
        for file in files:
            file.unlink()
        return self._noted()

    def _files(self) -> list[Path]:
        return [self.directory / name for name in file_names(self.directory) if is_attempt(name)]

    def _fresh(self, files: Iterable[Path]) -> list[tuple[int, str]]:
        return [crash for file in files for crash in _crashes(r"(-?\d{1,9})\n(.+)", file)]

    def _noted(self) -> list[tuple[int, str]]:
        return _crashes(r"(-?\d{1,9}) (.+)", self._crashes) if self._crashes.is_file() else []

    def _keep(self, crashes: list[tuple[int, str]]) -> None:
        lines = (f"{realization} {trace}\n" for realization, trace in crashes)
        write_atomically(self._crashes, "".join(lines).encode())


def _crashes(pattern: str, file: Path) -> list[tuple[int, str]]:
    """Return id and trace of what a file says in these words; anything else in it is no matter."""
    text = file.read_text(errors="replace")
    return [(int(found[1]), found[2]) for found in re.finditer(f"^{pattern}$", text, re.MULTILINE | re.ASCII)]
