"""Keys of a scene of which one says in other terms what the other does: an override of one replaces the other."""

RATE, SLIP = ("soil", "softening", "rate"), ("soil", "softening", "slip_to_residual")

TOP, DEPTH = ("layer", "top"), ("layer", "depth")

ALTERNATIVES = {RATE: SLIP, SLIP: RATE, TOP: DEPTH, DEPTH: TOP}


def replaced_by(path: tuple[str, ...]) -> str:
    """Return the name, in the same section, of the key that an override of `path` replaces; "" if none."""
    # A layer, path[1] is its number, has the keys of the soil and some of its own.
    keys = [(section, *path[2:]) for section in ("layer", "soil")] if path[0] == "layer" else [path]
    return next((ALTERNATIVES[key][-1] for key in keys if key in ALTERNATIVES), "")
