"""Where compiled kernels are kept: a private directory of this user, on this node, for exactly this source of `solver`.

Numba unpickles what it finds in its cache, so a directory that somebody else owns, or may write to, is never used. It
does not notice an edit in a callee of another file, so the directory is named after all sources.
"""

import hashlib
import os
import stat
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path

import numba
from numba.core import event

HOME = Path(__file__).parent


@contextmanager
def compile_cache() -> Iterator[None]:
    """Have the functions that are decorated inside keep their code there; Numba's own setting is as before, outside."""
    before = numba.config.CACHE_DIR  # type: ignore[attr-defined]
    numba.config.CACHE_DIR = str(directory())  # type: ignore[attr-defined]
    try:
        yield
    finally:
        numba.config.CACHE_DIR = before  # type: ignore[attr-defined]


@contextmanager
def telling_of_compilation(tell: Callable[[], None]) -> Iterator[None]:
    """Call `tell` once if something has to be compiled inside, which is then not kept yet; it takes half a minute."""
    with event.install_listener("numba:compile", _First(tell)):
        yield


class _First(event.Listener):
    """Tells of the first of many events."""

    def __init__(self, tell: Callable[[], None]) -> None:
        self._tell: Callable[[], None] | None = tell

    def on_start(self, _event: event.Event) -> None:
        """Tell, unless that has been done."""
        tell, self._tell = self._tell, None
        if tell is not None:
            tell()

    def on_end(self, _event: event.Event) -> None:
        """Do nothing."""


@cache
def directory() -> Path:
    """Return the directory: below `NUMBA_CACHE_DIR` if that is set, else below the node's temporary one."""
    given = os.environ.get("NUMBA_CACHE_DIR")
    return private_directory(Path(given or tempfile.gettempdir()) / f"runout-solver-{os.getuid()}") / source_digest()


def source_digest() -> str:
    """Return what names this source of `solver`: the start of the SHA-256 of its files."""
    digest = hashlib.sha256()
    for source in sorted(HOME.rglob("*.py")):
        digest.update(f"{source.relative_to(HOME)}\n".encode() + source.read_bytes())
    return digest.hexdigest()[:16]


def private_directory(path: Path) -> Path:
    """Return `path` if it is, or can be made, a directory that is ours alone; a fresh private one otherwise."""
    try:
        path.mkdir(mode=0o700, parents=True, exist_ok=True)
        found = path.lstat()  # of the path itself: a link may lead to anywhere
    except OSError:
        return Path(tempfile.mkdtemp(prefix="runout-solver-"))
    is_ours = stat.S_ISDIR(found.st_mode) and found.st_uid == os.getuid() and not found.st_mode & 0o022
    return path if is_ours else Path(tempfile.mkdtemp(prefix="runout-solver-"))
