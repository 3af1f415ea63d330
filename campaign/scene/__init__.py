"""A scene: from a TOML file to a frozen, validated object in SI units."""

from campaign.errors import SceneError
from campaign.scene.comparison import differences
from campaign.scene.document import builtin_scenes
from campaign.scene.loading import kept_scene, load_scene, scene_of
from campaign.scene.scene import Scene

__all__ = ["Scene", "SceneError", "builtin_scenes", "differences", "kept_scene", "load_scene", "scene_of"]
