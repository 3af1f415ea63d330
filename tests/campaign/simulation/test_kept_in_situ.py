"""The in-situ state is computed once a campaign, and never taken from a file that is not whole and its own."""

import numpy as np
import pytest
from small_campaign import small_scene

from campaign.simulation import ground, kept_in_situ
from campaign.simulation.ground import prepare
from campaign.simulation.kept_in_situ import IN_SITU, kept_in_situ_state
from campaign.simulation.solver_model import model_of

MODEL = model_of(small_scene())


def asked(directory, monkeypatch, model=MODEL, from_nothing=False):
    """Return the state, and whether it was computed for that."""
    computed = []

    def compute(*arguments):
        computed.append(arguments)
        return compute_as_before(*arguments)

    compute_as_before = kept_in_situ.in_situ_state
    with monkeypatch.context() as patch:
        patch.setattr(kept_in_situ, "in_situ_state", compute)
        return kept_in_situ_state(model, from_nothing, directory), bool(computed)


def assert_same_bits(one, other):
    assert all(a.dtype == b.dtype and a.tobytes() == b.tobytes() for a, b in zip(one, other, strict=True))


def only_file(directory):
    (path,) = (directory / IN_SITU).iterdir()
    return path


def test_it_is_computed_once_and_read_bit_for_bit(tmp_path, monkeypatch):
    first, was_computed = asked(tmp_path, monkeypatch)
    again, is_computed_again = asked(tmp_path, monkeypatch)
    assert was_computed
    assert not is_computed_again
    assert_same_bits(first, again)
    assert_same_bits(first, kept_in_situ_state(MODEL, False, None))
    assert np.ptp(again.stress_yy) > 0.0


def flipped(content):
    middle = len(content) // 2
    return content[:middle] + bytes([content[middle] ^ 1]) + content[middle + 1 :]


DAMAGES = {"a flipped bit": flipped, "cut short": lambda content: content[:-1], "emptied": lambda content: b""}


@pytest.mark.parametrize("damage", DAMAGES.values(), ids=DAMAGES)
def test_a_damaged_file_is_never_trusted(tmp_path, monkeypatch, damage):
    first, _ = asked(tmp_path, monkeypatch)
    path = only_file(tmp_path)
    whole = path.read_bytes()
    path.write_bytes(damage(whole))
    again, is_computed_again = asked(tmp_path, monkeypatch)
    assert is_computed_again
    assert_same_bits(first, again)
    assert path.read_bytes() == whole


def test_what_a_killed_write_left_is_cleared(tmp_path, monkeypatch):
    left = tmp_path / IN_SITU / ".state.arrays.another-host.1"
    left.parent.mkdir()
    left.touch()
    _, was_computed = asked(tmp_path, monkeypatch)
    assert was_computed
    assert only_file(tmp_path) != left


def test_a_whole_file_of_another_ground_is_not_taken(tmp_path, monkeypatch):
    other = model_of(small_scene("soil.unit_weight=18 kN/m^3"))
    for name, model in (("ours", MODEL), ("theirs", other)):
        (tmp_path / name).mkdir()
        asked(tmp_path / name, monkeypatch, model)
    only_file(tmp_path / "ours").write_bytes(only_file(tmp_path / "theirs").read_bytes())
    assert asked(tmp_path / "ours", monkeypatch)[1]


DECISIVE = ["numerics.cell=1 m", "soil.unit_weight=18 kN/m^3", "soil.poisson_ratio=0.3", "numerics.locking=none"]
LATER = ["soil.softening.rate=0.3", "soil.cohesion.mean=30 kPa", "slide.failed=2 m", "numerics.flip=0.98"]


@pytest.mark.parametrize("override", DECISIVE)
def test_what_decides_it_gives_another_one(tmp_path, monkeypatch, override):
    asked(tmp_path, monkeypatch)
    assert asked(tmp_path, monkeypatch, model_of(small_scene(override)))[1]


@pytest.mark.parametrize("override", LATER)
def test_what_matters_after_release_shares_it(tmp_path, monkeypatch, override):
    """The oracle is the state computed for the other scene itself."""
    other = model_of(small_scene(override))
    asked(tmp_path, monkeypatch)
    shared, is_computed = asked(tmp_path, monkeypatch, other)
    assert not is_computed
    assert_same_bits(shared, kept_in_situ_state(other, False, None))


@pytest.mark.parametrize("start", ["first", "second"])
def test_the_solver_is_compiled_before_ranks_ask_for_it_whether_or_not_the_state_is_kept(tmp_path, monkeypatch, start):
    """A march compiles all kernels that a realization needs, before its first step."""
    if start == "second":
        prepare(small_scene(), tmp_path)
    marches = []
    monkeypatch.setattr(ground, "March", lambda *arguments: marches.append(arguments))
    ground.prepare_to_run(small_scene(), tmp_path)
    assert len(marches) == 1


def test_settling_from_nothing_is_another_state(tmp_path, monkeypatch):
    asked(tmp_path, monkeypatch)
    assert asked(tmp_path, monkeypatch, from_nothing=True)[1]


def test_another_solver_does_not_take_it(tmp_path, monkeypatch):
    asked(tmp_path, monkeypatch)
    monkeypatch.setattr(kept_in_situ, "source_digest", lambda: "another")
    assert asked(tmp_path, monkeypatch)[1]


def test_where_nothing_can_be_written_it_is_computed_all_the_same(tmp_path, monkeypatch):
    for _ in range(2):
        assert asked(tmp_path / "is" / "not there", monkeypatch)[1]
