"""Samplers are linear maps A of white noise: that A A^T is the correlation matrix needs no statistics to check."""

import pickle

import numpy as np
import pytest

from campaign.errors import SamplerError
from campaign.fields import samplers
from campaign.fields.cholesky import CholeskySampler
from campaign.fields.correlation import KERNELS, Correlation
from campaign.fields.samplers import CirculantSampler, KroneckerSampler

ROWS, COLUMNS, SPACING = 5, 7, 0.5
X, Y = SPACING * (np.arange(COLUMNS) + 0.5), SPACING * (np.arange(ROWS) + 0.5)
POINTS = [axis.ravel() for axis in np.meshgrid(X, Y)]
KEPT = Correlation("exponential", 1.5, 0.6, 0.3)


def correlation_matrix(correlation, x, y):
    """Correlation of each pair of points, pair by pair."""
    return np.array(
        [[float(correlation(a - c, b - d)) for c, d in zip(x, y, strict=True)] for a, b in zip(x, y, strict=True)]
    )


def covariance(sampler, noise_shape):
    """Return A A^T of both fields together, from the image of each unit vector of noise."""
    size = int(np.prod(noise_shape))
    images = np.array([sampler.correlate(unit.reshape(noise_shape)).ravel() for unit in np.eye(size)])
    return images.T @ images


def assert_two_independent_fields(sampler, noise_shape, correlation):
    expected = np.kron(np.eye(2), correlation_matrix(correlation, *POINTS))
    np.testing.assert_allclose(covariance(sampler, noise_shape), expected, rtol=0.0, atol=1e-10)


@pytest.mark.parametrize("angle", [0.0, np.pi])
@pytest.mark.parametrize("kind", ["separable-exponential", "squared-exponential"])
def test_kronecker_is_exact(kind, angle):
    """Also for the squared exponential with 8 cells per distance, whose matrix is numerically singular."""
    correlation = Correlation(kind, 8.0, 4.0, angle)
    sampler = KroneckerSampler(correlation, X, Y)
    assert sampler.clip_mass < 1e-13
    assert_two_independent_fields(sampler, (2, ROWS, COLUMNS), correlation)


@pytest.mark.parametrize("angle", [0.0, 0.5, -0.5])
@pytest.mark.parametrize("kind", KERNELS)
def test_circulant_is_exact(kind, angle):
    """The oracle is the matrix of turned lags, pair by pair; a wrong sense of rotation fails at angle -0.5 or 0.5."""
    correlation = Correlation(kind, 1.5, 0.6, angle)
    sampler = CirculantSampler(correlation, (ROWS, COLUMNS), SPACING)
    assert sampler.least_eigenvalue >= -1e-12
    assert sampler.clip_mass < 1e-12
    assert_two_independent_fields(sampler, (*sampler.torus, 2), correlation)


@pytest.mark.parametrize("angle", [0.0, 0.5])
@pytest.mark.parametrize("kind", KERNELS)
def test_cholesky_is_exact(kind, angle):
    correlation = Correlation(kind, 1.5, 0.6, angle)
    assert_two_independent_fields(CholeskySampler(correlation, *POINTS), (2, ROWS * COLUMNS), correlation)


def test_circulant_pads_until_its_spectrum_is_not_negative():
    """On the smallest torus the squared exponential of a long correlation wraps around and has negative eigenvalues."""
    correlation = Correlation("squared-exponential", 5.0, 5.0)
    smallest = samplers.smallest_torus((ROWS, COLUMNS))
    eigenvalues = samplers.circulant_eigenvalues(correlation, smallest, (SPACING, SPACING))
    assert eigenvalues.min() < -1e-6 * eigenvalues.max()
    assert np.prod(CirculantSampler(correlation, (ROWS, COLUMNS), SPACING).torus) > np.prod(smallest)


def test_draw_is_the_same_after_pickling(tmp_path):
    """Rank 0 builds a sampler and sends it; the others must draw bitwise the same."""
    correlation = Correlation("separable-exponential", 1.5, 0.6)
    for sampler in (
        KroneckerSampler(correlation, X, Y),
        CirculantSampler(correlation, (ROWS, COLUMNS), SPACING),
        CholeskySampler(correlation, *POINTS, tmp_path),
    ):
        sent = pickle.loads(pickle.dumps(sampler))
        assert np.array_equal(sent.draw(np.random.default_rng(1), 2), sampler.draw(np.random.default_rng(1), 2))


@pytest.mark.parametrize("build", ["kronecker", "circulant", "cholesky"])
def test_the_first_fields_of_many_are_those_of_few(build):
    """A property that is added leaves the others what they were."""
    correlation = Correlation("separable-exponential", 1.5, 0.6)
    sampler = {
        "kronecker": lambda: KroneckerSampler(correlation, X, Y),
        "circulant": lambda: CirculantSampler(correlation, (ROWS, COLUMNS), SPACING),
        "cholesky": lambda: CholeskySampler(correlation, *POINTS),
    }[build]()
    many = sampler.draw(np.random.default_rng(1), 5)
    assert len(many) == 5
    assert len({field.tobytes() for field in many}) == 5
    for n in (1, 2, 3, 4):
        assert np.array_equal(sampler.draw(np.random.default_rng(1), n), many[:n])


def test_kronecker_refuses_what_is_no_product():
    for correlation in (Correlation("exponential", 20.0, 2.0), Correlation("squared-exponential", 20.0, 2.0, 0.1)):
        with pytest.raises(SamplerError, match='use the sampler "circulant"'):
            KroneckerSampler(correlation, X, Y)


@pytest.mark.parametrize(("angle", "remedy"), [(0.0, "kronecker"), (0.5, "circulant")])
def test_cholesky_says_why_the_squared_exponential_fails(angle, remedy):
    """8 cells per distance: the smallest eigenvalue is below the rounding of the largest one."""
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(0.0, 20.0, 0.5), np.arange(0.0, 5.0, 0.25)))
    with pytest.raises(SamplerError, match=f'numerically singular.*Use the sampler "{remedy}"'):
        CholeskySampler(Correlation("squared-exponential", 20.0, 2.0, angle), x, y)


def test_memory_is_estimated_before_it_is_taken():
    correlation = Correlation("squared-exponential", 20.0, 2.0)
    many = np.linspace(0.0, 100.0, 30_000)
    for build in (
        lambda: CholeskySampler(correlation, many, many),
        lambda: KroneckerSampler(correlation, many, Y),
        lambda: CirculantSampler(correlation, (20_000, 20_000), SPACING),
    ):
        with pytest.raises(SamplerError, match=r"GB of memory, and the limit is 4\.0 GB; use a coarser"):
            build()


def kept_draw(directory, correlation=KEPT):
    return CholeskySampler(correlation, *POINTS, directory).draw(np.random.default_rng(1), 2)


def test_kept_factor_is_written_once_with_the_checksum_beside_it(tmp_path, monkeypatch):
    first = kept_draw(tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["field_factor.npy", "field_factor.npy.sha256"]
    monkeypatch.setattr("campaign.fields.cholesky.cholesky_factor", None)
    assert np.array_equal(kept_draw(tmp_path), first)


def test_kept_factor_is_written_again_when_its_writing_was_cut_short(tmp_path):
    (tmp_path / "field_factor.npy").write_bytes(b"half of")
    assert np.array_equal(kept_draw(tmp_path), CholeskySampler(KEPT, *POINTS).draw(np.random.default_rng(1), 2))


def test_kept_factor_is_refused_when_damaged(tmp_path):
    kept_draw(tmp_path)
    path = tmp_path / "field_factor.npy"
    data = bytearray(path.read_bytes())
    data[-1] ^= 1
    path.write_bytes(data)
    with pytest.raises(SamplerError, match="missing or damaged"):
        kept_draw(tmp_path)
    path.unlink()
    with pytest.raises(SamplerError, match="missing or damaged"):
        kept_draw(tmp_path)


def test_kept_factor_is_refused_for_another_field(tmp_path):
    kept_draw(tmp_path)
    with pytest.raises(SamplerError, match="belongs to another field"):
        kept_draw(tmp_path, Correlation("exponential", 1.5, 0.6, -0.3))
