"""From the velocity gradient to strain, rotation and volume."""

from solver._jit import inlined


@inlined
def rotate_stress(xx, yy, xy, rotation):
    """Return the in-plane stress ``(xx, yy, xy)`` in Pa, turned by the rotation increment ``W_xy dt``.

    The rotation is Cayley's exact one. The half-angle tangent is ``rotation / 2``, so the invariants are kept to round-
    off for any increment; the first-order update ``sigma + dt (W sigma - sigma W)`` would make the deviator grow with
    every turn.
    """
    half = 0.5 * rotation
    scale = 1.0 / (1.0 + half * half)
    cos = (1.0 - half * half) * scale
    sin = 2.0 * half * scale
    cos_2 = cos * cos - sin * sin
    sin_2 = 2.0 * sin * cos
    mean = 0.5 * (xx + yy)
    difference = 0.5 * (xx - yy)
    turned = difference * cos_2 + xy * sin_2
    return mean + turned, mean - turned, xy * cos_2 - difference * sin_2


@inlined
def volume_ratio(l_xx, l_xy, l_yx, l_yy):
    """Return ``det(1 + L dt)``, new volume over old, of the increment ``L dt`` of the displacement gradient."""
    return (1.0 + l_xx) * (1.0 + l_yy) - l_xy * l_yx
