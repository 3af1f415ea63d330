"""What a rule is, and how a section lists its own."""

from collections.abc import Callable, Iterator, Mapping
from typing import Any, NamedTuple

Check = Callable[..., str | None]


class Rule(NamedTuple):
    """A check on the values of some keys; a complaint is reported at the key `place`.

    A first key with a star, as "receptor.*.x", is checked for each table of the array, and is the place.
    """

    keys: tuple[str, ...]
    check: Check
    place: str


class Rules(list[Rule]):
    """The rules of one section, in the order of their complaints."""

    def on(self, *keys: str, place: str = "") -> Callable[[Check], Check]:
        """Add a check that takes the values of `keys` and returns a complaint, worded to follow "..., but".

        The complaint is about the first of the keys, or about the key or section `place`.
        """

        def add(check: Check) -> Check:
            self.append(Rule(keys, check, place or keys[0]))
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


def _places(rule: Rule, values: Mapping[str, Any]) -> Iterator[tuple[tuple[str, ...], str]]:
    """Yield the keys and the place of a rule, for each table where the first key has a star."""
    first, *others = rule.keys
    before, star, after = first.partition("*")
    if not star:
        yield rule.keys, rule.place
        return
    for name in values:
        if name.startswith(before) and name.endswith(after):
            yield (name, *others), name
