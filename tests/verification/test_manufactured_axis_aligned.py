import numpy as np
from driver import *
from solver.particles import allocate_particles

E, NU, RHO, A = 1e3, 0.3, 1e3, 0.05
lam = E * NU / (1 + NU) / (1 - 2 * NU)
mu = E / 2 / (1 + NU)
W = np.pi * np.sqrt(E / RHO)


def solve(cells, half_length=0.25, courant=0.3, scheme=MUSL, A=A, T=1.0):
    h = 1.0 / cells
    X, Y = lattice(1.0, 1.0, h / 2)
    P = allocate_particles(X, Y, h * h / 4, RHO)
    g = grid_with_rollers(1.0, 1.0, h, half_length)

    def st(t):
        a = A * np.sin(W * t)
        b = -a
        return (
            X + a * np.sin(np.pi * X),
            Y + b * np.sin(np.pi * Y),
            1 + np.pi * a * np.cos(np.pi * X),
            1 + np.pi * b * np.cos(np.pi * Y),
        )

    def bf(t):
        x, y, Fx, Fy = st(t)
        a = A * np.sin(W * t)
        b = -a
        FxX = -(np.pi**2) * a * np.sin(np.pi * X)
        FyY = -(np.pi**2) * b * np.sin(np.pi * Y)
        att = -(W**2) * a
        btt = -(W**2) * b
        M = lam + 2 * mu
        return att * np.sin(np.pi * X) - M * Fy * FxX / (RHO * Fx), btt * np.sin(np.pi * Y) - M * Fx * FyY / (RHO * Fy)

    cp = np.sqrt((lam + 2 * mu) / RHO)
    steps = int(np.ceil(T * cp / (courant * h)))
    dt = T / steps
    P.velocity_x[:] = A * W * np.sin(np.pi * X) * np.cos(W * dt / 2)
    P.velocity_y[:] = -A * W * np.sin(np.pi * Y) * np.cos(W * dt / 2)
    du = []
    ds = []

    def obs(t):
        x, y, Fx, Fy = st(t)
        du.append(np.mean((P.x - x) ** 2 + (P.y - y) ** 2))
        sx = (lam + 2 * mu) * np.log(Fx) + lam * np.log(Fy)
        ds.append(np.mean((P.stress_xx - sx) ** 2))

    march(P, g, elastic_soil(E, NU), scheme, dt, steps, bf, obs)
    return np.sqrt(np.mean(du)) / A, np.sqrt(np.mean(ds)) / (E * np.pi * A)


if __name__ == "__main__":
    import time

    for hl in (0.25, 0.5, 1e-6):
        for cr in (0.3,):
            for n in ("musl", "usf", "usl"):
                t = time.time()
                e = np.array([solve(c, hl, cr, Scheme(STRESS_UPDATES[n], 1.0, 0.0)) for c in (8, 16, 32, 64)])
                print(hl, cr, n, e.T, observed_orders(e[:, 0]), observed_orders(e[:, 1]), time.time() - t)
    for cr in (0.1, 0.3, 0.6):
        print(cr, [solve(32, 0.25, cr) for _ in (1,)])
    for a in (1e-4, 0.01):
        e = np.array([solve(c, A=a) for c in (8, 16, 32, 64)])
        print(a, e.T, observed_orders(e[:, 0]), observed_orders(e[:, 1]))
