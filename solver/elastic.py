"""Isotropic linear elasticity in rate form."""

from solver._jit import law


def bulk_modulus(young_modulus: float, poisson_ratio: float) -> float:
    """Return ``K = E / (3 (1 - 2 nu))`` in Pa."""
    return young_modulus / (3.0 * (1.0 - 2.0 * poisson_ratio))


def shear_modulus(young_modulus: float, poisson_ratio: float) -> float:
    """Return ``G = E / (2 (1 + nu))`` in Pa."""
    return young_modulus / (2.0 * (1.0 + poisson_ratio))


def p_wave_speed(bulk: float, shear: float, density: float) -> float:
    """Return ``c_p = sqrt((K + 4 G / 3) / rho)`` in m/s."""
    return float(((bulk + 4.0 * shear / 3.0) / density) ** 0.5)


@law
def elastic_increment(strain_xx, strain_yy, strain_xy, bulk, shear):
    """Return the plane strain stress increment ``(xx, yy, zz, xy)`` in Pa of a strain increment (tensor shear)."""
    lame = bulk - 2.0 * shear / 3.0
    zz = lame * (strain_xx + strain_yy)
    return zz + 2.0 * shear * strain_xx, zz + 2.0 * shear * strain_yy, zz, 2.0 * shear * strain_xy


@law
def elastic_energy(xx, yy, zz, xy, bulk, shear):
    """Return the stored energy density in J/m3: ``p^2 / (2 K) + s:s / (4 G)``."""
    p = (xx + yy + zz) / 3.0
    deviatoric = (xx - p) ** 2 + (yy - p) ** 2 + (zz - p) ** 2 + 2.0 * xy**2
    return p * p / (2.0 * bulk) + deviatoric / (4.0 * shear)
