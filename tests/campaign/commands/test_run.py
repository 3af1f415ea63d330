"""`campaign run`: a scene or what a results directory knows, and a mistake answered before MPI is loaded."""

import json
import os
import subprocess
import sys

import pytest
from small_campaign import small_scene
from stand_in import StandIn

from campaign import cli
from campaign.commands import run as run_command
from campaign.commands.scene_options import read_scene, scene_directory
from campaign.errors import CampaignError, RefusalError
from campaign.exit_codes import ExitCode
from campaign.results.results import read_results
from campaign.running import launcher
from campaign.running.campaign_directory import opened
from campaign.running.crew import Alone
from campaign.running.runner import conduct
from campaign.running.standing import status
from campaign.running.stop_request import StopRequest
from campaign.scene import load_scene
from campaign.storage import manifest


def options(*arguments, command="run"):
    return cli.parser().parse_args([command, *map(str, arguments)])


@pytest.fixture
def begun(tmp_path):
    """The directory of a campaign that has begun."""
    scene = small_scene("campaign.realizations=12", "soil.cohesion.mean=21 kPa")
    manifest.begin(tmp_path, scene, 1, allow_drift=False)
    return tmp_path, scene


@pytest.mark.parametrize("command", ["run", "validate", "draw"])
def test_a_directory_stands_for_its_scene(begun, command):
    directory, scene = begun
    assert read_scene(options(directory, command=command)) == scene


def test_more_realizations_may_be_asked_of_a_directory(begun):
    directory, scene = begun
    again = read_scene(options(directory, "--realizations", 40))
    assert again.digest() == scene.digest()
    assert again.campaign.realizations == 40
    assert sum("realizations" in override for override in again.overrides) == 1


def test_another_scene_is_told_apart_in_the_units_of_people(begun):
    directory, _ = begun
    changed = read_scene(options(directory, "--set", "soil.cohesion.mean=25 kPa"))
    with pytest.raises(RefusalError, match=r"soil\.cohesion\.mean is 25 kPa here but 21 kPa in the results directory"):
        manifest.begin(directory, changed, 1, allow_drift=False)


def test_a_scene_that_the_directory_cannot_have_meant_is_a_mistake_of_the_user(begun):
    with pytest.raises(CampaignError, match=r"^--set soil.cohesion.mean is 5, but a pressure needs its unit"):
        read_scene(options(begun[0], "--set", "soil.cohesion.mean=5"))


def computed(directory, scene):
    stop = StopRequest()
    with opened(scene, directory, 1) as begun:
        return conduct(begun, lambda scene, _home: StandIn(scene), Alone(stop), stop, None)


def test_overrides_that_end_lines_are_found_again_by_whoever_reads_the_directory(tmp_path):
    """They are kept a line each: by the manifest, and in the dataset, from which the report reads the scene."""
    counts = ["campaign.realizations", "campaign.discretisation_pairs", "campaign.sensitivity_pairs"]
    values = dict.fromkeys(["field.horizontal", "field.vertical", "slide.failed"], "2 m") | dict.fromkeys(counts, "3")
    ends = ["\n", "\r\n", "\v", "\x1c", "\x85", "\u2028"]
    overrides = [f"{key}={end}{value}{end}" for (key, value), end in zip(values.items(), ends, strict=True)]
    scene = load_scene("ma2023", overrides)
    assert scene.field.horizontal == scene.slide.failed == 2.0
    assert computed(tmp_path, scene) is ExitCode.DONE
    again = read_scene(options(tmp_path))
    assert again == scene
    assert computed(tmp_path, again) is ExitCode.DONE
    assert read_results(tmp_path).scene.identity() == scene.identity()
    assert "stopped at the maximum of 3 realizations" in status(tmp_path)


def test_a_directory_is_continued_where_it_is(begun, monkeypatch):
    seen = []
    monkeypatch.setattr("campaign.running.mpi.run_on_ranks", lambda scene, out, *_: seen.append((scene(), out)) or 0)
    for name in launcher.SIZES:
        monkeypatch.delenv(name, raising=False)
    assert run_command.carry_out(options(begun[0])) == 0
    assert seen == [(begun[1], begun[0])]


def test_the_name_of_a_built_in_scene_is_that_scene_beside_a_directory_of_that_name(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "ma2023").mkdir()
    assert scene_directory(options("ma2023")) is None
    assert scene_directory(options("./ma2023")) is not None


def test_an_empty_directory_holds_no_campaign(tmp_path):
    with pytest.raises(RefusalError, match="holds no campaign"):
        read_scene(options(tmp_path))


def loaded(*arguments, **environment):
    """Run the command in a process of its own; return its exit code, its words, and the slow libraries it loaded."""
    program = (
        "import atexit, json, sys\n"
        "slow = {'mpi4py', 'numba', 'scipy.linalg', 'xarray', 'matplotlib', 'h5py'}\n"
        "atexit.register(lambda: print('LOADED', json.dumps(sorted(slow & set(sys.modules)))))\n"
        "from campaign.cli import main\nsys.exit(main())"
    )
    clean = {name: value for name, value in os.environ.items() if name not in launcher.SIZES}
    result = subprocess.run(
        [sys.executable, "-c", program, *arguments],
        capture_output=True,
        text=True,
        check=False,
        env=clean | environment,
    )
    return result.returncode, result.stderr, json.loads(result.stdout.rpartition("LOADED ")[2])


def test_a_mistake_is_answered_before_anything_slow_is_loaded():
    code, words, libraries = loaded("run", "ma2023", "--set", "numerics.cell=1")
    assert code == 2
    assert "a length needs its unit" in words
    assert libraries == []


def test_of_launched_processes_only_rank_0_reads_the_scene():
    """MPI says who that is; a mistake is found after it has been loaded, and ends all ranks."""
    code, words, libraries = loaded("run", "ma2023", "--set", "numerics.cell=1", PMI_SIZE="1")
    assert code == 2
    assert "a length needs its unit" in words
    assert "mpi4py" in libraries


def test_statuses_that_may_end_otherwise_can_be_run_again(capsys):
    assert options("ma2023", "--retry", "crashed,timeout").retry == ("crashed", "timeout")
    with pytest.raises(SystemExit):
        options("ma2023", "--retry", "slid")
    assert "'slid' is not crashed, timeout" in capsys.readouterr().err
