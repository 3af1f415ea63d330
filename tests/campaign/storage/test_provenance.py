"""A results directory knows the scene and the sources it belongs to."""

import ast
import json
import shutil

import pytest

from campaign.errors import RefusalError
from campaign.scene import load_scene
from campaign.storage import manifest, provenance
from campaign.storage.source_hash import HOME, deciding_modules, program_hash, realization_hash


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
    monkeypatch.setattr(provenance, "realization_hash", lambda: "f" * 64)
    scene = load_scene("ma2023")
    with pytest.raises(RefusalError, match="--allow-drift"):
        manifest.begin(begun, scene, 2, allow_drift=False)
    (note,) = manifest.begin(begun, scene, 2, allow_drift=True)
    assert "mixes" in note
    about = provenance.attributes(scene, manifest.read(begun), "a verdict")
    assert about["solver_drift"] == "true"


def test_a_changed_library_is_mentioned(begun):
    path = begun / "manifest.json"
    kept = json.loads(path.read_text())
    kept["starts"][-1]["versions"]["numpy"] = "1.0"
    path.write_text(json.dumps(kept))
    (note,) = manifest.begin(begun, load_scene("ma2023"), 2, allow_drift=False)
    assert note.startswith("numpy was 1.0")


@pytest.mark.parametrize("before", [None, "tip"])
def test_statistics_of_another_front_than_before_are_told(begun, before):
    """The first versions knew only the front-most particle, and did not say so."""
    kept = manifest.read(begun)
    kept.pop("front")
    (begun / "manifest.json").write_text(json.dumps(kept | ({"front": before} if before else {})))
    assert manifest.begin(begun, load_scene("ma2023", ["slide.front=tip"]), ranks=1, allow_drift=False) == []
    (note,) = manifest.begin(begun, load_scene("ma2023"), ranks=1, allow_drift=False)
    assert 'of slide.front = "mass", for all realizations; they were of "tip". --set slide.front=tip keeps that' in note


def test_a_directory_full_of_other_things_is_refused(tmp_path):
    (tmp_path / "thesis.tex").touch()
    with pytest.raises(RefusalError, match=r"thesis\.tex"):
        manifest.begin(tmp_path, load_scene("ma2023"), 1, allow_drift=False)


def test_a_damaged_manifest_is_refused(begun):
    (begun / "manifest.json").write_text("{")
    with pytest.raises(RefusalError, match="damaged"):
        manifest.begin(begun, load_scene("ma2023"), 1, allow_drift=False)


@pytest.fixture(scope="module")
def program(tmp_path_factory):
    """A copy of the program, in which a test may change a line."""
    copy = tmp_path_factory.mktemp("program")
    for package in ("campaign", "solver"):
        shutil.copytree(HOME / package, copy / package, ignore=shutil.ignore_patterns("__pycache__"))
    return copy


def test_the_program_that_decides_a_realization_begins_with_its_fields_and_ends_with_its_record():
    modules = deciding_modules()
    assert {
        "campaign.scene.sections",
        "campaign.fields.correlation",
        "campaign.simulation.detachment",
        "campaign.seeds",
        "solver.step",
        "solver.surface",
    } <= modules.keys()
    bystanders = ("campaign.cli", "campaign.report", "campaign.running", "campaign.results", "campaign.statistics")
    assert not [name for name in modules if name.startswith(bystanders)]


def first_number(path):
    """Return the first number in the code of a file, or None."""
    numbers = (
        node
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.Constant) and type(node.value) in (int, float)
    )
    return next(numbers, None)


@pytest.mark.parametrize("module", [name for name, path in deciding_modules().items() if first_number(path)])
def test_a_changed_number_is_a_new_program(module, program):
    path = deciding_modules(program)[module]
    text, number = path.read_text(), first_number(path)
    lines = text.split("\n")
    line, begin, end = number.lineno - 1, number.col_offset, number.end_col_offset
    lines[line] = f"{lines[line][:begin]}({lines[line][begin:end]} + 1){lines[line][end:]}"
    before = program_hash({module: path})
    path.write_text("\n".join(lines))
    changed = program_hash({module: path})
    path.write_text(text)
    assert changed != before == program_hash({module: path})


def test_a_changed_sentence_is_no_new_program(program):
    before = realization_hash(program)
    for path in deciding_modules(program).values():
        first, _, rest = path.read_text().partition("\n")
        path.write_text(f"{first}\n{rest}\n# as before\n")
        if first.endswith('"""'):
            path.write_text(path.read_text().replace(first, f"{first[:-3]} Or so.{first[-3:]}", 1))
    assert realization_hash(program) == before


def test_the_dataset_tells_the_program_of_every_start(begun):
    path = begun / "manifest.json"
    kept = json.loads(path.read_text())
    other = {"versions": kept["starts"][0]["versions"] | {"numpy": "1.0"}, "cpu": "abacus"}
    path.write_text(json.dumps(kept | {"starts": [kept["starts"][0] | other, kept["starts"][0]]}))
    manifest.begin(begun, load_scene("ma2023"), 2, allow_drift=False)
    about = provenance.attributes(load_scene("ma2023"), manifest.read(begun), "a verdict")
    now = provenance.library_versions()
    assert about["numpy_version"] == f"1.0; {now['numpy']}"
    assert about["numba_version"] == now["numba"]
    assert about["cpu"] == f"abacus; {provenance.machine()['cpu']}"
    assert about["library_drift"] == "numpy"
    assert about["solver_drift"] == "false"
