"""Random fields on a box of 6 x 3 m, small enough to draw thousands of them, and what is expected of their moments."""

from math import log, radians, sqrt

import numpy as np

from campaign.scene.scene import Scene
from campaign.scene.sections import Cohesion, FrictionAngle, Geometry, RandomField, Softening, Soil
from campaign.simulation.scene_sampler import strength_sampler

COHESION = Cohesion.model_construct(mean=20e3, cov=0.3, residual=10e3)
FRICTION = FrictionAngle.model_construct(mean=radians(20.0), cov=0.2, residual=radians(12.0))
BOX = Geometry.model_construct(surface=((0.0, 3.0), (5.9, 3.0), (6.0, 2.9)))
"""Of the field, with a kink that makes it a slope."""

REALIZATIONS = 2000
DEVIATIONS = 4.0
"""Tolerance in standard errors; a Gaussian estimate is further out with a probability of 6.3e-5."""


def box_scene(cohesion=COHESION, friction_angle=FRICTION, **changes):
    """Return what a sampler reads of a scene, in SI and without the checks of a file."""
    values = {
        "correlation": "exponential",
        "horizontal": 4.0,
        "vertical": 1.0,
        "length_kind": "autocorrelation-distance",
        "cross_correlation": -0.5,
        "resolution": 0.5,
    }
    field = RandomField.model_construct(**values | changes)
    softening = Softening.model_construct(law="exponential")
    soil = Soil.model_construct(cohesion=cohesion, friction_angle=friction_angle, softening=softening)
    return Scene.model_construct(soil=soil, field=field, geometry=BOX)


def small_sampler(*strengths, **changes):
    return strength_sampler(box_scene(*strengths, **changes), 6.0, 3.0)


def draws(sampler, n=REALIZATIONS):
    """Return the properties of many realizations, each of shape (n, ny, nx), in the order of the table."""
    return np.stack([sampler.draw(7, k).values for k in range(n)], axis=1)


def standard(values, marginal):
    """Undo eq. (5), with its constants written out, to get standard Gaussian values."""
    variance = log(1.0 + marginal.cov**2)
    return (np.log(values) - (log(marginal.mean) - variance / 2.0)) / sqrt(variance)


def assert_mean(per_realization, expected):
    """Independent realizations: the mean is within 4 standard errors, which the sample itself estimates."""
    error = np.std(per_realization, ddof=1) / sqrt(len(per_realization))
    assert abs(np.mean(per_realization) - expected) < DEVIATIONS * error
