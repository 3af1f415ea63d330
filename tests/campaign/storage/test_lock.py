"""One campaign in a directory at a time, and no dead one in the way of a living."""

import json
import os
import socket
import subprocess
import sys
import threading

import pytest

from campaign.errors import RefusalError
from campaign.storage import lock as lock_module
from campaign.storage.lock import DirectoryLock


@pytest.fixture(autouse=True)
def impatience(monkeypatch):
    monkeypatch.setattr(lock_module, "PATIENCE", 0.2)


@pytest.fixture
def lock(tmp_path):
    """Whose heartbeat ends with the test."""
    lock = DirectoryLock(tmp_path)
    yield lock
    lock.release()


def holder(**changes):
    known = {"host": socket.gethostname(), "pid": os.getpid(), "born": "0", "job": ""}
    return json.dumps(known | changes)


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


def test_a_silent_holder_on_another_host_is_dead(tmp_path, lock):
    (tmp_path / "lock").write_text(holder(host="elsewhere"))
    assert lock.is_held()
    os.utime(tmp_path / "lock", (0, 0))
    assert not lock.is_held()
    assert "takes over" in lock.acquire()


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
