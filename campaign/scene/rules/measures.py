"""What rules of several sections measure and write alike."""

from math import pi

Points = list[list[float]]


def relief(surface: Points) -> float:
    """Return the difference in m between the highest and the lowest elevation of a surface."""
    elevations = [elevation for _, elevation in surface]
    return max(elevations) - min(elevations)


def degrees(angle: float) -> str:
    """Write an angle in rad as degrees."""
    return f"{angle * 180.0 / pi:g} deg"
