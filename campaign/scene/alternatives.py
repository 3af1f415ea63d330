"""Keys of a scene that say in other terms what others do: an override of one replaces the others."""

RATE, SLIP = ("soil", "softening", "rate"), ("soil", "softening", "slip_to_residual")

TOP, DEPTH = ("layer", "top"), ("layer", "depth")

ALTERNATIVES: dict[tuple[str, ...], tuple[tuple[str, ...], ...]] = {
    RATE: (SLIP,),
    SLIP: (RATE,),
    TOP: (DEPTH,),
    DEPTH: (TOP,),
}
for _strength in ("cohesion", "friction_angle"):
    _share, *_values = (("soil", _strength, f"residual{each}") for each in ("_share", "", "_cov", "_gradient"))
    ALTERNATIVES |= {_share: tuple(_values), _values[0]: (_share,)}


def replaced_by(path: tuple[str, ...]) -> tuple[str, ...]:
    """Return the names, in the same section, of the keys that an override of `path` replaces."""
    # A layer, path[1] is its number, has the keys of the soil and some of its own.
    keys = [(section, *path[2:]) for section in ("layer", "soil")] if path[0] == "layer" else [path]
    return tuple(replaced[-1] for key in keys for replaced in ALTERNATIVES.get(key, ()))
