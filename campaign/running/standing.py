"""How a campaign stands, from its directory alone, while it runs or after."""

import time
from pathlib import Path
from typing import Any

from campaign.exit_codes import ExitCode
from campaign.running.progress import state_line
from campaign.scene.sections import Campaign, Slide
from campaign.seeds import BASELINE
from campaign.statistics.tally import Tally, tally_for
from campaign.storage import manifest
from campaign.storage.attempts import Attempts
from campaign.storage.layout import ATTEMPTS, CHANGED_INPUTS, HALF_CELL, MODELS, RESULTS
from campaign.storage.lock import DirectoryLock
from campaign.storage.record_store import RecordStore
from campaign.terminal import counted, listing, refresh

REFRESH = 5.0
"""Seconds between two looks of `--watch`."""


def status(directory: Path) -> str:
    """Return the state of the campaign in `directory` as text.

    Raises
    ------
    RefusalError
        When there is no campaign.
    """
    about = manifest.read(directory)
    tally, damaged = _tally(directory, about)
    lines = [f"{about['title']}: {_state(directory, about)}", f"  {state_line(tally)}"]
    lines += [f"  {sentence}" for sentence in damaged]
    if repeated := len(RecordStore(directory / HALF_CELL).finished() - {BASELINE}):
        lines.append(f"  {repeated} repeated with half the cell, for the discretisation error")
    others = {MODELS: "repeated as other models of the scene", CHANGED_INPUTS: "repeated with more of one input"}
    for room, meaning in others.items():
        if count := sum(len(RecordStore(each).finished()) for each in (directory / room).glob("*")):
            lines.append(f"  {count} {meaning}")
    results = directory / RESULTS
    return "\n".join([*lines, f"  {results}" if results.exists() else "  no results.nc yet"])


def conclusion(directory: Path) -> ExitCode:
    """Return the exit code that rank 0 wrote down last, `RESUMABLE` when its latest start has not come to an end.

    Launchers do not always tell it: MPICH's gives 0 when a rank vanishes.

    Raises
    ------
    RefusalError
        When there is no campaign.
    """
    end = manifest.read(directory)["end"]
    return ExitCode.RESUMABLE if end is None else ExitCode(end["exit_code"])


def watch(directory: Path) -> None:
    """Show the state, again and again, until the campaign is at rest."""
    refresh(status(directory))
    while DirectoryLock(directory).is_held():
        time.sleep(REFRESH)
        refresh(status(directory))


def _state(directory: Path, about: dict[str, Any]) -> str:
    if DirectoryLock(directory).is_held():
        if about["end"] is not None:  # of the start before, which is over
            return "starting"
        start = about["starts"][-1]
        return f"running on {counted(start['ranks'], 'rank')} since {start['at']}"
    if about["end"] is None:
        return f"{_end_without_a_word(directory)}; give the same command again to continue"
    return str(about["end"]["verdict"])


def _end_without_a_word(directory: Path) -> str:
    """Say why the latest start did not come to its end, also among realizations that are repeated."""
    taken = {realization for each in directory.rglob(ATTEMPTS) for realization in Attempts(each.parent).fresh()}
    if not taken:
        return "killed"
    names = ["the baseline" if realization == BASELINE else f"realization {realization}" for realization in taken]
    return f"ended when {listing(sorted(names))} took down a rank"


def _tally(directory: Path, about: dict[str, Any]) -> tuple[Tally, list[str]]:
    """Return the account of the records on disk, and a sentence for each file that cannot be read."""
    tally = tally_for(Campaign.model_construct(**about["campaign"]), about.get("front", Slide().front))
    summaries, damaged = RecordStore(directory, about["digest"]).summaries()
    for summary in summaries.values():
        tally.add(summary)
    return tally, damaged
