"""Where the time of a step goes: its three parts, each timed by the C library's clock of processor time."""

import ctypes

import numba

from solver.constants import STANDARD_GRAVITY
from solver.deformation import deform
from solver.operations import solve_momentum
from solver.sorting import fill_tiles
from solver.spread import spread_all
from solver.step import accelerate

PARTS = ("nodes (2)", "accelerate and remap (3, 4)", "deform, move and spread (5, 6, 1)")
STEPS = 30  # before particles would be sorted again

_clock = ctypes.CDLL(None).clock
_clock.restype, _clock.argtypes = ctypes.c_long, []
_TICK = 1e-6  # s, of POSIX


@numba.njit(nogil=True, error_model="numpy")
def _timed_steps(tiles, grid, work, laws, scheme, dt, steps):
    """Take steps like those of ``solver.step.advance``; return the ticks that each part took."""
    nodes = momentum = deformation = 0
    spread_all(tiles, grid, scheme)
    for _ in range(steps):
        begin = _clock()
        solve_momentum(grid, STANDARD_GRAVITY, scheme.damping, dt)
        solved = _clock()
        accelerate(tiles, grid, work, scheme, STANDARD_GRAVITY, dt)
        accelerated = _clock()
        deform(tiles, grid, work.ledger, laws, scheme, STANDARD_GRAVITY, dt)
        nodes += solved - begin
        momentum += accelerated - solved
        deformation += _clock() - accelerated
    return nodes, momentum, deformation


def seconds_of_parts(particles, grid, work, model, dt):
    """Take `STEPS` steps and return how many seconds of processor time each of `PARTS` took in all."""
    tiles = fill_tiles(particles, grid, work.tiles)
    ticks = _timed_steps(tiles, grid, work, model.laws, model.scheme, dt, STEPS)
    return [_TICK * count for count in ticks]
