"""Compiled code is read from a directory that nobody else can write to."""

import os
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path

import numba
import pytest

import solver.step  # noqa: F401  -- whatever it sets must not stay
from solver import compile_cache as module
from solver.compile_cache import JOBS, compile_cache, directory, is_ours_alone, telling_of_compilation


@pytest.fixture
def home(tmp_path, monkeypatch):
    """A user's cache directory and a node's temporary one, outside of jobs."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "home"))
    (tmp_path / "node").mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "node"))
    for name in ("NUMBA_CACHE_DIR", *JOBS):
        monkeypatch.delenv(name, raising=False)
    return tmp_path


def chosen():
    return directory.__wrapped__().parent


def test_code_is_kept_where_the_user_keeps_such_and_nobody_else_looks(home):
    assert chosen() == home / "home" / "runout-solver"
    assert chosen().stat().st_mode & 0o777 == 0o700


@pytest.mark.parametrize("job", JOBS)
def test_a_job_keeps_code_on_its_node(home, monkeypatch, job):
    monkeypatch.setenv(job, "7")
    assert chosen() == home / "node" / f"runout-solver-{os.getuid()}"


def test_numbas_own_directory_goes_first(home, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(home / "given"))
    assert chosen() == home / "given" / f"runout-solver-{os.getuid()}"


@pytest.mark.parametrize("name", ["NUMBA_CACHE_DIR", "XDG_CACHE_HOME"])
@pytest.mark.parametrize(
    "within",
    [
        module.HOME,
        module.HOME / "laws",
        sysconfig.get_path("purelib"),
        "venv/lib/python3/site-packages",
        "dist-packages",
    ],
)
def test_nothing_is_written_beside_sources_nor_among_installed_packages(home, monkeypatch, name, within):
    """Whatever the environment says, by a link too; not even a directory is made there."""
    (home / "link").symlink_to(home / within)
    for place in (home / within, home / "link"):
        monkeypatch.setenv(name, str(place))
        assert chosen() in (home / "home" / "runout-solver", home / "node" / f"runout-solver-{os.getuid()}")
        assert not list(Path(place).glob("runout-solver*"))


@pytest.mark.parametrize("mode", [0o770, 0o707, 0o777])
def test_a_directory_that_others_may_write_to_is_not_used(home, mode):
    theirs = chosen()
    theirs.chmod(mode)
    assert chosen() == home / "node" / f"runout-solver-{os.getuid()}"


def test_a_link_is_not_followed(home):
    (home / "elsewhere").mkdir(mode=0o700)
    (home / "home").mkdir()
    (home / "home" / "runout-solver").symlink_to(home / "elsewhere")
    assert chosen() == home / "node" / f"runout-solver-{os.getuid()}"


def test_a_directory_of_somebody_else_is_not_used(home, monkeypatch):
    theirs = chosen()
    assert is_ours_alone(theirs)
    monkeypatch.setattr(os, "getuid", lambda: theirs.stat().st_uid + 1)
    assert not is_ours_alone(theirs)


def test_what_is_made_for_want_of_a_better_place_goes_with_its_process(home):
    for name in (home / "home", home / "node" / f"runout-solver-{os.getuid()}"):
        name.write_text("in the way")
    program = "from solver.compile_cache import directory; print(directory().parent)"
    environment = os.environ | {"TMPDIR": str(home / "node")}
    made = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=True)
    assert Path(made.stdout.strip()).parent == home / "node"
    assert not Path(made.stdout.strip()).exists()


def test_a_cache_directory_that_is_none_is_not_made_where_we_happen_to_be(home, monkeypatch):
    """A container may have no home directory for "~" to be."""
    monkeypatch.setenv("XDG_CACHE_HOME", "~/.cache")
    monkeypatch.chdir(home)
    assert chosen() == home / "node" / f"runout-solver-{os.getuid()}"
    assert not (home / "~").exists()


def test_numbas_own_setting_stays():
    before = numba.config.CACHE_DIR
    with compile_cache():
        assert Path(numba.config.CACHE_DIR).is_absolute()
    assert numba.config.CACHE_DIR == before == os.environ.get("NUMBA_CACHE_DIR", "")


def test_compilation_is_told_once_and_only_where_there_is_some():
    """Two functions are compiled, one of them with two types; what is compiled already is silent."""
    told = []
    one, other = numba.njit(lambda x: x + 1), numba.njit(lambda x: x * 2)
    with telling_of_compilation(lambda: told.append("compiling")):
        assert (one(1), one(0.5), other(2)) == (2, 1.5, 4)
    assert told == ["compiling"]
    with telling_of_compilation(lambda: told.append("again")):
        assert one(1) == 2
    assert told == ["compiling"]
