"""`manifest.json`: to which scene a results directory belongs, and who has worked in it."""

import json
from datetime import UTC, datetime
from pathlib import Path

from campaign.errors import RefusalError
from campaign.files import write_atomically
from campaign.scene import Scene
from campaign.storage.access import Access, Manifest, judge
from campaign.storage.formats import FORMAT, READER
from campaign.storage.layout import MANIFEST
from campaign.storage.provenance import git_describe, library_versions, machine, source_hashes


def read(directory: Path) -> Manifest:
    """Return the manifest of a results directory.

    Raises
    ------
    RefusalError
        When the directory holds no campaign, or one that this version cannot read.
    """
    judgement = judge(directory)
    if judgement.manifest is None:
        raise RefusalError(judgement.why)
    return judgement.manifest


def begin(directory: Path, scene: Scene, ranks: int, allow_drift: bool) -> list[str]:
    """Write down that a campaign of `scene` starts or goes on in `directory`; returns sentences worth a look.

    Raises
    ------
    RefusalError
        When the directory belongs to another scene, was begun with another solver, or is not a campaign's.
    """
    start = _start(ranks)
    judgement = judge(directory, scene, start, allow_drift)
    if judgement.access not in (Access.VACANT, Access.CONTINUABLE):
        raise RefusalError(judgement.why)
    earlier = judgement.manifest["starts"] if judgement.manifest else []
    _write(directory, _about(scene) | {"starts": [*earlier, start], "end": None})
    return list(judgement.notes)


def end(directory: Path, exit_code: int, verdict: str) -> None:
    """Write down how the campaign ended; without this it was killed."""
    ended = {"at": _now(), "exit_code": exit_code, "verdict": verdict}
    _write(directory, read(directory) | {"end": ended})


def _about(scene: Scene) -> Manifest:
    return {
        "format": FORMAT,
        "reader": READER,
        "name": scene.name,
        "title": scene.title,
        "scene": scene.text,
        "overrides": list(scene.overrides),
        "identity": scene.identity(),
        "digest": scene.digest(),
        "front": scene.slide.front,
        "campaign": scene.campaign.model_dump(mode="json"),
    }


def _start(ranks: int) -> Manifest:
    sources = source_hashes() | {"git": git_describe()}
    return {"at": _now(), "ranks": ranks, "versions": library_versions()} | machine() | sources


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")


def _write(directory: Path, manifest: Manifest) -> None:
    write_atomically(directory / MANIFEST, json.dumps(manifest, indent=1).encode())
