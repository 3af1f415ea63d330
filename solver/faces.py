"""Where the slope of a surface begins and ends: its steepest face, and the faces beside it over short benches."""

import numpy as np

WIDEST_BENCH = 0.5
"""Between two faces of one slope, in heights of all of them together; on a wider one each face slides for itself."""

STEEP = 0.5
"""Drop over run of what is a face beside faces of any steepness; beside flatter ones half as steep is enough."""

LOWEST_FACE = 1.0 / 3.0
"""Beside the highest face of the slope; less is a ditch or the bank of a stream."""


def foot_of_slope(x: np.ndarray, y: np.ndarray) -> float:
    """Return the place in m where the slope of the surface through ``x, y`` (m) ends; see ``face_stack``."""
    return float(x[face_stack(x, y)[1]])


def face_stack(x: np.ndarray, y: np.ndarray) -> tuple[int, int]:
    """Return the numbers of the points between which a surface has its slope: the steepest face and its neighbours.

    A slip surface passes below benches that are short beside the slope, so that all faces they part are one slope.

    Parameters
    ----------
    x, y : ndarray (k,)
        Points of the surface in m, from left to right.

    Raises
    ------
    ValueError
        If the ground nowhere descends to the right.
    """
    head, foot = steepest_face(x, y)
    run = x[foot] - x[head]
    steepness = min(0.5 * (y[head] - y[foot]) / run, STEEP) if run > 0.0 else STEEP
    foot = _foot_of_stack(x, y, head, foot, steepness)
    # Turned by half a turn the slope still descends to the right, and its head is a foot.
    last = x.size - 1
    head = last - _foot_of_stack(-x[::-1], -y[::-1], last - foot, last - head, steepness)
    return head, foot


def _foot_of_stack(x: np.ndarray, y: np.ndarray, head: int, foot: int, steepness: float) -> int:
    """Return the number of the foot of the lowest face that short benches join to those from head to foot."""
    faces = _faces(x, y, steepness)
    joined = True
    while joined:
        highest = max(y[max(a, head)] - y[min(b, foot)] for a, b in faces if a < foot and head < b)
        below = (b for a, b in faces if a >= foot and _is_joined(x, y, (head, foot), (a, b), highest))
        joined = (lower := next(below, None)) is not None
        foot = lower if lower is not None else foot
    return foot


def _is_joined(x: np.ndarray, y: np.ndarray, slope: tuple[int, int], face: tuple[int, int], highest: float) -> bool:
    """Whether a face is near the slope above it, high beside its faces, and followed by ground that stays down."""
    (head, foot), (a, b) = slope, face
    bench = WIDEST_BENCH * max(0.0, y[head] - y[b])
    lasting = y[foot] - np.max(y[b:][x[b:] <= x[b] + bench])
    return bool(x[a] - x[foot] <= bench and lasting >= LOWEST_FACE * highest)


def _faces(x: np.ndarray, y: np.ndarray, steepness: float) -> list[tuple[int, int]]:
    """Return the first and the last point of each stretch that falls more steeply than that, from left to right."""
    steep = [is_steep(y[k] - y[k + 1], x[k + 1] - x[k], steepness) for k in range(x.size - 1)]
    bounds = np.flatnonzero(np.diff([False, *steep, False]))
    return [(int(a), int(b)) for a, b in bounds.reshape(-1, 2)]


def descent(y: np.ndarray) -> float:
    """Return the largest descent in m from a point of a surface to a later one."""
    return float(np.max(_drops(y)))


def _drops(y: np.ndarray) -> np.ndarray:
    """Return by how much each point (row) lies above each later one (column) in m; 0 for those before it."""
    return np.triu(y[:, None] - y, 1)


def is_steep(drop: float, run: float, steepness: float) -> bool:
    """Whether ground falls more steeply than that, drop over run, or like a wall."""
    return bool(drop > steepness * run if run > 0.0 else drop > 0.0)


def steepest_face(x: np.ndarray, y: np.ndarray) -> tuple[int, int]:
    """Return the numbers of the points between which a surface that descends to the right has its steepest face.

    The face is the steepest stretch between two points that makes up half of the largest descent or more, so that a
    step of the ground is none. It begins and ends where the ground beside it falls less than half as steeply.

    Parameters
    ----------
    x, y : ndarray (k,)
        Points of the surface in m, from left to right.

    Raises
    ------
    ValueError
        If the ground nowhere descends to the right.
    """
    drop, run = _drops(y), x - x[:, None]
    largest = descent(y)
    if not largest > 0.0:
        raise ValueError("The ground nowhere descends to the right, where slides go; mirror it.")
    is_face = drop >= 0.5 * largest
    steepness = np.divide(drop, run, out=np.full_like(drop, np.inf), where=run > 0.0)
    steepest = np.max(steepness[is_face])
    # Of equally steep stretches the one that falls most is the whole face.
    candidates = is_face & (steepness >= steepest * (1.0 - 1e-9) if np.isfinite(steepest) else np.isinf(steepness))
    head, foot = map(int, np.unravel_index(np.argmax(np.where(candidates, drop, -np.inf)), drop.shape))
    while head > 0 and is_steep(y[head - 1] - y[head], x[head] - x[head - 1], 0.5 * steepest):
        head -= 1
    while foot + 1 < x.size and is_steep(y[foot] - y[foot + 1], x[foot + 1] - x[foot], 0.5 * steepest):
        foot += 1
    return head, foot
