"""Rules that tie several keys of a scene together: a module for each section in which they are reported."""

from campaign.scene_file.rules.numerics import LARGEST_COURANT

__all__ = ["LARGEST_COURANT"]
