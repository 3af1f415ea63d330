"""Drucker-Prager plasticity whose cone has the strength of Mohr-Coulomb in plane strain.

With tension positive, ``p`` the mean stress and ``s`` the deviator

    f = sqrt(J2) + eta p - xi c <= 0,   g = sqrt(J2) + eta_g p

At collapse in plane strain nothing flows out of the plane, ``dg/ds_zz = s_zz / (2 sqrt(J2)) + eta_g / 3 = 0``. With
mean ``m`` and radius ``R`` of Mohr's circle in the plane, and ``k = sqrt(1 - eta_g^2 / 3)``, that gives

    p = m - eta_g sqrt(J2) / 3,   R = k sqrt(J2),   sqrt(J2) (1 - eta eta_g / 3) + eta m = xi c

which is ``R + m sin(phi) = c cos(phi)`` if, with ``1/D = k + eta_g sin(phi) / 3``,

    eta = D sin(phi),   xi = D cos(phi)

Dilation is matched as well: the plastic volume grows by ``eta_g`` while the shear of the plane grows by ``k``, so
``sin(psi) = eta_g / k``, ``eta_g = 3 sin(psi) / sqrt(9 + 3 sin(psi)^2)``. Without dilation ``eta = sin(phi)``, ``xi =
cos(phi)``; with ``psi = phi`` it is the match of Drucker and Prager (1952, Q. Appl. Math. 10:157), ``eta = 3 tan(phi) /
sqrt(9 + 12 tan(phi)^2)`` (de Souza Neto, Peric and Owen 2008, eq. 6.124).

The return is radial (their section 8.3): to the cone by ``f / (G + K eta eta_g)``, and where that would turn the
deviator over to the apex ``p = c cot(phi)``, which also caps tension. Without dilation the apex is reached by a
hydrostatic map.
"""

import math
from typing import NamedTuple

from solver._jit import inlined
from solver.elastic import bulk_modulus, shear_modulus
from solver.hooke import elastic_trial
from solver.lanes import where
from solver.laws.registry import Constants, constitutive_law
from solver.softening import Softening, softened_strength

_TINY = 1e-30


class DruckerPrager(NamedTuple):
    """Properties that all particles of a material share."""

    bulk_modulus: float  # Pa
    shear_modulus: float  # Pa
    flow_slope: float  # eta_g
    softening: Softening


def drucker_prager(constants: Constants) -> DruckerPrager:
    """Return the law of soil with these constants."""
    elasticity = constants.young_modulus, constants.poisson_ratio
    sin_psi = math.sin(constants.dilation_angle)
    flow_slope = 3.0 * sin_psi / math.sqrt(9.0 + 3.0 * sin_psi**2)
    return DruckerPrager(bulk_modulus(*elasticity), shear_modulus(*elasticity), flow_slope, constants.softening)


@inlined
def plane_strain_match(sin_phi, flow_slope):
    """Return ``D``, the ratio of ``eta`` to ``sin(phi)`` and of ``xi`` to ``cos(phi)``."""
    return 1.0 / (math.sqrt(1.0 - flow_slope * flow_slope / 3.0) + flow_slope * sin_phi / 3.0)


@inlined
def return_stress(stress, c_cos_phi, sin_phi, law):
    """Return ``(xx, yy, zz, xy, plastic strain increment)`` for a trial stress; stresses in Pa."""
    xx, yy, zz, xy = stress
    ratio = plane_strain_match(sin_phi, law.flow_slope)
    eta, xi_c = ratio * sin_phi, ratio * c_cos_phi
    p = (xx + yy + zz) / 3.0
    dev_xx, dev_yy, dev_zz = xx - p, yy - p, zz - p
    size = math.sqrt(0.5 * (dev_xx * dev_xx + dev_yy * dev_yy + dev_zz * dev_zz) + xy * xy)  # sqrt(J2)
    f = size + eta * p - xi_c
    multiplier = max(f, 0.0) / (law.shear_modulus + law.bulk_modulus * eta * law.flow_slope)
    drop = law.shear_modulus * multiplier
    is_apex = (f > 0.0) & (drop > size)
    drop = where(is_apex, size, drop)
    drop_p = where(is_apex, p - xi_c / max(eta, _TINY), law.bulk_modulus * law.flow_slope * multiplier)
    shrink = drop / max(size, _TINY)
    return (
        xx - dev_xx * shrink - drop_p,
        yy - dev_yy * shrink - drop_p,
        zz - dev_zz * shrink - drop_p,
        xy - xy * shrink,
        drop / (math.sqrt(3.0) * law.shear_modulus),
    )


@constitutive_law("drucker-prager", DruckerPrager, drucker_prager)
def update_drucker_prager(law, stress, strain, plastic_strain, strength, dt):
    """Return stress and plastic strain after an elastic predictor and the return to the cone or its apex.

    Arguments are those of ``registry.update_stress``.
    """
    trial = elastic_trial(stress, strain, law.bulk_modulus, law.shear_modulus)
    c_cos_phi, sin_phi = softened_strength(plastic_strain, strength, law.softening)
    xx, yy, zz, xy, increment = return_stress(trial, c_cos_phi, sin_phi, law)
    return xx, yy, zz, xy, plastic_strain + increment
