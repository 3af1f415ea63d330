"""Elastic constants of isotropic ground."""


def bulk_modulus(young_modulus: float, poisson_ratio: float) -> float:
    """Return ``K = E / (3 (1 - 2 nu))`` in Pa."""
    return young_modulus / (3.0 * (1.0 - 2.0 * poisson_ratio))


def shear_modulus(young_modulus: float, poisson_ratio: float) -> float:
    """Return ``G = E / (2 (1 + nu))`` in Pa."""
    return young_modulus / (2.0 * (1.0 + poisson_ratio))


def p_wave_speed(bulk: float, shear: float, density: float) -> float:
    """Return ``c_p = sqrt((K + 4 G / 3) / rho)`` in m/s."""
    return float(((bulk + 4.0 * shear / 3.0) / density) ** 0.5)
