"""The step as a matrix: where an elastic block whose particles do not move is stable, without any of the solver's code.

With ``S`` the weights of particles (rows) on nodes, ``B`` their gradients as strains, ``P = M^-1 S^T m`` from particle
to nodal velocities, ``A = -M^-1 B^T V`` from stresses to nodal accelerations and ``D`` the elastic moduli, a step is

    v      <- v + S A sigma dt
    sigma  <- sigma + D B P v dt                     MUSL, with the new v; USF is the same from another beginning
    sigma  <- sigma + D B (P v + A sigma dt) dt      USL, with the old v

and it is unstable if an eigenvalue exceeds one. Weights are means of the hat function over the particle's domain.
"""

import numpy as np
from bodies import BASES, OFFSETS, SOIL, SPEED, free_block

SIDE, NODES = 3.0, np.arange(10.0)  # cells; a fourth one changes the limits by less than 1 %
GROWTH = 1.001  # a step: beyond rounding, and thousandfold in energy within 3500 steps


def is_unstable(basis, scheme, courant):
    """Return whether a vibration grows in a block that lies at one of the places of the measurement."""
    return any(largest_growth(basis, scheme, courant, offset) > GROWTH for offset in OFFSETS)


def limit(basis, scheme, low=0.02, high=2.6, resolution=0.01):
    """Return the Courant number from which on the step is unstable."""
    while high - low > resolution:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if is_unstable(basis, scheme, middle) else (middle, high)
    return 0.5 * (low + high)


def largest_growth(basis, scheme, courant, offset):
    """Return the largest modulus of the eigenvalues of the step."""
    block, dt = free_block(SIDE, offset), courant / SPEED
    n, mass, volume = block.x.size, block.mass[0], block.volume[0]
    s, b, node_mass = weights_and_strains(block, BASES[basis], mass)
    to_nodes = mass * s.T / node_mass
    to_acceleration = -volume * b.T / node_mass
    to_stress = dt * np.kron(moduli(), np.eye(n)) @ b
    kick = dt * s @ to_acceleration
    late = dt * to_acceleration if scheme == "usl" else to_nodes @ kick
    step = [[np.eye(2 * n), kick], [to_stress @ to_nodes, np.eye(3 * n) + to_stress @ late]]
    return np.abs(np.linalg.eigvals(np.block(step))).max()


def weights_and_strains(block, half_length, mass):
    """Return ``S`` (2 n, 2 nodes), ``B`` (3 n, 2 nodes) and the mass (2 nodes, 1) of the nodes that have any."""
    (sx, gx), (sy, gy) = (hat_averages(place, half_length) for place in (block.x, block.y))
    pairs = ((sx, sy), (gx, sy), (sx, gy))
    s, along_x, along_y = (np.einsum("pi,pj->pij", *pair).reshape(block.x.size, -1) for pair in pairs)
    touched = s.sum(axis=0) > 1e-12
    s, along_x, along_y = s[:, touched], along_x[:, touched], along_y[:, touched]
    none = np.zeros_like(s)
    node_mass = mass * np.tile(s.sum(axis=0), 2)[:, None]
    return np.block([[s, none], [none, s]]), np.block([[along_x, none], [none, along_y], [along_y, along_x]]), node_mass


def hat_averages(place, half_length):
    """Return the mean of the hat functions of `NODES` and of their slopes over ``place +- half_length``, (n, nodes)."""
    begin, end = (np.clip(place[:, None] + side * half_length - NODES, -1.0, 1.0) for side in (-1.0, 1.0))
    integral = end - begin - 0.5 * (end * np.abs(end) - begin * np.abs(begin))
    return integral / (2.0 * half_length), (np.abs(begin) - np.abs(end)) / (2.0 * half_length)


def moduli():
    """Return the plane strain moduli of xx, yy and the engineering shear strain."""
    shear, lame = SOIL.shear_modulus, SOIL.bulk_modulus - 2.0 / 3.0 * SOIL.shear_modulus
    return np.diag([2.0 * shear, 2.0 * shear, shear]) + lame * np.outer([1, 1, 0], [1, 1, 0])
