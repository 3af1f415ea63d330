"""Where a result comes from, as the appendix and the remarks of the page say it."""

from pathlib import Path

from campaign.errors import RefusalError
from campaign.results.results import Results
from campaign.storage import manifest
from campaign.storage.layout import MANIFEST

TOLD_ELSEWHERE = {"title", "verdict", "scene", "scene_overrides", "Conventions"}


def provenance(results: Results) -> dict[str, str]:
    """Return the dataset's attributes about its making, by what a reader would call them."""
    attributes = {name: value for name, value in results.data.attrs.items() if name not in TOLD_ELSEWHERE}
    return {str(name).replace("_", " "): str(value) for name, value in attributes.items() if str(value)}


def doubts_about(directory: Path, results: Results) -> list[str]:
    """Return what is wrong with the manifest beside the results; nothing if it is sound, or if there is none."""
    if not (directory / MANIFEST).exists():
        return []
    try:
        kept = manifest.read(directory)
    except RefusalError as refusal:
        return [f"{refusal} This report is made of results.nc alone."]
    if kept["digest"] != results.data.attrs["scene_sha256"]:
        return [f"{directory / MANIFEST} is of another scene than results.nc, from which this report is made."]
    return []
