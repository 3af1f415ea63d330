"""Loading so slowly that inertia does not matter: a rigid footing, and strength reduced until the ground fails."""

import math

import numpy as np

from solver import observables
from solver._jit import kernel
from solver.geometry import Surface, fill_ground, slope_surface
from solver.gravity import LOCAL_DAMPING, in_situ_state, unbalanced_share
from solver.mean_dilation import pool_all_pressure, spread_pooled
from solver.basis import half_length_in_cells
from solver.model import STANDARD_GRAVITY, Model, make_soil
from solver.particles import copy_particles
from solver.step import (STRESS_UPDATES, Scheme, accelerate, advance, allocate_workspace, deform, deform_mean,
                         solve_momentum, spread_all)
from solver.timestep import stable_step


def damped_model(surface, cell, unit_weight, friction_angle=0.0, variant=0, ppc=4, basis="gimp", E=1e8, nu=0.3, courant=0.5):
    return Model(surface, unit_weight / STANDARD_GRAVITY, nu, make_soil(E, nu, 0.0, 0.0, 0.0, 0.0, False), cell, ppc,
        half_length_in_cells(basis, ppc), Scheme(STRESS_UPDATES["musl"], 1.0, LOCAL_DAMPING, variant), courant, 0.0)


@kernel
def push(particles, grid, work, soil, scheme, nodes, rough, velocity, dt, steps):
    """Move the surface ``nodes`` down at ``velocity``; return the mean force in N/m that it takes."""
    reaction = 0.0
    if scheme.mean_dilation:
        pool_all_pressure(particles, grid, work, scheme.mean_dilation)
        spread_pooled(particles, grid, work, scheme.mean_dilation)
    else:
        spread_all(particles, grid, work)
    for _ in range(steps):
        solve_momentum(grid, 0.0, scheme.damping, dt)
        for n in nodes:
            if grid.mass[n] > 1e-12:
                reaction += grid.force[n, 1]
                grid.acceleration[n, 1] = (-velocity - grid.momentum[n, 1] / grid.mass[n]) / dt
                grid.velocity[n, 1] = -velocity
                if rough:
                    grid.acceleration[n, 0] = -grid.momentum[n, 0] / grid.mass[n] / dt
                    grid.velocity[n, 0] = 0.0
        if not accelerate(particles, grid, work, scheme, 0.0, dt):
            return np.nan
        for n in nodes:
            grid.remapped[n, 1] = -velocity
            if rough:
                grid.remapped[n, 0] = 0.0
        if scheme.mean_dilation:
            if not deform_mean(particles, grid, work, soil, scheme, 0.0, dt):
                return np.nan
        elif not deform(particles, grid, work, soil, scheme, 0.0, dt):
            return np.nan
    return reaction / steps


def footing(cells, rough=True, settlement=0.02, samples=40, steps_per_sample=500, E_over_c=2000.0, **kw):
    """Half footing of ``cells`` cells; B/2 = 1 m * ... returns settlement/B and pressure/c arrays (nominal width)."""
    c = 1e4
    h = 1.0 / cells  # B/2 = 1 m
    width, depth = 4.0, 2.0
    surface = Surface(np.array([0.0, width]), np.array([depth, depth]))
    model = damped_model(surface, h, 20e3, E=E_over_c * c, **kw)
    p = fill_ground(surface, h, model.particles_per_cell, model.density)
    p.cohesion[:] = c
    grid = model.allocate_grid()
    work = allocate_workspace(p.x.size)
    top = round(depth / h) + 2
    nodes = np.array([(top + j) * grid.columns + 2 + i for j in (0, 1) for i in range(-2, cells + 1)])
    dt = stable_step(model.courant, h, model.wave_speed, 0.0)
    total = settlement * 2.0
    velocity = total / (samples * steps_per_sample * dt)
    s, q = [], []
    for k in range(samples):
        f = push(p, grid, work, model.soil, model.scheme, nodes, rough, velocity, dt, steps_per_sample)
        s.append((k + 0.5) / samples * settlement)
        q.append(f / c)  # over B/2 = 1
    return np.array(s), np.array(q), p


def factor_of_safety(model, cohesion, friction_angle, first, step=0.01, most=3.0, verbose=False, start=None,
                     checks=300, steps=100, far=None, tolerance=2e-4):
    """Return the last factor (by ratio 1+step) at which the ground comes to rest."""
    p = in_situ_state(model) if start is None else copy_particles(start)
    origin = copy_particles(p)
    grid = model.allocate_grid(); work = allocate_workspace(p.x.size)
    dt = stable_step(model.courant, model.cell_size, model.wave_speed, 0.0)
    H = model.surface.top - model.surface.y[-1]; K = model.soil.bulk_modulus; G = model.soil.shear_modulus
    far = far or 2.0 * model.density * STANDARD_GRAVITY * H**2 * (3 * K + G) / (9 * K * G)
    factor, stable = first, 0.0
    log = []
    while factor < most:
        p.cohesion[:] = cohesion / factor
        p.friction_angle[:] = math.atan(math.tan(friction_angle) / factor)
        before = copy_particles(p)
        rest = False
        for k in range(checks):
            advance(p, grid, work, model.soil, model.scheme, STANDARD_GRAVITY, 0.0, dt, steps)
            u = unbalanced_share(grid, STANDARD_GRAVITY)
            moved = observables.displacement(p, before).max()
            if u < tolerance and k > 0:
                rest = True; break
            if moved > far:
                break
        log.append((factor, u, moved, observables.displacement(p, origin).max(), k))
        if verbose:
            print("  F %.4f u %.1e moved %.4f total %.4f checks %d KE %.2g" % (*log[-1], observables.resolved_kinetic_energy(grid)), flush=True)
        if not rest:
            break
        stable = factor
        factor *= 1 + step
    return stable, log, p
