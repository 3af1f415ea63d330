"""A results directory knows the scene and the sources it belongs to."""

import ast
import json

import pytest

from campaign import manifest, provenance
from campaign.exit_codes import RefusalError
from campaign.scene import load_scene

SHARED = ("exit_codes", "files", "record", "scene", "scene_file")
"""Imported on the way to a realization, but what they decide is in the scene's identity or in the record itself."""


def source(module):
    return provenance.PACKAGE.joinpath(*module.split(".")).with_suffix(".py")


def imported(module):
    """Return the modules of `campaign` that a module imports, without the package's name."""
    tree = ast.parse(source(module).read_text())
    names = [node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.module]
    return {name.partition(".")[2] for name in names if name.startswith("campaign.")}


def test_every_module_that_decides_a_realization_is_hashed():
    found, waiting = set(), {"realization"}
    while waiting:
        module = waiting.pop()
        found.add(module)
        waiting |= {name for name in imported(module) if name.partition(".")[0] not in SHARED} - found
    hashed = {path for name in provenance.REALIZATION_SOURCES for path in provenance.PACKAGE.glob(f"{name}.py")}
    assert {source(module) for module in found} == {path for path in hashed if path.name != "__init__.py"}


@pytest.fixture
def begun(tmp_path):
    assert manifest.begin(tmp_path, load_scene("ma2023"), 2, allow_drift=False) == []
    return tmp_path


def test_the_same_scene_goes_on_with_another_stopping_rule(begun):
    scene = load_scene("ma2023", ["campaign.realizations=50", "campaign.mean_tolerance=0.1"])
    assert manifest.begin(begun, scene, 3, allow_drift=False) == []
    assert [start["ranks"] for start in manifest.read(begun)["starts"]] == [2, 3]


def test_another_scene_is_refused_with_the_keys_that_differ(begun):
    with pytest.raises(RefusalError, match=r"soil\.cohesion\.cov is 0\.15 here but"):
        manifest.begin(begun, load_scene("ma2023", ["soil.cohesion.cov=0.15"]), 2, allow_drift=True)


def test_another_solver_is_refused_unless_drift_is_allowed_and_then_recorded(begun, monkeypatch):
    monkeypatch.setattr(manifest, "realization_hash", lambda: "f" * 64)
    scene = load_scene("ma2023")
    with pytest.raises(RefusalError, match="--allow-drift"):
        manifest.begin(begun, scene, 2, allow_drift=False)
    (note,) = manifest.begin(begun, scene, 2, allow_drift=True)
    assert "mixes" in note
    about = provenance.attributes(scene, manifest.read(begun), "a verdict")
    assert about["solver_drift"] == "true"


def test_a_changed_library_is_mentioned(begun):
    path = begun / manifest.NAME
    kept = json.loads(path.read_text())
    kept["starts"][-1]["versions"]["numpy"] = "1.0"
    path.write_text(json.dumps(kept))
    (note,) = manifest.begin(begun, load_scene("ma2023"), 2, allow_drift=False)
    assert note.startswith("numpy was 1.0")


def test_a_directory_full_of_other_things_is_refused(tmp_path):
    (tmp_path / "thesis.tex").touch()
    with pytest.raises(RefusalError, match=r"thesis\.tex"):
        manifest.begin(tmp_path, load_scene("ma2023"), 1, allow_drift=False)


def test_a_damaged_manifest_is_refused(begun):
    (begun / manifest.NAME).write_text("{")
    with pytest.raises(RefusalError, match="damaged"):
        manifest.begin(begun, load_scene("ma2023"), 1, allow_drift=False)
