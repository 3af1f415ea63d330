"""One campaign in a directory at a time, and no dead one in the way of a living."""

import errno
import itertools
import json
import os
import subprocess
import sys
import threading
import time
from contextlib import contextmanager

import pytest

from campaign.errors import RefusalError
from campaign.storage import lock as lock_module
from campaign.storage.holder import holder_of, this_process
from campaign.storage.lock import DirectoryLock


@pytest.fixture(autouse=True)
def impatience(monkeypatch):
    monkeypatch.setattr(lock_module, "PATIENCE", 0.2)
    monkeypatch.setattr(lock_module, "SILENCE", 0.6)


@pytest.fixture
def lock(tmp_path):
    """Whose heartbeat ends with the test."""
    lock = DirectoryLock(tmp_path)
    yield lock
    lock.release()


def holder(**changes):
    """Return the lock of this process, or of another one."""
    return json.dumps(this_process()._asdict() | changes)


def test_a_second_campaign_is_refused_and_told_whom_it_met(tmp_path, lock):
    first = DirectoryLock(tmp_path)
    assert first.acquire() == ""
    with pytest.raises(RefusalError, match=f"process {os.getpid()} on"):
        DirectoryLock(tmp_path).acquire()
    first.release()
    assert lock.acquire() == ""


def test_a_killed_holder_on_this_host_is_no_obstacle(tmp_path, lock):
    code = "import os; from pathlib import Path; from campaign.storage.lock import DirectoryLock as D; "
    code += f"D(Path({str(tmp_path)!r})).acquire(); os.kill(os.getpid(), 9)"
    subprocess.run([sys.executable, "-c", code], check=False)
    assert "takes over" in lock.acquire()


def test_a_zombie_is_dead(tmp_path, lock):
    code = (
        "from pathlib import Path; from campaign.storage.lock import DirectoryLock as Lock; "
        f"Lock(Path({str(tmp_path)!r})).acquire()"
    )
    process = subprocess.Popen([sys.executable, "-c", code])
    os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)
    assert not lock.is_held()
    assert "takes over" in lock.acquire()
    process.wait()


def test_a_later_process_with_the_same_number_is_another(tmp_path, lock):
    (tmp_path / "lock").write_text(holder(born="1"))
    assert "takes over" in lock.acquire()


ELSEWHERE = {"host": "elsewhere", "kernel": "another boot pid:[1]"}


def test_a_silent_holder_on_another_host_is_dead(tmp_path, lock):
    (tmp_path / "lock").write_text(holder(**ELSEWHERE))
    assert lock.is_held()
    os.utime(tmp_path / "lock", (0, 0))
    assert not lock.is_held()
    assert "takes over" in lock.acquire()


@contextmanager
def beating(path, begin):
    """Beat once in a while, on a clock of its own."""
    over = threading.Event()

    def beat():
        for count in itertools.count():
            os.utime(path, (begin + 0.2 * count, begin + 0.2 * count))
            if over.wait(0.2):
                return

    heart = threading.Thread(target=beat)
    heart.start()
    try:
        yield
    finally:
        over.set()
        heart.join()


@pytest.mark.parametrize("ahead", [-180, 0, 180, 1e6])
def test_clocks_that_differ_take_no_lock_from_a_living_holder(tmp_path, ahead):
    (tmp_path / "lock").write_text(holder(**ELSEWHERE))
    with (
        beating(tmp_path / "lock", time.time() - ahead),
        pytest.raises(RefusalError, match="on elsewhere"),
    ):
        DirectoryLock(tmp_path).acquire()


def test_a_holder_in_another_container_of_this_host_is_not_dead_for_want_of_its_number_here(tmp_path):
    (tmp_path / "lock").write_text(holder(kernel="this boot pid:[1]", pid=2**22 - 1))
    with beating(tmp_path / "lock", time.time()), pytest.raises(RefusalError, match="Another campaign"):
        DirectoryLock(tmp_path).acquire()


def test_who_has_found_a_holder_dead_removes_no_lock_made_since(tmp_path, lock):
    """The late one has looked, and is held up until another has taken over."""
    (tmp_path / "lock").write_text(holder(born="1"))
    late, dead = DirectoryLock(tmp_path), holder_of(tmp_path / "lock")
    assert "takes over" in lock.acquire()
    assert not late._remove(dead, 1e6)
    assert lock.is_ours()


def test_of_many_who_find_a_holder_dead_one_takes_over(tmp_path):
    (tmp_path / "lock").write_text(holder(born="1"))
    locks, won, refused = [DirectoryLock(tmp_path) for _ in range(16)], [], []

    def attempt(lock):
        try:
            won.append((lock, lock.acquire()))
        except RefusalError:
            refused.append(lock)

    threads = [threading.Thread(target=attempt, args=[lock]) for lock in locks]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert (len(won), len(refused)) == (1, 15)
    assert won[0][0].is_ours()
    for lock in locks:
        lock.release()
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("who", [{"born": "1"}, ELSEWHERE])
def test_a_kill_in_the_middle_of_a_removal_is_no_obstacle(tmp_path, lock, who):
    for name in ("lock", ".lock.removal"):
        (tmp_path / name).write_text(holder(**who))
    assert "takes over" in lock.acquire()


@pytest.mark.parametrize("content", ["{}", "[]", "3", '{"host": 1}', "\0", "{" * 100_000])
def test_a_lock_that_names_nobody_is_no_obstacle(tmp_path, lock, content):
    (tmp_path / "lock").write_text(content)
    assert not lock.is_held()
    assert "takes over" in lock.acquire()


def test_a_lock_of_an_older_version_is_understood(tmp_path, lock):
    older = {name: value for name, value in this_process()._asdict().items() if name not in ("kernel", "token")}
    (tmp_path / "lock").write_text(json.dumps(older))
    with pytest.raises(RefusalError, match=f"process {os.getpid()} on"):
        DirectoryLock(tmp_path).acquire()
    (tmp_path / "lock").write_text(json.dumps(older | {"born": "1"}))
    assert "takes over" in lock.acquire()


def test_a_file_system_without_hard_links_will_do(tmp_path, lock, monkeypatch):
    def no_links(*_paths):
        raise PermissionError(errno.EPERM, "Operation not permitted")

    monkeypatch.setattr(os, "link", no_links)
    assert lock.acquire() == ""
    with pytest.raises(RefusalError):
        DirectoryLock(tmp_path).acquire()


def test_a_lock_that_was_lost_is_noticed_and_let_be(tmp_path):
    lock = DirectoryLock(tmp_path)
    lock.acquire()
    assert lock.is_ours()
    (tmp_path / "lock").write_text(holder())
    assert not lock.is_ours()
    lock.release()
    assert (tmp_path / "lock").exists()


def test_a_lock_whose_writer_died_before_signing_is_no_obstacle(tmp_path, lock):
    (tmp_path / "lock").touch()
    assert "takes over" in lock.acquire()


def test_a_heart_stops_beating_when_its_lock_is_released(lock):
    others = set(threading.enumerate())
    lock.acquire()
    (heart,) = set(threading.enumerate()) - others
    lock.release()
    heart.join(timeout=10)
    assert not heart.is_alive()
