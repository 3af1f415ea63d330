"""One change of volume for all particles of a cell, against volumetric locking.

Soil that yields without dilation keeps its volume. uGIMP asks that of every particle, more often than the nodes have
freedom to move, and the ground grows too strong: limit loads have no plateau. As in the B-bar element (Nagtegaal, Parks
and Rice 1974, CMAME 4:153; Hughes 1980, IJNME 15:1413) the dilation of a particle gives way to the mean of its cell:

    theta_p = L_xx + L_yy,   theta_c = sum_p w_cp V_p theta_p / sum_p w_cp V_p
    Lbar_p  = L_p + 1/2 (A theta - theta)_p 1,   (A theta)_p = sum_c w_cp theta_c

``w_cp`` is the share of the particle's domain that lies in cell ``c``, so a particle changes cells as gently as its
weights do. Only the in-plane strain changes: plane strain stays plane. The internal force follows from virtual work.
With the in-plane mean stress ``P = (s_xx + s_yy) / 2``

    sum_p V_p s_p : Lbar_p = sum_p V_p (s_p : L_p + P_p (A theta - theta)_p) = sum_p V_p (s_p + (A P - P)_p 1) : L_p

because ``sum_p V_p P_p (A theta)_p = sum_c (sum_p w V P)(sum_p w V theta) / sum_p w V`` is symmetric in ``P`` and
``theta``. So the force takes the cell mean of ``P`` (not of the mean of three stresses), and the work ``s_p : Lbar_p``
of the stresses is the work that the nodes see. With the particles' own ``P`` in the force a slide gains a third of the
energy that gravity gives it.

The arrays of cells are numbered like the nodes: a cell has the number of its lower left corner.
"""

from solver._jit import law
from solver.particles import Particles

_NO_VOLUME = 1e-12  # m2: an empty cell


@law
def overlap(x, grid):
    """Return the first cell that a particle's domain touches along one axis, and the share that lies in the next."""
    xi = (x - grid.origin) / grid.cell_size
    first = int(xi - grid.half_length)
    beyond = xi + grid.half_length - (first + 1)
    return first, min(1.0, max(0.0, beyond / (2.0 * grid.half_length)))


@law
def pool(sums, value, x, y, grid):
    """Add ``w_cp value`` of a particle to the cells."""
    i, right = overlap(x, grid)
    j, upper = overlap(y, grid)
    cell = j * grid.columns + i
    sums[cell] += (1.0 - right) * (1.0 - upper) * value
    sums[cell + 1] += right * (1.0 - upper) * value
    sums[cell + grid.columns] += (1.0 - right) * upper * value
    sums[cell + grid.columns + 1] += right * upper * value


@law
def read(means, x, y, grid):
    """Return ``sum_c w_cp mean_c`` for a particle."""
    i, right = overlap(x, grid)
    j, upper = overlap(y, grid)
    cell = j * grid.columns + i
    below = (1.0 - right) * means[cell] + right * means[cell + 1]
    above = (1.0 - right) * means[cell + grid.columns] + right * means[cell + grid.columns + 1]
    return (1.0 - upper) * below + upper * above


@law
def clear_cells(grid):
    """Empty the cells before particles are pooled."""
    grid.cell_volume[:] = 0.0
    grid.cell_dilation[:] = 0.0
    grid.cell_pressure[:] = 0.0


@law
def average(sums, grid):
    """Turn sums over cells into means, and forget the volumes they were weighted with."""
    for c in range(sums.size):
        volume = grid.cell_volume[c]
        sums[c] = sums[c] / volume if volume > _NO_VOLUME else 0.0
        grid.cell_volume[c] = 0.0


@law
def pool_dilation(particles, increment, grid):
    """Add volume and dilation of the block to the cells."""
    for p in range(particles.x.size):
        volume = particles.volume[p]
        dilation = increment[0, p] + increment[3, p]
        pool(grid.cell_volume, volume, particles.x[p], particles.y[p], grid)
        pool(grid.cell_dilation, volume * dilation, particles.x[p], particles.y[p], grid)


@law
def replace_dilation(particles, increment, grid):
    """Give the displacement gradients of the block the dilation of their cells."""
    for p in range(particles.x.size):
        mean = read(grid.cell_dilation, particles.x[p], particles.y[p], grid)
        correction = 0.5 * (mean - increment[0, p] - increment[3, p])
        increment[0, p] += correction
        increment[3, p] += correction


@law
def pool_pressure(particles, grid):
    """Add volume and in-plane mean stress of the block to the cells."""
    for p in range(particles.x.size):
        volume = particles.volume[p]
        mean_stress = 0.5 * (particles.stress_xx[p] + particles.stress_yy[p])
        pool(grid.cell_volume, volume, particles.x[p], particles.y[p], grid)
        pool(grid.cell_pressure, volume * mean_stress, particles.x[p], particles.y[p], grid)


@law
def with_cell_pressure(particles, scratch, grid):
    """Return the block with the in-plane mean stress of its cells; its normal stresses lie in ``scratch``."""
    count = particles.x.size
    for p in range(count):
        mean = read(grid.cell_pressure, particles.x[p], particles.y[p], grid)
        half_difference = 0.5 * (particles.stress_xx[p] - particles.stress_yy[p])
        scratch[0, p] = mean + half_difference
        scratch[1, p] = mean - half_difference
    return Particles(
        particles.x,
        particles.y,
        particles.velocity_x,
        particles.velocity_y,
        particles.mass,
        particles.volume,
        scratch[0, :count],
        scratch[1, :count],
        particles.stress_zz,
        particles.stress_xy,
        particles.plastic_strain,
        particles.cohesion,
        particles.friction_angle,
    )
