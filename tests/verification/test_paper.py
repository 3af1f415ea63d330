"""The Monte-Carlo table of Ma, Rezania and Mousavi Nezhad (section 3.2), against a smaller campaign of its scene."""

import numpy as np
import pytest
from scipy import stats

from campaign.scene import load_scene
from campaign.simulation.ground import prepare

MEAN, STD, EXCEEDANCE, DETERMINISTIC = 10.80, 0.51, 0.52, 10.78
REALIZATIONS = 60


@pytest.mark.slow
def test_mean_scatter_and_exceedance_are_the_papers():
    """False alarms: 0.1 % of means and of probabilities, and 0.5 % of standard deviations.

    Samples of 60 are compared with the paper's of 1000 at 99.9 %. 1000 realizations of ours have a standard deviation
    of 0.58 m (0.55 to 0.61), and the bound on that of 60 allows for the 14 % between it and the paper's.
    """
    ground = prepare(load_scene("ma2023-printed"))
    runout = np.array([ground.simulate(k).values["final_runout"] for k in range(REALIZATIONS)])
    error = STD * np.sqrt(1.0 / REALIZATIONS + 1.0 / 1000)
    assert abs(runout.mean() - MEAN) < stats.norm.isf(0.0005) * error
    error = np.sqrt(EXCEEDANCE * (1.0 - EXCEEDANCE) * (1.0 / REALIZATIONS + 1.0 / 1000))
    assert abs(np.mean(runout > DETERMINISTIC) - EXCEEDANCE) < stats.norm.isf(0.0005) * error + 0.5 / REALIZATIONS
    ratio = 1.14 * np.sqrt(stats.chi2.isf([0.9975, 0.0025], REALIZATIONS - 1) / (REALIZATIONS - 1))
    assert ratio[0] < runout.std(ddof=1) / STD < ratio[1]
