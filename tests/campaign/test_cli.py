"""The command line: what it understands, what it answers, and its exit codes."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import xarray as xr

from campaign import cli
from campaign.commands import run
from campaign.commands.scene_options import overrides

PROGRAM = "import sys; from campaign.cli import main; sys.exit(main())"

STAND_IN = f"""
import sys
sys.path.append({str(Path(__file__).parents[1] / "helpers")!r})
from campaign.cli import main
from campaign.commands import run
from stand_in import prepare
run.prepare = prepare
run._write_report = lambda directory, simulate: directory / "report.html"
sys.exit(main())
"""
"""The whole command, but for the solver and the figures."""


@pytest.fixture(autouse=True)
def keep_threads(monkeypatch):
    monkeypatch.setattr(cli, "_pin_threads", lambda: None)


def test_the_estimate_is_near_the_papers_number_of_particles():
    """10,090 particles (paper, section 3)."""
    from campaign.scene import load_scene
    from campaign.scene.cost import particle_count

    assert particle_count(load_scene("ma2023-printed")) == pytest.approx(10_090, rel=0.01)


@pytest.mark.parametrize("command", ["validate", "run"])
def test_an_unknown_key_is_a_sentence_and_not_a_traceback(command, tmp_path):
    arguments = [command, "ma2023", "--set", 'soil.cohesionn.mean="20 kPa"']
    arguments += ["--out", str(tmp_path / "x")] if command == "run" else []
    result = subprocess.run([sys.executable, "-c", PROGRAM, *arguments], capture_output=True, text=True, check=False)
    assert result.returncode == 2
    assert "cohesionn" in result.stderr
    assert "Traceback" not in result.stderr
    assert not (tmp_path / "x").exists()


def test_a_rank_loads_neither_solver_nor_figures_before_the_scene_is_read():
    """A mistake in it is then told within a second, and a rank that draws nothing keeps its memory."""
    heavy = ("numba", "pandas", "xarray", "matplotlib", "jinja2", "scipy.stats")
    program = (
        f"import sys, campaign.running.mpi, campaign.commands.run; print([m for m in {heavy} if m in sys.modules])"
    )
    result = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert result.stdout.strip() == "[]"


def test_results_are_told_in_words_without_the_compiler():
    """Which takes half a second to load."""
    program = "import sys, campaign.report.summary; print('numba' in sys.modules)"
    result = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert result.stdout.strip() == "False"


def test_later_options_win_over_set():
    options = cli.parser().parse_args(["run", "s", "--seed", "7", "--realizations", "4", "--set", "campaign.seed=1"])
    assert overrides(options) == ["campaign.seed=1", "campaign.realizations=4", "campaign.seed=7"]


def test_without_arguments_the_papers_scene_is_run(monkeypatch):
    seen = []
    monkeypatch.setattr(run, "carry_out", lambda options: seen.append(options.scene) or 0)
    assert cli.main([]) == 0
    assert seen == ["ma2023"]


def test_the_help_says_that_no_command_at_all_computes_for_minutes(capsys):
    with pytest.raises(SystemExit):
        cli.main(["--help"])
    assert '"campaign run ma2023"), which takes minutes' in " ".join(capsys.readouterr().out.split())


@pytest.mark.parametrize("shell", ["bash", "zsh"])
def test_the_completion_of_a_shell_knows_commands_and_options(shell, capsys):
    with pytest.raises(SystemExit) as ended:
        cli.main(["--print-completion", shell])
    assert ended.value.code == 0
    script = capsys.readouterr().out
    assert all(word in script for word in (*cli.COMMANDS, "--allow-drift", "--realization"))
    if shutil.which(shell):
        assert subprocess.run([shell, "-n"], input=script, text=True, check=False).returncode == 0


@pytest.mark.parametrize("command", cli.COMMANDS)
def test_every_command_says_what_it_is_for(command, capsys):
    with pytest.raises(SystemExit) as ended:
        cli.main([command, "--help"])
    assert ended.value.code == 0
    assert capsys.readouterr().out.startswith(f"usage: campaign {command}")


@pytest.mark.parametrize("arguments", [["nonsense"], ["run"], ["replay", "dir", "first"]])
def test_a_command_that_cannot_be_read_is_a_usage_error(arguments):
    with pytest.raises(SystemExit) as error:
        cli.main(arguments)
    assert error.value.code == 2


def test_scenes_lists_the_built_in_scenes(capsys):
    assert cli.main(["scenes"]) == 0
    assert "ma2023-printed" in capsys.readouterr().out


@pytest.mark.parametrize("command", [["status"], ["replay"]])
def test_a_directory_without_a_campaign_is_refused(command, tmp_path, capsys):
    code = cli.main([*command, str(tmp_path), *(["3"] if command == ["replay"] else [])])
    assert code == 2
    assert "holds no campaign" in capsys.readouterr().err


def test_neither_mpi_nor_numpy_is_needed_to_read_the_command_line():
    slow = {"mpi4py", "numpy", "pydantic", "matplotlib", "shtab"}
    program = f"import sys, campaign.cli as cli; cli.parser(); sys.exit(bool({slow} & set(sys.modules)))"
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0


def without_reader(program, *arguments):
    """Run a Python program whose output nobody reads; return its exit code and what it says of errors."""
    reader, writer = os.pipe()
    os.close(reader)
    command = [sys.executable, "-c", program, *arguments]
    result = subprocess.run(command, stdout=writer, stderr=subprocess.PIPE, text=True, check=False)
    os.close(writer)
    return result.returncode, result.stderr


@pytest.mark.parametrize("arguments", [["scenes"], ["--help"], ["validate", "ma2023", "--quick"]])
def test_a_reader_who_has_seen_enough_ends_a_command_quietly(arguments):
    assert without_reader(PROGRAM, *arguments) == (0, "")


def test_without_a_reader_a_campaign_goes_on_to_its_own_end():
    work = (
        "from campaign.terminal import say, let_go; [say('a line') for _ in range(9)]; let_go(); raise SystemExit(75)"
    )
    assert without_reader(work) == (75, "")


def on_a_terminal_of_ascii(program, *arguments):
    """Do the same where the output is read but has no more than 128 characters."""
    command = [sys.executable, "-c", program, *arguments]
    environment = os.environ | {"PYTHONIOENCODING": "ascii"}
    result = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert "Slope ? valley" in result.stdout
    return result.returncode, result.stderr


@pytest.mark.parametrize("carried_out", [on_a_terminal_of_ascii, without_reader])
def test_whoever_reads_the_output_a_campaign_writes_its_results(carried_out, tmp_path):
    """The summary holds "±", and the title an arrow."""
    wanted = ["realizations=12", "minimum=10", "discretisation_pairs=0", "sensitivity_pairs=0"]
    settings = ['title="Slope → valley"', *(f"campaign.{each}" for each in wanted)]
    overrides = [part for setting in settings for part in ("--set", setting)]
    assert carried_out(STAND_IN, "run", "ma2023", "--out", str(tmp_path), *overrides) == (0, "")
    with xr.open_dataset(tmp_path / "results.nc") as data:
        assert data.sizes["realization"] == 12
        assert data.attrs["title"] == "Slope → valley"


@pytest.mark.parametrize("moment", ["parser", "_carry_out"])
def test_an_interrupt_before_anything_is_begun_is_a_word(moment, monkeypatch, capsys):
    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(cli, moment, interrupted)
    assert cli.main(["scenes"]) == 130
    assert capsys.readouterr().err == "Interrupted.\n"
