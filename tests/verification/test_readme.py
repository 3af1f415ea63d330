"""README shows what the ladder says."""

from readme_orders import README, orders, with_orders


def test_the_orders_in_readme_are_those_of_the_ladder():
    text = README.read_text("utf-8")
    assert with_orders(text) == text
    assert orders().count("\n") > 10
