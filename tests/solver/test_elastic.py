"""Isotropic elasticity against textbook identities."""

import numpy as np
import pytest
from pointwise import stress_of

from solver.elastic import bulk_modulus, p_wave_speed, shear_modulus

E, NU, DENSITY = 70e6, 0.35, 2100.0
K, G = bulk_modulus(E, NU), shear_modulus(E, NU)


def test_moduli_give_back_the_engineering_constants():
    assert 9.0 * K * G / (3.0 * K + G) == pytest.approx(E, rel=1e-14)
    assert (3.0 * K - 2.0 * G) / (2.0 * (3.0 * K + G)) == pytest.approx(NU, rel=1e-14)


def test_p_wave_speed_is_that_of_the_oedometer_modulus():
    oedometer = E * (1.0 - NU) / ((1.0 + NU) * (1.0 - 2.0 * NU))
    assert p_wave_speed(K, G, DENSITY) == pytest.approx(np.sqrt(oedometer / DENSITY), rel=1e-14)


def test_stress_is_the_inverse_of_hookes_compliance():
    """``eps = ((1 + nu) sigma - nu tr(sigma) 1) / E`` gives back the strain, with none out of plane."""
    strain = 1e-3, -4e-3, 2.5e-3
    xx, yy, zz, xy = stress_of(*strain, K, G)
    trace = xx + yy + zz
    found = [((1.0 + NU) * s - NU * trace) / E for s in (xx, yy, zz)] + [(1.0 + NU) * xy / E]
    np.testing.assert_allclose(found, [strain[0], strain[1], 0.0, strain[2]], rtol=1e-13, atol=1e-17)
