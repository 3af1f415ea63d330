"""The verification ladder leaves no phenomenon out."""

from ladder import LADDER, VERIFICATION


def test_the_ladder_has_every_phenomenon_with_rows_once():
    with_rows = [path.stem for path in VERIFICATION.glob("test_*.py") if "\ndef rows():" in path.read_text("utf-8")]
    assert sorted(f"test_{name}" for group in LADDER.values() for name in group) == sorted(with_rows)
