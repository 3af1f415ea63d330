"""Where compiled kernels are kept: a private directory of this user, for exactly this source of `solver`.

Numba unpickles what it finds in its cache, so a directory that somebody else owns, or may write to, is never used. It
does not notice an edit in a callee of another file, so the directory is named after all sources.
"""

import atexit
import hashlib
import os
import shutil
import stat
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path

import numba
from numba.core import event

HOME = Path(__file__).parent

NAME = "runout-solver"

INSTALLED = {"site-packages", "dist-packages"}
"""Names of directories that belong to installers: what is written there outlives the package."""

JOBS = ("SLURM_JOB_ID", "PBS_JOBID", "LSB_JOBID")
"""What batch systems set in their jobs."""


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
    """Return the directory, below the first of `places` that is ours alone and not among sources."""
    return next(place for place in places() if not is_among_sources(place) and is_ours_alone(place)) / source_digest()


def places() -> Iterator[Path]:
    """Yield where code may be kept, the best place first and at last a new one, which goes with this process.

    The user's own cache directory lasts longest. A batch job keeps its code on the node: on a cluster that directory
    is on a network file system, where a node sees late what another one writes.
    """
    ours = f"{NAME}-{os.getuid()}"
    if given := os.environ.get("NUMBA_CACHE_DIR"):
        yield Path(given) / ours
    lasting = Path(os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")) / NAME
    is_job = any(name in os.environ for name in JOBS)
    if not is_job:
        yield lasting
    yield Path(tempfile.gettempdir()) / ours
    if is_job:
        yield lasting
    new = tempfile.mkdtemp(prefix=f"{NAME}-")
    atexit.register(shutil.rmtree, new, ignore_errors=True)
    yield Path(new)


def source_digest() -> str:
    """Return what names this source of `solver`: the start of the SHA-256 of its files."""
    digest = hashlib.sha256()
    for source in sorted(HOME.rglob("*.py")):
        digest.update(f"{source.relative_to(HOME)}\n".encode() + source.read_bytes())
    return digest.hexdigest()[:16]


def is_among_sources(path: Path) -> bool:
    """Whether `path` lies within this package or among installed ones, where no code is kept whoever asks for it."""
    real = path.resolve()
    return real.is_relative_to(HOME.resolve()) or not INSTALLED.isdisjoint(real.parts)


def is_ours_alone(path: Path) -> bool:
    """Whether `path` is, or can be made, a directory of this user in which nobody else can write."""
    if not path.is_absolute():
        return False
    try:
        path.mkdir(mode=0o700, parents=True, exist_ok=True)
        found = path.lstat()  # of the path itself: a link may lead to anywhere
    except OSError:
        return False
    is_private = stat.S_ISDIR(found.st_mode) and found.st_uid == os.getuid() and not found.st_mode & 0o022
    return is_private and os.access(path, os.W_OK)
