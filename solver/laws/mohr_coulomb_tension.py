"""Mohr-Coulomb plasticity with a cut-off of tension: ``s1 <= T`` besides, with associated flow (Rankine).

With tension positive, ``s1 >= s2 >= s3``, the planes of ``mohr_coulomb`` and, for ``T <= c cot(phi)``,

    f_t = s1 - T <= 0,   flow along ds1

A trial outside returns by Mohr-Coulomb alone if that leaves ``s1 <= T``; or by tension alone, to the plane ``s1 = T``,
the edge ``s1 = s2 = T`` or the apex ``s1 = s2 = s3 = T``, if that is within Mohr-Coulomb; or else to where both meet,

    s1 = T,   s3 = (T (1 + sin(phi)) - 2 c cos(phi)) / (1 - sin(phi)),   s3 <= s2 <= T

(Clausen, Damkilde and Andersen 2006, Comput. Struct. 85:1795; Abbo and Sloan 1995, Comput. Struct. 54:427). On the
plane of tension ``s2`` and ``s3`` drop by ``nu / (1 - nu)`` of the drop of ``s1``, on its edge ``s3`` by ``nu`` of both
drops. Where both meet nothing flows along ``s2``, whatever the dilation, so that it drops by ``nu`` of the drops of the
other two, and where that takes it out of order it is the nearer of them.

Softening takes from ``T`` what it takes from the cohesion. The deviator of what opens is plastic strain as any other,
so ground that cracks loses its cohesion.
"""

import math
from typing import NamedTuple

from solver._jit import inlined
from solver.elastic import bulk_modulus, shear_modulus
from solver.hooke import elastic_trial
from solver.lanes import anywhere, where
from solver.laws.mohr_coulomb import drops_in_return, inverses
from solver.laws.registry import Constants, constitutive_law
from solver.principal import equivalent_plastic_strain, principal_stresses, relaxed
from solver.softening import Softening, cosine, remaining_share, sine, softened

_TINY = 1e-30


class MohrCoulombTension(NamedTuple):
    """Properties that all particles of a material share."""

    bulk_modulus: float  # Pa
    shear_modulus: float  # Pa
    sin_dilation: float  # sine of the dilation angle psi
    tension_cutoff: float  # Pa, of ground with its peak cohesion
    softening: Softening


def mohr_coulomb_tension(constants: Constants) -> MohrCoulombTension:
    """Return the law of soil with these constants."""
    elasticity = constants.young_modulus, constants.poisson_ratio
    return MohrCoulombTension(
        bulk_modulus(*elasticity),
        shear_modulus(*elasticity),
        math.sin(constants.dilation_angle),
        constants.tension_cutoff,
        constants.softening,
    )


@inlined
def return_to_tension(s1, s2, s3, tension, c_cos_phi, sin_phi, law):
    """Return the principal stresses with ``s1 = T`` for the trial ``s1 >= s2 >= s3`` (Pa), within Mohr-Coulomb."""
    lame = law.bulk_modulus - 2.0 * law.shear_modulus / 3.0
    of_one = lame / (lame + 2.0 * law.shear_modulus)  # nu / (1 - nu)
    of_two = lame / (2.0 * (lame + law.shear_modulus))  # nu
    drop_1 = s1 - tension
    plane_2, plane_3 = s2 - of_one * drop_1, s3 - of_one * drop_1
    is_edge = plane_2 > tension
    edge_3 = s3 - of_two * (drop_1 + s2 - tension)
    alone_2 = where(is_edge, tension, plane_2)
    alone_3 = min(where(is_edge, edge_3, plane_3), tension)
    lowest = (tension * (1.0 + sin_phi) - 2.0 * c_cos_phi) / (1.0 - sin_phi)
    both_2 = min(max(s2 - of_two * (drop_1 + s3 - lowest), lowest), tension)
    is_both = alone_3 < lowest
    return tension, where(is_both, both_2, alone_2), where(is_both, lowest, alone_3)


@inlined
def return_stress(stress, tension, c_cos_phi, sin_phi, law):
    """Return ``(xx, yy, zz, xy, plastic strain increment)`` for a trial stress; stresses in Pa."""
    s1, s2, s3 = principal_stresses(stress)
    inverse_stiffness, inverse_radius = inverses(stress, sin_phi, law)
    drop_1, drop_2, drop_3, plastic_strain = drops_in_return(s1, s2, s3, inverse_stiffness, c_cos_phi, sin_phi, law)
    apex = c_cos_phi / max(sin_phi, _TINY)
    is_cut = (s1 - drop_1 > tension) & (tension < apex)
    if anywhere(is_cut):
        n1, n2, n3 = return_to_tension(s1, s2, s3, tension, c_cos_phi, sin_phi, law)
        drop_1, drop_2, drop_3 = (
            where(is_cut, s1 - n1, drop_1),
            where(is_cut, s2 - n2, drop_2),
            where(is_cut, s3 - n3, drop_3),
        )
        opened = equivalent_plastic_strain(drop_1, drop_2, drop_3, law.shear_modulus)
        plastic_strain = where(is_cut, opened, plastic_strain)
    xx, yy, zz, xy = relaxed(stress, drop_1, drop_2, drop_3, inverse_radius)
    return xx, yy, zz, xy, plastic_strain


@constitutive_law("mohr-coulomb-tension", MohrCoulombTension, mohr_coulomb_tension)
def update_mohr_coulomb_tension(law, stress, strain, plastic_strain, strength, dt):
    """Return stress and plastic strain after an elastic predictor and the return to the yield surface.

    Arguments are those of ``registry.update_stress``. Strength is that of the plastic strain before the increment.
    """
    trial = elastic_trial(stress, strain, law.bulk_modulus, law.shear_modulus)
    share = remaining_share(plastic_strain, law.softening)
    cohesion = softened(strength.cohesion, strength.cohesion_residual, share)
    friction_angle = softened(strength.friction_angle, strength.friction_angle_residual, share)
    tension = law.tension_cutoff * (cohesion / max(strength.cohesion, _TINY))
    xx, yy, zz, xy, increment = return_stress(
        trial, tension, cohesion * cosine(friction_angle), sine(friction_angle), law
    )
    return xx, yy, zz, xy, plastic_strain + increment
