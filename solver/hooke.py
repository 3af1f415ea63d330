"""Hooke's law in rate form."""

from solver._jit import law


@law
def elastic_increment(strain_xx, strain_yy, strain_xy, bulk, shear):
    """Return the plane strain stress increment ``(xx, yy, zz, xy)`` in Pa of a strain increment (tensor shear)."""
    lame = bulk - 2.0 * shear / 3.0
    zz = lame * (strain_xx + strain_yy)
    return zz + 2.0 * shear * strain_xx, zz + 2.0 * shear * strain_yy, zz, 2.0 * shear * strain_xy
