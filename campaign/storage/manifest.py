"""`manifest.json`: to which scene a results directory belongs, and who has worked in it."""

import json
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from campaign.errors import RefusalError
from campaign.scene import Scene, differences
from campaign.storage.files import write_atomically
from campaign.storage.layout import ATTEMPTS, HALF_CELL, LOCK, MANIFEST, PACKS, RECORDS
from campaign.storage.provenance import git_describe, library_versions, machine, source_hashes

OWN = {LOCK, RECORDS, PACKS, ATTEMPTS, HALF_CELL}
"""What a campaign that was killed before its manifest was written may leave."""

Manifest = dict[str, Any]


def read(directory: Path) -> Manifest:
    """Return the manifest of a results directory.

    Raises
    ------
    RefusalError
        When the directory holds no campaign.
    """
    try:
        manifest: Manifest = json.loads((directory / MANIFEST).read_text())
    except (FileNotFoundError, NotADirectoryError):
        raise RefusalError(f"{directory} holds no campaign: there is no {MANIFEST} in it.") from None
    except ValueError as error:
        raise RefusalError(f"{directory / MANIFEST} is damaged ({error}); restore it, or give another --out.") from None
    return manifest


def begin(directory: Path, scene: Scene, ranks: int, allow_drift: bool) -> list[str]:
    """Write down that a campaign of `scene` starts or goes on in `directory`; returns sentences worth a look.

    Raises
    ------
    RefusalError
        When the directory belongs to another scene, was begun with another solver, or is not a campaign's.
    """
    earlier = read(directory) if (directory / MANIFEST).exists() else None
    start = _start(ranks)
    notes = _check(directory, earlier, scene, start, allow_drift) if earlier else _check_empty(directory)
    starts = [*(earlier["starts"] if earlier else ()), start]
    _write(directory, _about(scene) | {"starts": starts, "end": None})
    return notes


def end(directory: Path, exit_code: int, verdict: str) -> None:
    """Write down how the campaign ended; without this it was killed."""
    ended = {"at": _now(), "exit_code": exit_code, "verdict": verdict}
    _write(directory, read(directory) | {"end": ended})


def _check(directory: Path, earlier: Manifest, scene: Scene, start: Mapping[str, Any], allow_drift: bool) -> list[str]:
    identity = json.loads(json.dumps(scene.identity()))
    if different := differences(identity, earlier["identity"]):
        raise RefusalError(
            f"{directory} belongs to another scene: {'; '.join(different)}. "
            "Give another --out for this scene, or make the scene that of the directory."
        )
    last = earlier["starts"][-1]
    if last["realization_sha256"] == start["realization_sha256"]:
        return _changed_versions(last, start)
    if not allow_drift:
        raise RefusalError(
            f"The realizations in {directory} were computed by another version of the solver (sources "
            f"{last['realization_sha256'][:12]}, now {start['realization_sha256'][:12]}). Give another --out, or "
            "accept the mixture with --allow-drift, which is written into the results."
        )
    return [f"The solver has changed since {last['at']}; --allow-drift mixes older and newer realizations."]


def _check_empty(directory: Path) -> list[str]:
    strange = sorted(p.name for p in directory.iterdir() if p.name not in OWN and not p.name.startswith("."))
    if strange:
        raise RefusalError(
            f"{directory} is not empty ({strange[0]} is in it) and holds no campaign; give another --out."
        )
    return []


def _changed_versions(last: Mapping[str, Any], start: Mapping[str, Any]) -> list[str]:
    return [
        f"{name} was {last['versions'].get(name)} and is {now} now; the last digits of results may differ."
        for name, now in start["versions"].items()
        if last["versions"].get(name) != now
    ]


def _about(scene: Scene) -> Manifest:
    return {
        "name": scene.name,
        "title": scene.title,
        "scene": scene.text,
        "overrides": list(scene.overrides),
        "identity": scene.identity(),
        "digest": scene.digest(),
        "campaign": scene.campaign.model_dump(mode="json"),
    }


def _start(ranks: int) -> Manifest:
    sources = source_hashes() | {"git": git_describe()}
    return {"at": _now(), "ranks": ranks, "versions": library_versions()} | machine() | sources


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")


def _write(directory: Path, manifest: Manifest) -> None:
    write_atomically(directory / MANIFEST, json.dumps(manifest, indent=1).encode())
