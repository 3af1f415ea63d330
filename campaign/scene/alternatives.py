"""Keys of a scene of which one says in other terms what the other does: an override of one replaces the other."""

RATE, SLIP = ("soil", "softening", "rate"), ("soil", "softening", "slip_to_residual")

ALTERNATIVES = {RATE: SLIP, SLIP: RATE}


def replaced_by(path: tuple[str, ...]) -> str:
    """Return the name, in the same section, of the key that an override of `path` replaces; "" if none."""
    return ALTERNATIVES[path][-1] if path in ALTERNATIVES else ""
