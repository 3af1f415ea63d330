"""Mohr-Coulomb plasticity with a non-associated potential: the full return mapping in principal stress space.

With tension positive and ``s1 >= s2 >= s3``

    f = (s1 - s3) + (s1 + s3) sin(phi) - 2 c cos(phi) <= 0
    g = (s1 - s3) + (s1 + s3) sin(psi)

A trial stress outside returns to the plane, to the edge ``s1 = s2``, to the edge ``s2 = s3``, or to the apex
``s1 = s2 = s3 = c cot(phi)`` (Clausen, Damkilde and Andersen 2006, Comput. Struct. 85:1795; de Souza Neto, Peric and
Owen 2008, ch. 8). With ``psi = 0`` plastic flow cannot change the mean stress, so the apex is reached by a hydrostatic
map, which is also the cap on tension. Most that yields returns to the plane; edges and apex are looked at only where
one of eight particles needs them.
"""

import math
from typing import NamedTuple

from solver._jit import inlined
from solver.elastic import bulk_modulus, shear_modulus
from solver.hooke import elastic_trial
from solver.lanes import anywhere, where
from solver.laws.registry import Constants, constitutive_law
from solver.principal import SMALLEST_RADIUS, equivalent_plastic_strain, in_plane, principal_stresses, relaxed
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


@inlined
def yield_function(s1, s3, c_cos_phi, sin_phi):
    """Return ``f`` in Pa for the largest and the smallest principal stress."""
    return (s1 - s3) + (s1 + s3) * sin_phi - 2.0 * c_cos_phi


@inlined
def flow_of(law):
    """Return ``D b = (rise, transverse, -fall)`` in Pa: flow on the plane drops the stress by ``dgamma D b``."""
    G, sin_psi = law.shear_modulus, law.sin_dilation
    transverse = 2.0 * (law.bulk_modulus - 2.0 * G / 3.0) * sin_psi
    return 2.0 * G * (1.0 + sin_psi) + transverse, transverse, 2.0 * G * (1.0 - sin_psi) - transverse


@inlined
def stiffness_of_plane(sin_phi, law):
    """Return what ``f`` falls by for a unit of flow on its plane, and the part of it from the change of volume (Pa)."""
    _, transverse, _ = flow_of(law)
    coupling = 2.0 * transverse * sin_phi
    return 4.0 * law.shear_modulus * (1.0 + sin_phi * law.sin_dilation) + coupling, coupling


@inlined
def return_to_edge(s1, s2, s3, is_upper, c_cos_phi, sin_phi, law):
    """Return the stress on the edge ``s1 = s2`` where ``is_upper``, else ``s2 = s3``, or at the apex beyond its end.

    On an edge the multipliers of its two planes solve ``[[a, b], [b, a]] (dgamma_1, dgamma_2) = (f_13, f_other)``.
    """
    G, sin_psi = law.shear_modulus, law.sin_dilation
    rise, transverse, fall = flow_of(law)
    a, coupling = stiffness_of_plane(sin_phi, law)
    b_upper = 2.0 * G * (1.0 - sin_phi) * (1.0 - sin_psi) + coupling
    b_lower = 2.0 * G * (1.0 + sin_phi) * (1.0 + sin_psi) + coupling
    b = where(is_upper, b_upper, b_lower)
    f = yield_function(s1, s3, c_cos_phi, sin_phi)
    f_upper = yield_function(s2, s3, c_cos_phi, sin_phi)
    f_lower = yield_function(s1, s2, c_cos_phi, sin_phi)
    f_other = where(is_upper, f_upper, f_lower)
    determinant = a * a - b * b
    first = (a * f - b * f_other) / determinant
    second = (a * f_other - b * f) / determinant
    both = first + second
    new_1 = where(is_upper, s1 - first * rise - second * transverse, s1 - both * rise)
    new_3 = where(is_upper, s3 + both * fall, s3 + first * fall - second * transverse)
    is_apex = new_1 < new_3
    apex = c_cos_phi / max(sin_phi, _TINY)
    return where(is_apex, apex, new_1), where(is_apex, apex, where(is_upper, new_1, new_3)), where(is_apex, apex, new_3)


@inlined
def drops_in_return(s1, s2, s3, inverse_stiffness, c_cos_phi, sin_phi, law):
    """Return by how much the trial ``s1 >= s2 >= s3`` (Pa) drops, and the equivalent plastic strain of the return.

    The plane is tried first: for most that yield it is the right one, and all of them flow in its one direction.
    ``inverse_stiffness`` (1/Pa) is that of the plane.
    """
    rise, transverse, fall = flow_of(law)
    f = yield_function(s1, s3, c_cos_phi, sin_phi)
    multiplier = max(f, 0.0) * inverse_stiffness
    drop_1, drop_2, drop_3 = multiplier * rise, multiplier * transverse, -(multiplier * fall)
    plastic_strain = multiplier * equivalent_plastic_strain(rise, transverse, -fall, law.shear_modulus)
    is_upper = s2 - drop_2 > s1 - drop_1  # beyond s1 = s2
    is_lower = s3 - drop_3 > s2 - drop_2  # beyond s2 = s3
    on_edge = (f > 0.0) & (is_upper | is_lower)
    if anywhere(on_edge):
        e1, e2, e3 = return_to_edge(s1, s2, s3, is_upper, c_cos_phi, sin_phi, law)
        drop_1, drop_2, drop_3 = (
            where(on_edge, s1 - e1, drop_1),
            where(on_edge, s2 - e2, drop_2),
            where(on_edge, s3 - e3, drop_3),
        )
        on_edges = equivalent_plastic_strain(drop_1, drop_2, drop_3, law.shear_modulus)
        plastic_strain = where(on_edge, on_edges, plastic_strain)
    return drop_1, drop_2, drop_3, plastic_strain


@inlined
def inverses(stress, sin_phi, law):
    """Return the inverse of the stiffness of the plane, and of the radius of Mohr's circle in the plane (1/Pa)."""
    stiffness, radius = stiffness_of_plane(sin_phi, law)[0], max(in_plane(stress)[2], SMALLEST_RADIUS)
    inverse = 1.0 / (stiffness * radius)  # of both at once: a division takes as long as ten products
    return inverse * radius, inverse * stiffness


@inlined
def return_stress(stress, c_cos_phi, sin_phi, law):
    """Return ``(xx, yy, zz, xy, plastic strain increment)`` for a trial stress; stresses in Pa."""
    s1, s2, s3 = principal_stresses(stress)
    inverse_stiffness, inverse_radius = inverses(stress, sin_phi, law)
    drop_1, drop_2, drop_3, plastic_strain = drops_in_return(s1, s2, s3, inverse_stiffness, c_cos_phi, sin_phi, law)
    xx, yy, zz, xy = relaxed(stress, drop_1, drop_2, drop_3, inverse_radius)
    return xx, yy, zz, xy, plastic_strain


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
