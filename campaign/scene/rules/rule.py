"""What a rule is, and how a section lists its own."""

from collections.abc import Callable, Iterator, Mapping
from typing import Any, NamedTuple

Check = Callable[..., str | None]

ABSENT = object()

SOIL = "soil"
"""The section whose rules hold for the soil of each layer, too."""


class Rule(NamedTuple):
    """A check on the values of some keys; a complaint is reported at the key `place`.

    A first key with a star, as "receptor.*.x", is checked for each table of the array, and is the place; a star in the
    others is the same table. A rule of the soil holds for the soil of each layer if it is `in_layers`.
    """

    keys: tuple[str, ...]
    check: Check
    place: str
    in_layers: bool = True


class Rules(list[Rule]):
    """The rules of one section, in the order of their complaints."""

    def on(self, *keys: str, place: str = "", in_layers: bool = True) -> Callable[[Check], Check]:
        """Add a check that takes the values of `keys` and returns a complaint, worded to follow "..., but".

        The complaint is about the first of the keys, or about the key or section `place`.
        """

        def add(check: Check) -> Check:
            self.append(Rule(keys, check, place or keys[0], in_layers))
            return check

        return add

    def broken(self, values: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
        """Yield place and complaint of every broken rule whose keys all have a value.

        Parameters
        ----------
        values
            SI values by dotted key; keys that are absent or wrong by themselves are left out.
        """
        for rule in self:
            for keys, place in _places(rule, values):
                if all(key in values for key in keys) and (complaint := rule.check(*(values[key] for key in keys))):
                    yield place, complaint
            for keys, number in _in_layers(rule, values) if rule.in_layers else ():
                if complaint := rule.check(*(values[key] for key in keys)):
                    place, told = _in_layer(rule.place, number), complaint.replace(f"{SOIL}.", "layer.")
                    yield place, told if place != rule.place else f"{told} (in layer {number + 1})"


def _in_layer(key: str, number: int) -> str:
    """Return the key of a layer, from 0, for one of the soil; any other as it is."""
    section, _, name = key.partition(".")
    return f"layer.{number}.{name}" if section == SOIL else key


def _in_layers(rule: Rule, values: Mapping[str, Any]) -> Iterator[tuple[tuple[str, ...], int]]:
    """Yield the keys of a rule of the soil, and the number, for each layer that has other values there."""
    number = 0
    while any(f"layer.{number}.{key}" in values for key in ("name", "law")):
        keys = tuple(_in_layer(key, number) for key in rule.keys)
        has_all = all(key in values for key in keys)
        if has_all and any(
            values[key] != values.get(of_soil, ABSENT) for key, of_soil in zip(keys, rule.keys, strict=True)
        ):
            yield keys, number
        number += 1


def _places(rule: Rule, values: Mapping[str, Any]) -> Iterator[tuple[tuple[str, ...], str]]:
    """Yield the keys and the place of a rule, for each table where the first key has a star."""
    first, *others = rule.keys
    before, star, after = first.partition("*")
    if not star:
        yield rule.keys, rule.place
        return
    for name in values:
        if name.startswith(before) and name.endswith(after):
            number = name[len(before) : -len(after)]
            yield (name, *(key.replace("*", number) for key in others)), name
