"""What may be done with a results directory, and why no more: one function decides."""

import json
from collections.abc import Mapping
from enum import Enum
from pathlib import Path
from typing import Any, NamedTuple

from campaign.errors import RefusalError
from campaign.scene import Scene, differences
from campaign.storage.formats import check_format
from campaign.storage.layout import (
    ATTEMPTS,
    CHANGED_INPUTS,
    HALF_CELL,
    LOCK,
    MANIFEST,
    OTHER_RELEASE,
    PACKS,
    RECORDS,
    SNAPSHOTS,
)
from campaign.storage.manifest_shape import check_shape

Manifest = dict[str, Any]

OWN = {LOCK, RECORDS, PACKS, ATTEMPTS, HALF_CELL, OTHER_RELEASE, CHANGED_INPUTS, SNAPSHOTS}
"""What a campaign that was killed before its manifest was written may leave."""

FRONT_BEFORE_THERE_WAS_A_KEY = "tip"


class Access(Enum):
    """What may be done with a directory."""

    REFUSED = "nothing"
    VACANT = "a campaign may begin in it"
    READABLE = "its campaign may be read"
    CONTINUABLE = "its campaign may be read and go on"


class Judgement(NamedTuple):
    """What may be done with a directory.

    Attributes
    ----------
    access
        The most that is allowed.
    why
        The sentence that says why no more is, "" for what may go on.
    notes
        Sentences worth a look when it goes on.
    manifest
        Of its campaign; None where there is none to read.
    """

    access: Access
    why: str = ""
    notes: tuple[str, ...] = ()
    manifest: Manifest | None = None


def judge(
    directory: Path, scene: Scene | None = None, start: Mapping[str, Any] | None = None, allow_drift: bool = False
) -> Judgement:
    """Decide whether a directory can be read, can go on, or is refused.

    Parameters
    ----------
    directory
        Which may be absent.
    scene
        That would go on in it; None for somebody who only reads.
    start
        Versions and hashes of this program, as `manifest` notes them; None where they do not matter.
    allow_drift
        Whether another version of the solver may go on.
    """
    if not (directory / MANIFEST).exists():
        return _without_manifest(directory)
    try:
        kept = _kept(directory / MANIFEST)
    except RefusalError as refusal:
        return Judgement(Access.REFUSED, str(refusal))
    if scene is None:
        return Judgement(Access.READABLE, "No scene is given that could go on.", (), kept)
    if why := _another_scene(directory, scene, kept):
        return Judgement(Access.READABLE, why, (), kept)
    front = _changed_front(scene, kept)
    if start is None or start["realization_sha256"] == kept["starts"][-1]["realization_sha256"]:
        return Judgement(Access.CONTINUABLE, "", (*front, *_changed_versions(kept["starts"][-1], start or {})), kept)
    if not allow_drift:
        return Judgement(Access.READABLE, _drift(directory, kept["starts"][-1], start), (), kept)
    note = f"The solver has changed since {kept['starts'][-1]['at']}; --allow-drift mixes older and newer realizations."
    return Judgement(Access.CONTINUABLE, "", (*front, note), kept)


def check_digest(scene: Scene, digest: str) -> None:
    """Make sure that a scene read again is the one of the campaign.

    Raises
    ------
    RefusalError
        When its SHA-256 is not `digest`: its realizations would be others.
    """
    if scene.digest() != digest:
        raise RefusalError(
            f"This version reads the scene of the campaign differently (SHA-256 {scene.digest()[:12]}, {digest[:12]} "
            "was kept), so its realizations would not be the same ones; use the version that computed them."
        )


def _without_manifest(directory: Path) -> Judgement:
    inside = sorted(path.name for path in directory.iterdir()) if directory.is_dir() else []
    strange = [name for name in inside if name not in OWN and not name.startswith(".")]
    if strange:
        return Judgement(
            Access.REFUSED,
            f"{directory} is not empty ({strange[0]} is in it) and holds no campaign; give another --out.",
        )
    if any(directory.rglob("*.h5")):
        return Judgement(
            Access.REFUSED,
            f"{directory} holds records but no {MANIFEST} that says whose they are; restore it, or give another --out.",
        )
    return Judgement(Access.VACANT, f"{directory} holds no campaign: there is no {MANIFEST} in it.")


def _kept(path: Path) -> Manifest:
    """Return a manifest; raises RefusalError when it is damaged or of a newer format."""
    try:
        kept: Manifest = dict(json.loads(path.read_text()))
        check_format(int(kept.get("format", 0)), str(kept.get("reader", "")), str(path.parent))
        check_shape(kept)
    except (OSError, ValueError, TypeError, RecursionError) as error:
        raise RefusalError(f"{path} is damaged ({error}); restore it, or give another --out.") from None
    return kept


def _another_scene(directory: Path, scene: Scene, kept: Manifest) -> str:
    """Return why `scene` is not that of the directory, "" if it is."""
    identity = json.loads(json.dumps(scene.identity()))
    different = differences(identity, kept["identity"])
    if not different:
        return ""
    return (
        f"{directory} belongs to another scene: {'; '.join(different)}. "
        "Give another --out for this scene, or make the scene that of the directory."
    )


def _drift(directory: Path, last: Mapping[str, Any], start: Mapping[str, Any]) -> str:
    return (
        f"The realizations in {directory} were computed by another version of the solver (sources "
        f"{last['realization_sha256'][:12]}, now {start['realization_sha256'][:12]}). Give another --out, or "
        "accept the mixture with --allow-drift, which is written into the results."
    )


def _changed_front(scene: Scene, kept: Manifest) -> tuple[str, ...]:
    """Return what is to be said when statistics are of another front than before."""
    before, now = kept.get("front", FRONT_BEFORE_THERE_WAS_A_KEY), scene.slide.front
    if before == now:
        return ()
    return (
        f'Statistics are now of slide.front = "{now}", for all realizations; they were of "{before}". '
        f"--set slide.front={before} keeps that.",
    )


def _changed_versions(last: Mapping[str, Any], start: Mapping[str, Any]) -> tuple[str, ...]:
    return tuple(
        f"{name} was {last['versions'].get(name)} and is {now} now; the last digits of results may differ."
        for name, now in start.get("versions", {}).items()
        if last["versions"].get(name) != now
    )
