"""Mohr-Coulomb plasticity with a non-associated potential: the full return mapping in principal stress space.

With tension positive and ``s1 >= s2 >= s3``

    f = (s1 - s3) + (s1 + s3) sin(phi) - 2 c cos(phi) <= 0
    g = (s1 - s3) + (s1 + s3) sin(psi)

A trial stress outside returns to the plane, to the edge ``s1 = s2``, to the edge ``s2 = s3``, or to the apex
``s1 = s2 = s3 = c cot(phi)`` (Clausen, Damkilde and Andersen 2006, Comput. Struct. 85:1795; de Souza Neto, Peric and
Owen 2008, ch. 8). With ``psi = 0`` plastic flow cannot change the mean stress, so the apex is reached by a hydrostatic
map, which is also the cap on tension. All four candidates are computed and the right one is selected, without a branch,
so that the loop over particles vectorises.
"""

import math
from typing import NamedTuple

from solver._jit import point
from solver.elastic import bulk_modulus, shear_modulus
from solver.hooke import elastic_trial
from solver.laws.registry import Constants, constitutive_law
from solver.principal import equivalent_plastic_strain, principal_stresses, relaxed
from solver.softening import Softening, softened_strength

_TINY = 1e-30


class MohrCoulomb(NamedTuple):
    """Properties that all particles of a material share."""

    bulk_modulus: float  # Pa
    shear_modulus: float  # Pa
    sin_dilation: float  # sine of the dilation angle psi
    softening: Softening


def mohr_coulomb(constants: Constants) -> MohrCoulomb:
    """Return the law of soil with these constants."""
    elasticity = constants.young_modulus, constants.poisson_ratio
    return MohrCoulomb(
        bulk_modulus(*elasticity), shear_modulus(*elasticity), math.sin(constants.dilation_angle), constants.softening
    )


@point
def yield_function(s1, s3, c_cos_phi, sin_phi):
    """Return ``f`` in Pa for the largest and the smallest principal stress."""
    return (s1 - s3) + (s1 + s3) * sin_phi - 2.0 * c_cos_phi


@point
def return_mapping(s1, s2, s3, c_cos_phi, sin_phi, law):
    """Return the principal stresses on or inside the yield surface for the trial ``s1 >= s2 >= s3`` (Pa).

    Flow on one plane changes the stress by ``-dgamma D b`` with ``D b = (rise, transverse, -fall)``. On an edge the two
    multipliers solve ``[[a, b], [b, a]] (dgamma_1, dgamma_2) = (f_13, f_other)``.
    """
    G = law.shear_modulus
    sin_psi = law.sin_dilation
    transverse = 2.0 * (law.bulk_modulus - 2.0 * G / 3.0) * sin_psi
    rise = 2.0 * G * (1.0 + sin_psi) + transverse
    fall = 2.0 * G * (1.0 - sin_psi) - transverse
    coupling = 2.0 * transverse * sin_phi
    a = 4.0 * G * (1.0 + sin_phi * sin_psi) + coupling

    f = yield_function(s1, s3, c_cos_phi, sin_phi)
    multiplier = max(f, 0.0) / a
    plane_1 = s1 - multiplier * rise
    plane_2 = s2 - multiplier * transverse
    plane_3 = s3 + multiplier * fall

    on_upper_edge = plane_2 > plane_1  # s1 = s2
    on_lower_edge = plane_3 > plane_2  # s2 = s3
    b_upper = 2.0 * G * (1.0 - sin_phi) * (1.0 - sin_psi) + coupling
    b_lower = 2.0 * G * (1.0 + sin_phi) * (1.0 + sin_psi) + coupling
    b = b_upper if on_upper_edge else b_lower
    f_upper = yield_function(s2, s3, c_cos_phi, sin_phi)
    f_lower = yield_function(s1, s2, c_cos_phi, sin_phi)
    f_other = f_upper if on_upper_edge else f_lower
    determinant = a * a - b * b
    first = (a * f - b * f_other) / determinant
    second = (a * f_other - b * f) / determinant
    both = first + second
    upper_1 = s1 - first * rise - second * transverse
    upper_3 = s3 + both * fall
    lower_1 = s1 - both * rise
    lower_3 = s3 + first * fall - second * transverse
    edge_1 = upper_1 if on_upper_edge else lower_1
    edge_3 = upper_3 if on_upper_edge else lower_3
    edge_2 = edge_1 if on_upper_edge else edge_3

    on_edge = f > 0.0 and (on_upper_edge or on_lower_edge)
    on_apex = on_edge and edge_1 < edge_3
    apex = c_cos_phi / max(sin_phi, _TINY)
    new_1 = edge_1 if on_edge else plane_1
    new_2 = edge_2 if on_edge else plane_2
    new_3 = edge_3 if on_edge else plane_3
    return (apex if on_apex else new_1), (apex if on_apex else new_2), (apex if on_apex else new_3)


@point
def return_stress(stress, c_cos_phi, sin_phi, law):
    """Return ``(xx, yy, zz, xy, plastic strain increment)`` for a trial stress; stresses in Pa."""
    s1, s2, s3 = principal_stresses(stress)
    n1, n2, n3 = return_mapping(s1, s2, s3, c_cos_phi, sin_phi, law)
    xx, yy, zz, xy = relaxed(stress, s1 - n1, s2 - n2, s3 - n3)
    return xx, yy, zz, xy, equivalent_plastic_strain(s1 - n1, s2 - n2, s3 - n3, law.shear_modulus)


@constitutive_law("mohr-coulomb", MohrCoulomb, mohr_coulomb)
def update_mohr_coulomb(law, stress, strain, plastic_strain, strength, dt):
    """Return stress and plastic strain after an elastic predictor and the return to the yield surface.

    Arguments are those of ``registry.update_stress``. Strength is that of the plastic strain before the increment; the
    lag vanishes with the increment.
    """
    trial = elastic_trial(stress, strain, law.bulk_modulus, law.shear_modulus)
    c_cos_phi, sin_phi = softened_strength(plastic_strain, strength, law.softening)
    xx, yy, zz, xy, increment = return_stress(trial, c_cos_phi, sin_phi, law)
    return xx, yy, zz, xy, plastic_strain + increment
