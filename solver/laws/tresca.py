"""Tresca plasticity: undrained soil, whose strength ``s_u`` does not depend on pressure and whose volume is kept.

With tension positive and ``s1 >= s2 >= s3``

    f = (s1 - s3) - 2 s_u <= 0,   flow along df/ds

The cohesion of a particle is its undrained strength; a friction angle is not read. This is Mohr-Coulomb with ``phi =
psi = 0``, where the return has a closed form (de Souza Neto, Peric and Owen 2008, section 8.1). The mean stress ``p``
stays. A trial outside returns to the plane by ``f / 2`` from either side, or where the middle stress stands in the way
to an edge of the prism:

    s1 = s2 = p + 2/3 s_u,  s3 = p - 4/3 s_u     or     s1 = p + 4/3 s_u,  s2 = s3 = p - 2/3 s_u
"""

from typing import NamedTuple

from solver._jit import inlined
from solver.elastic import bulk_modulus, shear_modulus
from solver.hooke import elastic_trial
from solver.lanes import where
from solver.laws.registry import Constants, constitutive_law
from solver.principal import SMALLEST_RADIUS, equivalent_plastic_strain, in_plane, principal_stresses, relaxed
from solver.softening import Softening, remaining_share, softened


class Tresca(NamedTuple):
    """Properties that all particles of a material share."""

    bulk_modulus: float  # Pa
    shear_modulus: float  # Pa
    softening: Softening


def tresca(constants: Constants) -> Tresca:
    """Return the law of soil with these constants; there is no dilation."""
    elasticity = constants.young_modulus, constants.poisson_ratio
    return Tresca(bulk_modulus(*elasticity), shear_modulus(*elasticity), constants.softening)


@inlined
def return_mapping(s1, s2, s3, strength):
    """Return the principal stresses on or inside the prism of ``strength`` (Pa) for the trial ``s1 >= s2 >= s3``."""
    excess = max((s1 - s3) - 2.0 * strength, 0.0)
    plane_1 = s1 - 0.5 * excess
    plane_3 = s3 + 0.5 * excess
    mean = (s1 + s2 + s3) / 3.0
    is_above = (excess > 0.0) & (s2 > plane_1)  # s1 = s2
    is_below = (excess > 0.0) & (s2 < plane_3)  # s2 = s3
    third = 2.0 / 3.0 * strength
    above_1, below_1 = mean + third, mean + 2.0 * third
    above_3, below_3 = mean - 2.0 * third, mean - third
    new_1 = where(is_above, above_1, where(is_below, below_1, plane_1))
    new_2 = where(is_above, above_1, where(is_below, below_3, s2))
    new_3 = where(is_above, above_3, where(is_below, below_3, plane_3))
    return new_1, new_2, new_3


@constitutive_law("tresca", Tresca, tresca)
def update_tresca(law, stress, strain, plastic_strain, strength, dt):
    """Return stress and plastic strain after an elastic predictor and the return to the prism.

    Arguments are those of ``registry.update_stress``.
    """
    trial = elastic_trial(stress, strain, law.bulk_modulus, law.shear_modulus)
    share = remaining_share(plastic_strain, law.softening)
    s_u = softened(strength.cohesion, strength.cohesion_residual, share)
    s1, s2, s3 = principal_stresses(trial)
    n1, n2, n3 = return_mapping(s1, s2, s3, s_u)
    xx, yy, zz, xy = relaxed(trial, s1 - n1, s2 - n2, s3 - n3, 1.0 / max(in_plane(trial)[2], SMALLEST_RADIUS))
    increment = equivalent_plastic_strain(s1 - n1, s2 - n2, s3 - n3, law.shear_modulus)
    return xx, yy, zz, xy, plastic_strain + increment
