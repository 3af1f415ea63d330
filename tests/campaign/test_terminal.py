"""What the terminal is told."""

import os
import subprocess
import sys

import pytest

from campaign.terminal import complain, counted, printable, refresh, rounded_up, say


def test_one_has_no_plural():
    assert [counted(number, "rank") for number in (0, 1, 2, 12_000)] == ["0 ranks", "1 rank", "2 ranks", "12,000 ranks"]


@pytest.mark.parametrize(("is_terminal", "beginning"), [(True, "\x1b[H\x1b[J"), (False, "")])
def test_a_terminal_is_cleared_and_a_log_goes_on(is_terminal, beginning, capsys, monkeypatch):
    monkeypatch.setattr(sys.stdout, "isatty", lambda: is_terminal)
    refresh("how it stands")
    assert capsys.readouterr().out == f"{beginning}how it stands\n"


@pytest.mark.parametrize(
    ("number", "text"), [(22.5, "23"), (9.892, "9.9"), (0.0214, "0.022"), (20.0, "20"), (1234.0, "1300")]
)
def test_a_remedy_has_two_digits_and_is_not_too_small(number, text):
    assert rounded_up(number) == text


@pytest.mark.parametrize("character", ["\x1b[2J", "\x07", "\x9b31m", "\r", "\x00", "\u202e", "\u2028"])
def test_no_text_is_a_command_to_the_terminal(character, capsys):
    say(f"a title{character}")
    complain(ValueError(f"a name{character}"))
    shown = capsys.readouterr()
    for line in (shown.out, shown.err):
        assert line == printable(line)
        assert character[0] not in line
    assert printable("run-out 10.8 ± 0.1 m →\n\tStraße") == "run-out 10.8 ± 0.1 m →\n\tStraße"


@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "cp1252"])
def test_a_terminal_that_lacks_a_character_shows_the_rest(encoding):
    result = subprocess.run(
        [sys.executable, "-m", "campaign", "validate", "ma2023", "--quick", "--set", 'title="Slope → valley"'],
        env=os.environ | {"PYTHONIOENCODING": encoding},
        capture_output=True,
        check=False,
    )
    assert result.returncode == 0, result.stderr
    assert b"Slope ? valley" in result.stdout
