"""The first realizations again with half the cell, once the campaign has enough of them."""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from campaign.errors import RefusalError
from campaign.record import USABLE
from campaign.running.campaign_directory import CampaignDirectory
from campaign.running.level import Level
from campaign.simulation.contract import Prepare, PreparedGround
from campaign.statistics import discretisation
from campaign.statistics.tally import Tally
from campaign.storage.layout import HALF_CELL
from campaign.terminal import say

HandOut = Callable[[Level, PreparedGround, Tally], str]
"""Computes what an account lacks, and says why that ended early, "" if it did not."""


class Repetition(NamedTuple):
    """The account of the repeated realizations, None where there are none, and why it is not whole ("" if it is)."""

    tally: Tally | None
    stopped: str


def repeat_with_half_cell(
    directory: CampaignDirectory, tally: Tally, prepare: Prepare, hand_out: HandOut, stopped: str
) -> Repetition:
    """Repeat the first realizations of a whole campaign with half the cell.

    Which ones depends on the result alone, neither on ranks nor on interruptions.

    Parameters
    ----------
    directory
        The campaign's.
    tally
        Its account.
    prepare
        Computes what the repeated realizations share.
    hand_out
        Has all ranks compute them.
    stopped
        Why nothing new may be begun, "" if it may.
    """
    pairs = min(directory.scene.campaign.discretisation_pairs, tally.prefix)
    if pairs == 0 or tally.too_many_failed:
        return Repetition(None, "")
    level = Level(discretisation.with_half_cell(directory.scene, pairs), directory.path / HALF_CELL)
    try:
        for note in level.open():
            say(note)
        repeated = _account(level, tally)
        if repeated.size is not None or stopped:
            return Repetition(repeated, "" if repeated.size is not None else stopped)
        return _repeat(level, directory.path, tally, prepare, hand_out)
    except RefusalError as refusal:
        say(f"The discretisation error cannot be estimated with half the cell. {refusal}")
        return Repetition(None, "")
    except OSError as error:
        return Repetition(None, f"{level.directory} cannot be written ({error})")


def _repeat(level: Level, home: Path, tally: Tally, prepare: Prepare, hand_out: HandOut) -> Repetition:
    cell, pairs = level.scene.numerics.cell, level.scene.campaign.realizations
    say(f"Discretisation error: {pairs} realizations and the deterministic run again, with cells of {cell:g} m.")
    ground = prepare(level.scene, home)
    level.give_up_crashed(ground)
    repeated = _account(level, tally)
    stopped = hand_out(level, ground, repeated)
    return Repetition(repeated, "" if repeated.size is not None else stopped)


def _account(level: Level, tally: Tally) -> Tally:
    """Return the account of the repeated; what did not count the first time needs no repetition."""
    repeated = level.tally()
    for summary in tally.summaries.values():
        if summary.status not in USABLE:
            repeated.add(summary)
    return repeated
