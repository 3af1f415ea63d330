"""What one core of this machine can do at most: multiply and add, and read from memory."""

import numpy as np

from solver._jit import kernel
from solver.constants import LANE_COUNT
from solver.lanes import splat, total

ACCUMULATORS = 8  # chains side by side: two units of four cycles each
MEBIBYTE = 2**20


@kernel
def chains(count):
    """Return what 8 chains of fused multiply-adds in lanes come to; `count` links each."""
    factor, addend = splat(0.999999), splat(1e-6)
    a, b, c, d = splat(1.0), splat(1.1), splat(1.2), splat(1.3)
    e, f, g, h = splat(1.4), splat(1.5), splat(1.6), splat(1.7)
    for _ in range(count):
        a, b, c, d = a * factor + addend, b * factor + addend, c * factor + addend, d * factor + addend
        e, f, g, h = e * factor + addend, f * factor + addend, g * factor + addend, h * factor + addend
    return total(a + b + c + d + e + f + g + h)


@kernel
def triad(a, b, c):
    """Set ``a = b + 3 c``."""
    for i in range(a.size):
        a[i] = b[i] + 3.0 * c[i]


def multiply_adds(count=2_000_000):
    """Return what does `count` links, and how many multiply-adds that is."""
    return lambda: chains(count), count * ACCUMULATORS * LANE_COUNT


def triad_over(mebibytes):
    """Return what goes once over three arrays of so many MiB in all, and how many bytes it moves (STREAM's count)."""
    n = mebibytes * MEBIBYTE // 24
    a, b, c = np.ones(n), np.ones(n), np.ones(n)  # zeros would not be in memory yet
    times = max(1, 96 // mebibytes)

    def go():
        for _ in range(times):
            triad(a, b, c)

    return go, 24 * n * times
