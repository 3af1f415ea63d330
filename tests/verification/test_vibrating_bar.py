import numpy as np
from driver import *
from solver.particles import allocate_particles
from solver.step import advance


def vibrate(cells=25, amplitude_cells=0.16, courant=0.3, scheme=MUSL, periods=5, half_length=0.25):
    L = 25.0
    E = 100.0
    rho = 1.0
    h = L / cells
    c = np.sqrt(E / rho)
    X, y = lattice(L, h, h / 2)
    bar = allocate_particles(X, y + 2 * h, h * h / 4, rho)
    grid = grid_without_walls(L + 4 * h, 5 * h, h, half_length)
    i, j = node_indices(grid)
    grid.free_x[i <= 0] = 0.0
    grid.free_y[:] = 0.0
    w = np.pi * c / (2 * L)
    A = amplitude_cells * 25 / 25.0
    mode = np.sin(np.pi * X / 2 / L)
    dt = courant * h / c
    steps = int(round(periods * 2 * np.pi / w / dt))
    dt = periods * 2 * np.pi / w / steps
    bar.velocity_x[:] = A * w * mode * np.cos(w * dt / 2)
    soil = elastic_soil(E, 0.0)
    work = allocate_workspace(X.size)
    rec = []

    def strain_energy():
        return 0.5 * np.sum(bar.volume * bar.stress_xx**2 / E)

    from solver import observables as o

    for k in range(steps):
        v0 = bar.velocity_x.copy()
        advance(bar, grid, work, soil, scheme, 0.0, 0.0, dt, 1)
        t = (k + 1) * dt
        err = bar.x - X - A * np.sin(w * t) * mode
        vm = 0.5 * (v0 + bar.velocity_x)
        rec.append(
            (
                t,
                np.sqrt(np.mean(err**2)) / A,
                np.sum((bar.x - X) * mode) / np.sum(mode**2) / A,
                0.5 * np.sum(bar.mass * vm**2),
                work.ledger[0],
                strain_energy(),
                o.kinetic_energy(bar),
            )
        )
    return np.array(rec), 0.5 * np.sum(bar.mass * (A * w * mode) ** 2)


if __name__ == "__main__":
    for a in (0.01, 0.16, 1.2):
        for c in (0.1, 0.3, 0.5, 0.7):
            for n, s in STRESS_UPDATES.items():
                r, E0 = vibrate(amplitude_cells=a, courant=c, scheme=Scheme(s, 1.0, 0.0))
                up = r[:-1, 2]
                z = np.flatnonzero((r[:-1, 2] < 0) & (r[1:, 2] >= 0))
                zz = [r[k, 0] - r[k, 2] * (r[k + 1, 0] - r[k, 0]) / (r[k + 1, 2] - r[k, 2]) for k in z]
                T = np.diff(zz).mean() if len(zz) > 1 else np.nan
                tot = r[:, 3] + r[:, 4]
                n5 = len(r) // 10
                print(
                    a,
                    c,
                    n,
                    "rms",
                    np.sqrt(np.mean(r[:, 1] ** 2)).round(4),
                    "period",
                    T / (4 * 25 / 10.0) - 1,
                    "dE",
                    (tot[-n5:].mean() / E0 - 1).round(5),
                    ((r[-n5:, 3] + r[-n5:, 5]).mean() / E0 - 1).round(5),
                    "amp",
                    np.abs(r[-n5:, 2]).max(),
                )
