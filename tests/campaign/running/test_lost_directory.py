"""A results directory may be moved away at any moment, also while the results are written."""

import pytest
from stand_in import StandIn

from campaign.exit_codes import ExitCode
from campaign.running.campaign_directory import opened
from campaign.running.crew import Alone
from campaign.running.runner import conduct
from campaign.running.stop_request import StopRequest
from campaign.scene import load_scene
from campaign.storage.record_store import RecordStore

WANTED = ["realizations=3", "discretisation_pairs=0", "sensitivity_pairs=0"]
SCENE = load_scene("ma2023", [f"campaign.{each}" for each in WANTED])


def computed(directory):
    stop = StopRequest()
    with opened(SCENE, directory, 1) as begun:
        return conduct(begun, lambda scene, _home: StandIn(scene), Alone(stop), stop, None)


@pytest.mark.parametrize("name", ["columns", "pack"])
def test_it_can_go_on_where_it_is(tmp_path, monkeypatch, capsys, name):
    home, usual = tmp_path / "home", getattr(RecordStore, name)

    def moving(*arguments):
        if home.exists():
            home.rename(tmp_path / "moved")
        return usual(*arguments)

    with monkeypatch.context() as patch:
        patch.setattr(RecordStore, name, moving)
        assert computed(home) is ExitCode.RESUMABLE
    assert "was moved away" in capsys.readouterr().out
    (tmp_path / "moved" / "lock").unlink()  # this process lives on
    assert computed(tmp_path / "moved") is ExitCode.DONE
