"""From the identity of a realization to its random numbers, without any state.

Realization k of a campaign is the same wherever and whenever it is computed, because its stream depends on nothing but
the campaign's seed, the purpose of the numbers and k.
"""

from enum import IntEnum

import numpy as np

BASELINE = -1
"""The realization that draws nothing: mean strengths everywhere."""


class Stream(IntEnum):
    """What random numbers are for; the values are part of every stored campaign and never change."""

    FIELD = 0
    BOOTSTRAP = 1
    LAYER = 2
    NOISE = 3


def generator(campaign_seed: int, stream: Stream, realization: int, layer: int = 0) -> np.random.Generator:
    """Open the random stream of one realization.

    Parameters
    ----------
    campaign_seed : int
        Seed of the campaign, zero or more.
    stream : Stream
        Purpose of the numbers.
    realization : int
        Identity of the realization, zero or more.
    layer : int
        Number of the layer whose numbers they are, from 1; 0 for what layers have in common.

    Returns
    -------
    numpy.random.Generator
        Counter-based Philox generator at the start of its stream.

    Raises
    ------
    ValueError
        If the seed or the realization is negative; the baseline has no stream.

    Notes
    -----
    A spawn key built from (stream, k) equals the k-th spawned child but needs no counter, so that any subset of
    realizations can be computed in any order. Salmon et al. (2011), doi:10.1145/2063384.2063405, for Philox.
    """
    if campaign_seed < 0 or realization < 0:
        raise ValueError(
            f"Seed {campaign_seed} and realization {realization} do not name a random stream; both must be >= 0."
        )
    sequence = np.random.SeedSequence(campaign_seed, spawn_key=(int(stream), realization, *([layer] if layer else [])))
    return np.random.Generator(np.random.Philox(sequence))
