"""Compiled code is read from a directory that nobody else can write to."""

import os
import tempfile
from pathlib import Path

import numba
import pytest

import solver.step  # noqa: F401  -- whatever it sets must not stay
from solver.compile_cache import compile_cache, private_directory, telling_of_compilation


@pytest.fixture(autouse=True)
def elsewhere(tmp_path, monkeypatch):
    """Fresh directories are made where the test leaves nothing behind."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))


def test_a_new_directory_is_private(tmp_path):
    made = private_directory(tmp_path / "cache")
    assert made == tmp_path / "cache"
    assert made.stat().st_mode & 0o777 == 0o700


@pytest.mark.parametrize("mode", [0o770, 0o707, 0o777])
def test_a_directory_that_others_may_write_to_is_not_used(tmp_path, mode):
    open_to_others = tmp_path / "cache"
    open_to_others.mkdir()
    open_to_others.chmod(mode)
    assert private_directory(open_to_others) != open_to_others


def test_a_link_is_not_followed(tmp_path):
    (tmp_path / "elsewhere").mkdir(mode=0o700)
    (tmp_path / "cache").symlink_to(tmp_path / "elsewhere")
    assert private_directory(tmp_path / "cache") != tmp_path / "cache"


def test_a_directory_of_somebody_else_is_not_used(tmp_path, monkeypatch):
    theirs = tmp_path / "cache"
    theirs.mkdir(mode=0o700)
    monkeypatch.setattr(os, "getuid", lambda: theirs.stat().st_uid + 1)
    assert private_directory(theirs) != theirs


def test_a_place_that_cannot_be_written_gives_a_fresh_directory(tmp_path):
    (tmp_path / "file").write_text("")
    assert private_directory(tmp_path / "file" / "cache").is_dir()


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
