import numpy as np
from driver import *
from solver.particles import allocate_particles

E, NU, RHO = 1e3, 0.3, 1e3
mu = E / 2 / (1 + NU)
lam = E * NU / (1 + NU) / (1 - 2 * NU)
T = 1.0
C = 1.5


def h0(R):
    s = R - 1
    return 1 - 32 * s**2 + 256 * s**4


def h1(R):
    s = R - 1
    return -64 * s + 1024 * s**3


def h2(R):
    s = R - 1
    return -64 + 3072 * s**2


def solve(n, A=0.2, half_length=0.25, courant=0.3, scheme=MUSL, end=1.0, embed=False):
    h = 1.0 / n
    x, y = lattice(2 * C, 2 * C, h / 2)
    X, Y = x - C, y - C
    R = np.hypot(X, Y)
    k = (R > 0.75) & (R < 1.25)
    keep = k if not embed else R < 1.45
    x, y, X, Y, R, k = [a[keep] for a in (x, y, X, Y, R, k)]
    Th = np.arctan2(Y, X)
    P = allocate_particles(x, y, h * h / 4, RHO)
    g = grid_without_walls(2 * C, 2 * C, h, half_length)
    H0, H1, H2 = [np.where(k, f(R), 0.0) for f in (h0, h1, h2)]
    w = 2 * np.pi / T

    def bf(t):
        G = A * (1 - np.cos(w * t)) / 2
        Gt = A * w * np.sin(w * t) / 2
        Gtt = A * w * w * np.cos(w * t) / 2
        gam = R * G * H1
        gp = G * H1 + R * G * H2
        br = -R * (Gt * H0) ** 2 + mu / RHO * (np.sin(gam) * gp + 2 * (1 - np.cos(gam)) / R)
        bt = R * Gtt * H0 - mu / RHO * (np.cos(gam) * gp + 2 * np.sin(gam) / R)
        th = Th + G * H0
        return br * np.cos(th) - bt * np.sin(th), br * np.sin(th) + bt * np.cos(th)

    cp = np.sqrt((lam + 2 * mu) / RHO)
    steps = int(np.ceil(end * T * cp / (courant * h)))
    dt = end * T / steps
    # v(-dt/2)
    Gt = -A * w * np.sin(w * dt / 2) / 2
    P.velocity_x[:] = -Gt * H0 * Y
    P.velocity_y[:] = Gt * H0 * X
    du = []
    ds = []

    def obs(t):
        G = A * (1 - np.cos(w * t)) / 2
        th = Th + G * H0
        du.append(np.mean((P.x - C - R * np.cos(th)) ** 2 + (P.y - C - R * np.sin(th)) ** 2))
        gam = R * G * H1
        rt = mu * np.sin(gam)
        rr = -mu * (1 - np.cos(gam))
        c2, s2 = np.cos(2 * th), np.sin(2 * th)
        sxy = rr * s2 + rt * c2
        sxx = rr * c2 - rt * s2
        ds.append(np.mean((P.stress_xy - sxy) ** 2 + (P.stress_xx - sxx) ** 2))

    march(P, g, elastic_soil(E, NU), scheme, dt, steps, bf, obs)
    return np.sqrt(np.mean(du)) / A, np.sqrt(np.mean(ds)) / mu / A, np.sqrt(du[-1]) / A


if __name__ == "__main__":
    import time

    for A in (1e-3, 0.05, 0.2):
        for emb in (False, True):
            for n in ("musl",):
                t = time.time()
                e = np.array(
                    [solve(c, A, 0.25, 0.3, Scheme(STRESS_UPDATES[n], 1.0, 0.0), embed=emb) for c in (8, 16, 32, 64)]
                )
                print(A, emb, n, e.T, *[observed_orders(e[:, q]) for q in range(3)], time.time() - t, flush=True)
    A = 0.2
    for hl in (0.5, 1e-6):
        e = np.array([solve(c, A, hl) for c in (8, 16, 32)])
        print(A, hl, e.T, *[observed_orders(e[:, q]) for q in range(2)])
    for n in ("usl", "usf"):
        e = np.array([solve(c, A, 0.25, 0.3, Scheme(STRESS_UPDATES[n], 1.0, 0.0)) for c in (8, 16, 32)])
        print(A, n, e.T, *[observed_orders(e[:, q]) for q in range(2)])
    for cr in (0.1, 0.6):
        print(cr, solve(32, A, courant=cr))
