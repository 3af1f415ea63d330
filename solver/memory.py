"""Arrays as kernels like them."""

import numpy as np

_LINE = 64  # bytes, of the cache


def aligned_zeros(shape: tuple[int, ...]) -> np.ndarray:
    """Return zeros that begin with a line of the cache, which a vector of eight then fills."""
    size = int(np.prod(shape))
    room = np.zeros(size + _LINE // 8)
    start = -(room.ctypes.data // 8) % (_LINE // 8)
    return room[start : start + size].reshape(shape)
