"""Random streams: the same numbers for the same name, for ever."""

import numpy as np
import pytest

from campaign.seeds import Stream, generator

FIELD_0 = [0.665726953196, -0.054268916406, 0.147392300891, 0.886813930703]
FIELD_999 = [-1.899580509118, -0.113191355845, -1.160309402067, 0.176753154285]


def test_stream_is_stable():
    """Stored campaigns can be continued only while these numbers stay; NumPy does not promise it (NEP 19)."""
    assert generator(2023, Stream.FIELD, 0).standard_normal(4).round(12).tolist() == FIELD_0
    assert generator(2023, Stream.FIELD, 999).standard_normal(4).round(12).tolist() == FIELD_999


def test_stream_is_the_spawned_child_of_its_seed():
    """A spawn key (stream, k) names the k-th child of the stream-th child, without the counter of `spawn`."""
    child = np.random.SeedSequence(2023).spawn(2)[Stream.BOOTSTRAP].spawn(6)[5]
    expected = np.random.Generator(np.random.Philox(child)).standard_normal(8)
    assert np.array_equal(generator(2023, Stream.BOOTSTRAP, 5).standard_normal(8), expected)


def test_no_two_realizations_share_a_number():
    """200 x 100 normals of 53 bits collide by chance with a probability below 1e-7."""
    drawn = [generator(1, stream, k).standard_normal(100) for stream in Stream for k in range(100)]
    assert np.unique(drawn).size == np.size(drawn)


@pytest.mark.parametrize(("seed", "realization"), [(-1, 0), (0, -1)])
def test_negative_numbers_name_no_stream(seed, realization):
    with pytest.raises(ValueError, match="must be >= 0"):
        generator(seed, Stream.FIELD, realization)
