"""Principal stresses of plane strain: ``zz`` is one of them, whatever its rank, and the other two lie in the plane."""

import math

from solver._jit import inlined
from solver.lanes import where

SMALLEST_RADIUS = 1e-30  # Pa, so that a point without shear can be divided by it


@inlined
def in_plane(stress):
    """Return mean, half difference of the normal stresses, and radius of Mohr's circle in the plane (Pa)."""
    xx, yy, _, xy = stress
    half_difference = 0.5 * (xx - yy)
    return 0.5 * (xx + yy), half_difference, math.sqrt(half_difference * half_difference + xy * xy)


@inlined
def principal_stresses(stress):
    """Return ``s1 >= s2 >= s3`` of a stress ``(xx, yy, zz, xy)`` (Pa)."""
    mean, _, radius = in_plane(stress)
    zz = stress[2]
    high, low = mean + radius, mean - radius
    s1 = max(zz, high)  # a NaN in zz stays
    s3 = min(zz, low)
    return s1, high + low + zz - s1 - s3, s3


@inlined
def relaxed(stress, drop_1, drop_2, drop_3, inverse_radius):
    """Return the stress ``(xx, yy, zz, xy)`` in Pa after its principal values, largest first, have dropped by so much.

    The principal axes stay. Where nothing drops the stress is what it was, bit for bit. ``inverse_radius`` (1/Pa) is
    that of Mohr's circle in the plane.
    """
    xx, yy, zz, xy = stress
    mean, half_difference, radius = in_plane(stress)
    high, low = mean + radius, mean - radius
    drop_high = where(zz > high, drop_2, drop_1)
    drop_low = where(zz < low, drop_2, drop_3)
    drop_zz = where(zz > high, drop_1, where(zz < low, drop_3, drop_2))
    drop_mean = 0.5 * (drop_high + drop_low)
    shrink = 0.5 * (drop_high - drop_low) * inverse_radius
    return (
        xx - drop_mean - half_difference * shrink,
        yy - drop_mean + half_difference * shrink,
        zz - drop_zz,
        xy - xy * shrink,
    )


@inlined
def equivalent_plastic_strain(drop_1, drop_2, drop_3, shear):
    """Return ``sqrt(2/3 e:e)`` of the plastic strain that relaxed the principal stresses by ``drop`` (Pa)."""
    mean = (drop_1 + drop_2 + drop_3) / 3.0
    off_1, off_2, off_3 = drop_1 - mean, drop_2 - mean, drop_3 - mean
    squares = off_1 * off_1 + off_2 * off_2 + off_3 * off_3
    return math.sqrt(squares * (2.0 / 3.0)) / (2.0 * shear)
