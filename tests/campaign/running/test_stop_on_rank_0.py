"""Rank 0 computes, and packs what all have computed; whatever it does when it is asked to stop, it stops at once."""

import signal

import pytest
from stand_in import StandIn

from campaign.exit_codes import ExitCode
from campaign.running.campaign_directory import opened
from campaign.running.crew import Alone
from campaign.running.runner import conduct
from campaign.running.standing import status
from campaign.running.stop_request import listening
from campaign.scene import load_scene
from campaign.seeds import BASELINE
from campaign.simulation.contract import Interrupted
from campaign.storage.loose_records import LooseRecords
from campaign.storage.packs import Packs
from campaign.storage.record_store import RecordStore

ALONE = ["campaign.discretisation_pairs=0", "campaign.sensitivity_pairs=0"]
SCENE = load_scene("ma2023", ["campaign.realizations=12", *ALONE])


def computed(directory, ground=StandIn):
    """Compute what a campaign lacks by one rank that listens to signals; returns its exit code."""
    with listening() as stop, opened(SCENE, directory, 1) as begun:
        return conduct(begun, lambda scene, _home: ground(scene), Alone(stop), stop, None)


def finished(directory):
    return RecordStore(directory, SCENE.digest()).finished()


@pytest.fixture
def small_packs(monkeypatch):
    monkeypatch.setattr(Packs, "SIZE", 4)


@pytest.mark.parametrize(
    ("number", "room", "name"),
    [
        (signal.SIGUSR1, LooseRecords, "read"),
        (signal.SIGTERM, Packs, "write"),
        (signal.SIGTERM, LooseRecords, "remove"),
    ],
)
def test_a_stop_while_it_packs_leaves_the_pack_and_loses_nothing(
    tmp_path, monkeypatch, small_packs, number, room, name
):
    """Four records are packed once five are finished; what is left of that is done by the next start."""
    usual = getattr(room, name)

    def interrupted(*arguments):
        if len(finished(tmp_path)) > 4:
            signal.raise_signal(number)
        return usual(*arguments)

    with monkeypatch.context() as patch:
        patch.setattr(room, name, interrupted)
        assert computed(tmp_path) is ExitCode.RESUMABLE
    assert finished(tmp_path) == {BASELINE, *range(5)}
    assert "stopped early (asked to stop)" in status(tmp_path)
    assert computed(tmp_path) is ExitCode.DONE
    assert finished(tmp_path) == {BASELINE, *range(12)}
    assert len(list(tmp_path.glob("packs/*.h5"))) == 3


@pytest.mark.parametrize(("number", "kept"), [(signal.SIGTERM, 5), (signal.SIGUSR1, 6)])
def test_a_stop_while_it_computes_is_heeded_before_it_packs(tmp_path, monkeypatch, small_packs, number, kept):
    """After TERM the realization under way is left at the next look of its time loop, else it is finished."""

    class Interruptible(StandIn):
        def simulate(self, realization, interrupt):
            if realization == 5:
                signal.raise_signal(number)
                if interrupt():
                    raise Interrupted
            return super().simulate(realization, interrupt)

    assert computed(tmp_path, Interruptible) is ExitCode.RESUMABLE
    assert finished(tmp_path) == {BASELINE, *range(kept)}
    assert computed(tmp_path) is ExitCode.DONE
    assert finished(tmp_path) == {BASELINE, *range(12)}
