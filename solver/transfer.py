"""Between particles and grid. Each function takes a block of particles and the stencil of their present places."""

from solver._jit import inlined


@inlined
def three(values, p):
    """Return the column ``p`` of a stencil array in registers, where stores to the grid cannot touch it."""
    return values[0, p], values[1, p], values[2, p]


@inlined
def particle_to_grid(particles, stress_xx, stress_yy, stress_xy, stencil, grid):
    """Add mass, momentum and internal force of a block of particles to the nodes.

    ``m_i += S_ip m_p``, ``(mv)_i += S_ip m_p v_p``, ``f_i -= V_p sigma_p . grad S_ip``.

    Parameters
    ----------
    particles : Particles (n,)
    stress_xx, stress_yy, stress_xy : ndarray (n,)
        The stress in Pa that pushes the nodes: that of the particles, or what takes its place.
    stencil : Stencil
        Weights of the particles.
    grid : Grid
        Its ``mass``, ``momentum`` and ``force`` are modified.
    """
    for p in range(particles.x.size):
        mass = particles.mass[p]
        momentum_x = mass * particles.velocity_x[p]
        momentum_y = mass * particles.velocity_y[p]
        xx = -particles.volume[p] * stress_xx[p]
        yy = -particles.volume[p] * stress_yy[p]
        xy = -particles.volume[p] * stress_xy[p]
        first = stencil.node[p]
        sx, sy, gx, gy = three(stencil.sx, p), three(stencil.sy, p), three(stencil.gx, p), three(stencil.gy, p)
        for j in range(3):
            for i in range(3):
                node = first + j * grid.columns + i
                s = sx[i] * sy[j]
                g_x = gx[i] * sy[j]
                g_y = sx[i] * gy[j]
                grid.mass[node] += s * mass
                grid.momentum[node, 0] += s * momentum_x
                grid.momentum[node, 1] += s * momentum_y
                grid.force[node, 0] += xx * g_x + xy * g_y
                grid.force[node, 1] += xy * g_x + yy * g_y


@inlined
def interpolate(field, stencil, p, columns):
    """Return ``sum_i S_ip field_i`` at particle ``p`` of a nodal vector field ``(nodes, 2)``, as (x, y)."""
    x = 0.0
    y = 0.0
    for j in range(3):
        for i in range(3):
            node = stencil.node[p] + j * columns + i
            s = stencil.sx[i, p] * stencil.sy[j, p]
            x += s * field[node, 0]
            y += s * field[node, 1]
    return x, y


@inlined
def gradient(field, stencil, p, columns):
    """Return ``sum_i field_i (x) grad S_ip`` at particle ``p`` of a field ``(nodes, 2)``, as (xx, xy, yx, yy)."""
    xx = 0.0
    xy = 0.0
    yx = 0.0
    yy = 0.0
    for j in range(3):
        for i in range(3):
            node = stencil.node[p] + j * columns + i
            g_x = stencil.gx[i, p] * stencil.sy[j, p]
            g_y = stencil.sx[i, p] * stencil.gy[j, p]
            xx += g_x * field[node, 0]
            xy += g_y * field[node, 0]
            yx += g_x * field[node, 1]
            yy += g_y * field[node, 1]
    return xx, xy, yx, yy


@inlined
def spread_mass(particles, stencil, grid):
    """Add ``S_ip m_p`` to the nodes."""
    for p in range(particles.x.size):
        first = stencil.node[p]
        sx, sy = three(stencil.sx, p), three(stencil.sy, p)
        for j in range(3):
            for i in range(3):
                grid.mass[first + j * grid.columns + i] += sx[i] * sy[j] * particles.mass[p]


@inlined
def spread_momentum(field, momentum_x, momentum_y, stencil, p, columns):
    """Add ``S_ip m_p v_p`` of particle ``p``, its momentum in kg/s, to a nodal vector field ``(nodes, 2)``."""
    first = stencil.node[p]
    sx, sy = three(stencil.sx, p), three(stencil.sy, p)
    for j in range(3):
        for i in range(3):
            node = first + j * columns + i
            s = sx[i] * sy[j]
            field[node, 0] += s * momentum_x
            field[node, 1] += s * momentum_y
