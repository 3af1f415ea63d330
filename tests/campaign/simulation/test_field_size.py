"""The memory of a random field is bounded without building its sampler."""

import pytest

from campaign.fields.correlation import KERNELS, Correlation
from campaign.fields.embedding import circulant_bytes
from campaign.fields.reference_grid import ReferenceGrid
from campaign.fields.samplers import CirculantSampler
from campaign.scene import load_scene
from campaign.simulation.field_size import field_size, perhaps_too_large, too_large


@pytest.mark.parametrize("angle", [0.0, 0.3])
@pytest.mark.parametrize("lengths", [(3.0, 3.0), (60.0, 2.0), (60.0, 15.0), (100.0, 4.0)])
@pytest.mark.parametrize("kind", KERNELS)
def test_the_sampler_takes_what_is_foreseen(kind, lengths, angle):
    """Within 10 %, by which a period is longer than needed to be fast to transform."""
    correlation, grid = Correlation(kind, *lengths, angle), ReferenceGrid(1.0, (15, 60))
    rows, columns = CirculantSampler(correlation, grid.shape, 1.0).torus
    least, most = circulant_bytes(correlation, grid.shape, (1.0, 1.0))
    assert least <= 64 * rows * columns <= 1.1 * most


@pytest.mark.parametrize(
    ("overrides", "is_too_large", "is_perhaps_too_large"),
    [
        ([], False, False),
        (["field.resolution=1 mm"], True, False),
        (["field.resolution=1e-8 m"], True, False),
        (["field.horizontal=1000 m", "field.vertical=1000 m"], False, False),
        (["field.horizontal=300 m", "field.vertical=300 m"], False, True),
        (["field.horizontal=1e4 m"], False, False),
        (["field.horizontal=1000 m", "field.vertical=1000 m", "field.correlation=separable-exponential"], False, False),
        (["field.sampler=cholesky", "field.resolution=5 cm"], True, False),
    ],
)
def test_a_field_beyond_the_limit_is_refused_before_it_is_built(overrides, is_too_large, is_perhaps_too_large):
    size = field_size(load_scene("ma2023", overrides))
    assert (too_large(size) is not None, perhaps_too_large(size) is not None) == (is_too_large, is_perhaps_too_large)
