"""Hooke's law in rate form."""

from solver._jit import inlined


@inlined
def elastic_increment(strain_xx, strain_yy, strain_xy, bulk, shear):
    """Return the plane strain stress increment ``(xx, yy, zz, xy)`` in Pa of a strain increment (tensor shear)."""
    lame = bulk - 2.0 * shear / 3.0
    zz = lame * (strain_xx + strain_yy)
    return zz + 2.0 * shear * strain_xx, zz + 2.0 * shear * strain_yy, zz, 2.0 * shear * strain_xy


@inlined
def elastic_trial(stress, strain, bulk, shear):
    """Return the stress ``(xx, yy, zz, xy)`` in Pa after an elastic strain increment ``(xx, yy, xy)``."""
    xx, yy, zz, xy = stress
    strain_xx, strain_yy, strain_xy = strain
    d_xx, d_yy, d_zz, d_xy = elastic_increment(strain_xx, strain_yy, strain_xy, bulk, shear)
    return xx + d_xx, yy + d_yy, zz + d_zz, xy + d_xy
