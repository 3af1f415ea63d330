"""Run-outs that are known functions of layered random soil on a coarse map."""

import numpy as np

ROWS, COLUMNS = 5, 8
HORIZONTAL, VERTICAL = 6.0, 1.5


def maps(n, seed, properties=2):
    """Return n maps of the logarithm of properties, (n, property, row, column); without ground in one corner."""
    places = np.indices((ROWS, COLUMNS)).reshape(2, -1)
    apart = np.abs(places[:, :, None] - places[:, None, :])
    factor = np.linalg.cholesky(np.exp(-np.hypot(apart[0] / VERTICAL, apart[1] / HORIZONTAL)))
    drawn = 0.1 * np.random.default_rng(seed).normal(size=(n, properties, ROWS * COLUMNS)) @ factor.T
    shaped = drawn.reshape(n, properties, ROWS, COLUMNS)
    shaped[:, :, -1, -3:] = np.nan
    return shaped


def slopes():
    """Return the change of the run-out in m per unit of the logarithm: the first property counts, in two places."""
    slope = np.zeros((2, ROWS, COLUMNS))
    slope[0, 1:3, 2:5] = -2.0
    slope[0, 0, 2:5] = 3.0
    return slope


def runouts(field_map, noise, seed):
    """Return the run-outs (m) that belong to maps."""
    signal = np.einsum("nprc,prc->n", np.nan_to_num(field_map), slopes())
    return 10.0 + signal + noise * np.random.default_rng(seed).normal(size=len(signal))
