"""What rules of several sections measure and write alike."""

from math import pi

Points = list[list[float]]


def degrees(angle: float) -> str:
    """Write an angle in rad as degrees."""
    return f"{angle * 180.0 / pi:g} deg"
