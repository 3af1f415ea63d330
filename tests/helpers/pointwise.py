"""The solver's scalar laws, applied to arrays of points, and an independent oracle for Mohr-Coulomb."""

import itertools

import numpy as np

from solver._jit import kernel
from solver.hooke import elastic_increment
from solver.kinematics import rotate_stress
from solver.laws import mohr_coulomb
from solver.laws.registry import NO_CUTOFF, Constants, make_law, update_stress
from solver.softening import Softening, Strength, cosine, exp_decay, sine

COHESION = 20e3  # Pa
RESIDUAL_COHESION, RESIDUAL_FRICTION_ANGLE = 10e3, np.radians(5.0)


def soil_of(psi, rate=0.0, is_linear=False):
    """Return Mohr-Coulomb soil of the dilation angle ``psi`` (degrees)."""
    return law_of("mohr-coulomb", psi, rate, is_linear)


def law_of(name, psi=0.0, rate=0.0, is_linear=False, tension_cutoff=NO_CUTOFF):
    """Return the law of that name for the same soil."""
    return make_law(name, Constants(70e6, 0.35, np.radians(psi), Softening(rate, is_linear), tension_cutoff))


def strength_of(cohesion, friction_angle):
    """Return a strength that softens to 10 kPa and 5 degrees."""
    return Strength(cohesion, friction_angle, RESIDUAL_COHESION, RESIDUAL_FRICTION_ANGLE)


def random_trials(n, seed, cohesion=COHESION):
    """Return stresses (4, n) in Pa of many magnitudes, over all orders of the principal stresses."""
    rng = np.random.default_rng(seed)
    scale = cohesion * 10.0 ** rng.uniform(-1.0, 1.5, n)
    isotropic = 2.0 * rng.normal(size=n) * np.array([1.0, 1.0, 1.0, 0.0])[:, None]
    return scale * (isotropic + 3.0 * rng.uniform(0.0, 1.0, n) * rng.normal(size=(4, n)))


@kernel
def _fill_mohr_coulomb(xx, yy, zz, xy, c_cos_phi, sin_phi, soil, result):
    for p in range(xx.size):
        result[:, p] = mohr_coulomb.return_stress((xx[p], yy[p], zz[p], xy[p]), c_cos_phi[p], sin_phi[p], soil)


def return_stress(stress, cohesion, friction_angle, soil):
    """Return stress (4, n) and plastic strain increment (n,) of trial stresses (4, n) in Pa, order xx, yy, zz, xy."""
    n = stress.shape[1]
    cohesion, phi = np.broadcast_to(cohesion, n), np.broadcast_to(friction_angle, n)
    result = np.empty((5, n))
    _fill_mohr_coulomb(*stress, cohesion * np.cos(phi), np.sin(phi), soil, result)
    return result[:4], result[4]


@kernel
def follow(stress, strain, strength, law, dt, history):
    """March ``stress`` (4,) along strain increments (n, 3), order xx, yy, xy; fill ``history`` (n, 5)."""
    xx, yy, zz, xy = stress[0], stress[1], stress[2], stress[3]
    plastic_strain = 0.0
    for k in range(strain.shape[0]):
        xx, yy, zz, xy, plastic_strain = update_stress(
            law, (xx, yy, zz, xy), (strain[k, 0], strain[k, 1], strain[k, 2]), plastic_strain, strength, dt
        )
        history[k] = xx, yy, zz, xy, plastic_strain


def follow_law(law, stress, strain, strength):
    """Return the history (n, 5) of ``stress`` (4,) along strain increments (n, 3)."""
    history = np.empty((len(strain), 5))
    follow(stress, strain, strength, law, 1.0, history)
    return history


def drive(law, stress, increment, steps, strength):
    """Return ``(xx, yy, zz, xy, plastic_strain)`` after ``steps`` equal strain increments (3,)."""
    return follow_law(law, stress, np.tile(increment, (steps, 1)), strength)[-1]


@kernel
def _fill_by_law(law, stress, strength, result):
    for p in range(stress.shape[1]):
        trial = stress[0, p], stress[1, p], stress[2, p], stress[3, p]
        result[:, p] = update_stress(law, trial, (0.0, 0.0, 0.0), 0.0, strength, 1.0)


def return_by(law, stress, strength):
    """Return stress (4, n) and plastic strain increment (n,) of trial stresses (4, n) by any law."""
    result = np.empty((5, stress.shape[1]))
    _fill_by_law(law, stress, strength, result)
    return result[:4], result[4]


@kernel
def rotate(stress, rotation, turns):
    """Return the in-plane stress (xx, yy, xy) after ``turns`` equal increments of rotation."""
    xx, yy, xy = stress
    for _ in range(turns):
        xx, yy, xy = rotate_stress(xx, yy, xy, rotation)
    return xx, yy, xy


@kernel
def evaluate_exp_decay(x, result):
    for p in range(x.size):
        result[p] = exp_decay(x[p])


@kernel
def evaluate_sine(x, result):
    for p in range(x.size):
        result[p] = sine(x[p])


@kernel
def evaluate_cosine(x, result):
    for p in range(x.size):
        result[p] = cosine(x[p])


@kernel
def stress_of(strain_xx, strain_yy, strain_xy, bulk, shear):
    return elastic_increment(strain_xx, strain_yy, strain_xy, bulk, shear)


def principal(stress):
    """Return principal stresses (n, 3), smallest first, of stresses (4, n) by the eigenvalues of the full tensor."""
    xx, yy, zz, xy = stress
    tensor = np.zeros((xx.size, 3, 3))
    tensor[:, 0, 0], tensor[:, 1, 1], tensor[:, 2, 2] = xx, yy, zz
    tensor[:, 0, 1] = tensor[:, 1, 0] = xy
    return np.linalg.eigvalsh(tensor)


PLANES = list(itertools.permutations(range(3), 2))  # (i, j): f = s_i - s_j + (s_i + s_j) sin(phi) - 2 c cos(phi)


def normals(sine_of_angle):
    """Return the gradients (6, 3) of the six Mohr-Coulomb planes."""
    planes = np.zeros((6, 3))
    for k, (i, j) in enumerate(PLANES):
        planes[k, i] = 1.0 + sine_of_angle
        planes[k, j] = -(1.0 - sine_of_angle)
    return planes


def stiffness(soil):
    """Return the elastic matrix (3, 3) between principal strains and stresses."""
    lame = soil.bulk_modulus - 2.0 * soil.shear_modulus / 3.0
    return lame * np.ones((3, 3)) + 2.0 * soil.shear_modulus * np.eye(3)


def koiter_solutions(trial, c_cos_phi, sin_phi, soil):
    """Return every stress that Koiter's conditions allow for one yielding principal trial stress (3,).

    ``s = trial - D sum_k lambda_k b_k``, ``lambda_k >= 0``, ``f_k(s) <= 0``, ``lambda_k f_k(s) = 0`` over all six
    planes: each set of one, two or three active planes is tried, without any ordering of the principal stresses.
    """
    gradients, flows = normals(sin_phi), normals(soil.sin_dilation) @ stiffness(soil)
    excess = gradients @ trial - 2.0 * c_cos_phi
    tolerance = 1e-9 * (np.abs(trial).max() + c_cos_phi)
    solutions = []
    for count in (1, 2, 3):
        for active in map(list, itertools.combinations(range(6), count)):
            matrix = gradients[active] @ flows[active].T
            if np.linalg.cond(matrix) > 1e10:
                continue
            multipliers = np.linalg.solve(matrix, excess[active])
            stress = trial - multipliers @ flows[active]
            if (multipliers >= -1e-12).all() and (gradients @ stress - 2.0 * c_cos_phi <= tolerance).all():
                solutions.append(stress)
    return solutions
