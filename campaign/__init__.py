"""How far will this slope run, and how sure are we? Monte-Carlo campaigns of material point landslide simulations.

    from campaign import load_scene, prepare, run, open_results

What is named here is loaded when it is first used, so that the command line answers at once.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from campaign.errors import CampaignError
    from campaign.results.results import open_results
    from campaign.running.runner import run
    from campaign.scene import Scene, load_scene
    from campaign.simulation.ground import prepare

    __version__: str

__all__ = ["CampaignError", "Scene", "__version__", "load_scene", "open_results", "prepare", "run"]

_HOMES = {
    "CampaignError": "campaign.errors",
    "Scene": "campaign.scene",
    "load_scene": "campaign.scene",
    "open_results": "campaign.results.results",
    "prepare": "campaign.simulation.ground",
    "run": "campaign.running.runner",
}


def __getattr__(name: str) -> object:
    if name == "__version__":
        from importlib.metadata import version

        return version("runout-campaign")
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
