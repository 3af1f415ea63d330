"""Random fields of strength as campaigns draw them: moments, cross-correlation and correlation in space.

Autocorrelation distances of 20 m and 2 m over ground of 60 x 15 m, coefficients of variation of 0.1, a correlation of
-0.5 between the Gaussian fields: the numbers of Ma, Rezania and Mousavi Nezhad (2022). The formulas are written out
here. Realizations are independent, so each estimate comes with its standard error; one that is more than four of them
away happens by chance with a probability of 6.3e-5, one of all in the table with one in a thousand.
"""

import numpy as np
import pytest
from driver import Row

from campaign.scene.scene import Scene
from campaign.scene.sections import Cohesion, FrictionAngle, Geometry, RandomField, Softening, Soil
from campaign.simulation.scene_sampler import strength_sampler

COHESION = Cohesion.model_construct(mean=20e3, cov=0.1)
FRICTION = FrictionAngle.model_construct(mean=np.radians(10.0), cov=0.1)
HORIZONTAL, VERTICAL, RESOLUTION = 20.0, 2.0, 0.5  # m
CROSS_CORRELATION, REALIZATIONS, STANDARD_ERRORS = -0.5, 1000, 4.0
KERNELS = {
    "exponential": lambda u, v: np.exp(-np.hypot(u, v)),
    "separable-exponential": lambda u, v: np.exp(-u - v),
    "squared-exponential": lambda u, v: np.exp(-(u**2) - v**2),
}
LAGS = ((20.0, 0.0), (0.0, 2.0), (10.0, 1.0))  # m


def draw_all(kernel):
    """Return cohesion and friction angle (realizations, rows, columns)."""
    field = RandomField.model_construct(
        correlation=kernel,
        horizontal=HORIZONTAL,
        vertical=VERTICAL,
        length_kind="autocorrelation-distance",
        cross_correlation=CROSS_CORRELATION,
        resolution=RESOLUTION,
    )
    softening = Softening.model_construct(law="none")
    soil = Soil.model_construct(cohesion=COHESION, friction_angle=FRICTION, softening=softening)
    ground = Geometry.model_construct(surface=((0.0, 15.0), (59.0, 15.0), (60.0, 14.0)))
    sampler = strength_sampler(Scene.model_construct(soil=soil, field=field, geometry=ground), 60.0, 15.0)
    drawn = [sampler.draw(11, k) for k in range(REALIZATIONS)]
    return np.array([field["cohesion"] for field in drawn]), np.array([field["friction_angle"] for field in drawn])


def standard(values, marginal):
    """Return the standard Gaussian values behind lognormal ones."""
    variance = np.log(1.0 + marginal.cov**2)
    return (np.log(values / marginal.mean) + 0.5 * variance) / np.sqrt(variance)


def estimates(kernel):
    """Yield name, expected value, and its estimate from each realization (realizations,)."""
    cohesion, friction = draw_all(kernel)
    for name, values, marginal in (("cohesion", cohesion, COHESION), ("friction angle", friction, FRICTION)):
        relative = values / marginal.mean
        yield f"mean of {name} over the target", 1.0, relative.mean(axis=(1, 2))
        yield f"variance of {name} over the mean squared", marginal.cov**2, ((relative - 1.0) ** 2).mean(axis=(1, 2))
    z, other = standard(cohesion, COHESION), standard(friction, FRICTION)
    yield "cross-correlation", CROSS_CORRELATION, (z * other).mean(axis=(1, 2))
    for right, up in LAGS:
        columns, rows = round(right / RESOLUTION), round(up / RESOLUTION)
        pairs = z[:, rows:, columns:] * z[:, : z.shape[1] - rows, : z.shape[2] - columns]
        expected = KERNELS[kernel](right / HORIZONTAL, up / VERTICAL)
        yield f"correlation at a lag of {right:g} m, {up:g} m", expected, pairs.mean(axis=(1, 2))


def mean_and_error(per_realization):
    """Return the estimate and its standard error."""
    return per_realization.mean(), per_realization.std(ddof=1) / np.sqrt(per_realization.size)


@pytest.mark.parametrize("kernel", KERNELS)
def test_moments_and_correlations_are_those_asked_for(kernel):
    """False alarm: 8 x 6.3e-5 for each kernel."""
    for name, expected, per_realization in estimates(kernel):
        estimate, error = mean_and_error(per_realization)
        assert abs(estimate - expected) < STANDARD_ERRORS * error, name


def rows():
    table = []
    for kernel in KERNELS:
        for name, expected, per_realization in estimates(kernel):
            estimate, error = mean_and_error(per_realization)
            deviation = (estimate - expected) / error
            table.append(
                Row(
                    f"{kernel}: {name}",
                    f"{expected:.5f}",
                    f"{estimate:.5f} ± {error:.5f}",
                    f"{deviation:+.1f} standard errors",
                    abs(deviation) < STANDARD_ERRORS,
                )
            )
    return table
