"""What the terminal is told."""

import sys

import pytest

from campaign.terminal import counted, refresh, rounded_up


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
