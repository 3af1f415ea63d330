"""The Courant limit."""

import math


def stable_step(courant: float, cell_size: float, wave_speed: float, fastest: float) -> float:
    """Return ``dt = C h / (c_p + max |v|)`` in s."""
    return courant * cell_size / (wave_speed + fastest)


def even_steps(duration: float, largest_step: float) -> int:
    """Return into how many equal steps of at most ``largest_step`` a ``duration`` (s) is cut."""
    return max(1, math.ceil(duration / largest_step - 1e-9))
