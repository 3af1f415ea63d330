"""Failures of a formula: one particle a cell, PIC, first-order spin, indefinite correlations, chi-square intervals."""

import numpy as np
from bodies import BASES
from driver import MUSL, elastic_soil, grid_without_walls, lattice
from scipy import stats

from campaign.errors import SamplerError
from campaign.fields.cholesky import cholesky_factor
from campaign.fields.correlation import Correlation
from campaign.statistics.intervals import variance_interval
from solver.basis import allocate_stencil, evaluate_stencil
from solver.kinematics import rotate_stress
from solver.particles import allocate_particles
from solver.step import advance, allocate_workspace


def chessboard_felt(basis, place):
    """Return the share of nodal values +1, -1, +1, ... in both directions felt ``place`` cells beyond a node."""
    grid, stencil = grid_without_walls(4.0, 4.0, 1.0, BASES[basis]), allocate_stencil(1)
    evaluate_stencil(stencil, np.array([1.0 + place]), np.array([1.0 + place]), grid)
    signs = np.array([1.0, -1.0, 1.0])
    return abs(signs @ stencil.sx[:, 0] * (signs @ stencil.sy[:, 0]))


PLACES = np.arange(4) / 8.0  # of a particle in its cell, for the average over places


def expected_pic_constant(basis):
    """Return ``1/6 + l_p^2 / 3`` (in cells): the variance of a particle's weights, averaged over its places."""
    return 1.0 / 6.0 + BASES[basis] ** 2 / 3.0


def pic_constant(basis, blend=0.1):
    """Return ``a`` of the viscosity ``a beta h^2 / dt``, averaged over the places of the particles."""
    return np.mean([pic_decay(basis, blend, offset) for offset in PLACES])


def pic_decay(basis, blend, offset, waves=4, length=32, steps=400):
    """Return ``a`` from the decay ``exp(-a beta (k h)^2 n)`` of a shear wave in matter without stiffness."""
    x, y = lattice(4.0, waves * length, 0.5)
    wave = np.cos(2.0 * np.pi * y / length)
    body = allocate_particles(x + 4.0, y + 2.0 + offset, 0.25, 1.0)
    body.velocity_x[:] = 1e-6 * wave
    grid = grid_without_walls(12.0, waves * length + 4.0, 1.0, BASES[basis])
    grid.free_y[:] = 0.0
    scheme = MUSL._replace(flip_fraction=1.0 - blend)
    advance(body, grid, allocate_workspace(x.size), (elastic_soil(1e-12, 0.0),), scheme, 0.0, 0.0, 1e-3, steps)
    inner = np.abs(y - waves * length / 2) < length
    left = (body.velocity_x[inner] @ wave[inner]) / (1e-6 * wave[inner] @ wave[inner])
    return -np.log(left) / (blend * (2.0 * np.pi / length) ** 2 * steps)


def first_order_growth(steps):
    """Return the growth of the deviator in one turn by ``sigma + dt (W sigma - sigma W)``."""
    xx, yy, xy = 1.0, -1.0, 0.0
    w = 2.0 * np.pi / steps
    for _ in range(steps):
        xx, yy, xy = xx + 2.0 * w * xy, yy - 2.0 * w * xy, xy - w * (xx - yy)
    return np.hypot(0.5 * (xx - yy), xy)


def cayley_growth(steps):
    """Return the same for the solver's rotation."""
    stress = 1.0, -1.0, 0.0
    for _ in range(steps):
        stress = rotate_stress(*stress, 2.0 * np.pi / steps)
    return np.hypot(0.5 * (stress[0] - stress[1]), stress[2])


def has_cholesky_factor(spacing, points=150):
    """Return whether points on a line have a squared-exponential factor, ``spacing`` correlation distances apart."""
    try:
        cholesky_factor(Correlation("squared-exponential", 1.0, 1.0), np.zeros(points), spacing * np.arange(points))
    except SamplerError:
        return False
    return True


def finest_factorised():
    """Return the finest spacing, in hundredths of the autocorrelation distance, that has a Cholesky factor."""
    return next(spacing for spacing in np.arange(0.01, 1.0, 0.01) if has_cholesky_factor(spacing))


def chi_square_interval(values, confidence=0.95):
    """Return the textbook's bounds of the variance."""
    n, tail = len(values), (1.0 - confidence) / 2.0
    return (n - 1) * np.var(values, ddof=1) / stats.chi2.ppf([1.0 - tail, tail], n - 1)


def coverages(campaigns=2000, n=100, cov=0.5):
    """Return how often the chi-square and Bonett's 95 % interval hold the variance of a lognormal variable."""
    rng, s = np.random.default_rng(5), np.sqrt(np.log1p(cov**2))
    variance = cov**2
    held = np.zeros(2)
    for values in np.exp(rng.normal(-0.5 * s**2, s, (campaigns, n))):
        low, high = chi_square_interval(values)
        bonett = variance_interval(values, 0.95)
        held += low < variance < high, bonett.lower < variance < bonett.upper
    return held / campaigns
