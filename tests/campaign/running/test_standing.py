"""What status says of a campaign that is held by a process."""

import pytest

from campaign.running.standing import _state
from campaign.storage.lock import DirectoryLock

START = {"ranks": 2, "at": "2026-01-01T00:00:00+00:00"}


@pytest.mark.parametrize(
    ("end", "words"),
    [(None, "running on 2 ranks since 2026-01-01T00:00:00+00:00"), ({"verdict": "sampling converged"}, "starting")],
)
def test_a_start_that_is_over_is_not_told_as_running(tmp_path, monkeypatch, end, words):
    monkeypatch.setattr(DirectoryLock, "is_held", lambda lock: True)
    assert _state(tmp_path, {"starts": [START], "end": end}) == words
