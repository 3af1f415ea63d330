"""Two displacements decide what a slide is, at every scale."""

import numpy as np
import pytest
from small_slope import COHESION, small_model, with_strength

from solver.in_situ import in_situ_state
from solver.march import MarchEnd, march_to_rest
from solver.observables import runout_mass, sliding_volume
from solver.rest import RestDetector
from solver.slide import PAPER, SlideCriteria
from solver.surface import Surface


def scaled_run(scale):
    """Return model, start and history of the same slope with all lengths times ``scale``, by Froude's similarity."""
    model = small_model()
    surface = Surface(*(np.multiply(part, scale) for part in model.surface))
    law = model.materials[0].law
    law = law._replace(bulk_modulus=law.bulk_modulus * scale, shear_modulus=law.shear_modulus * scale)
    materials = (model.materials[0]._replace(law=law),)
    criteria = SlideCriteria(PAPER.displaced * scale, PAPER.failed * scale, PAPER.front_area * scale**2)
    model = model._replace(surface=surface, materials=materials, cell_size=model.cell_size * scale, criteria=criteria)
    start = with_strength(in_situ_state(model), COHESION * scale, residual=2e3 * scale)
    return model, start, march_to_rest(model, start, np.linspace(0.0, 8.0, 81) * np.sqrt(scale))


def test_a_small_slide_is_a_large_one_seen_from_afar():
    """Lengths as 1 to L, times as 1 to sqrt(L); but for rounding and the absolute mass below which a node is empty."""
    scale = 1.0 / 64.0
    model, start, small = scaled_run(scale)
    paper, paper_start, large = scaled_run(1.0)
    assert small.end is large.end is MarchEnd.AT_REST
    assert small.settle_time == pytest.approx(np.sqrt(scale) * large.settle_time, rel=1e-9)
    np.testing.assert_allclose(small.runout, scale * large.runout, rtol=1e-4)
    front = runout_mass(large.particles, paper_start, paper.surface, paper.criteria)
    assert front > 0.5
    assert runout_mass(small.particles, start, model.surface, model.criteria) == pytest.approx(scale * front, rel=1e-4)
    area = sliding_volume(large.particles, paper_start, paper.criteria)
    assert sliding_volume(small.particles, start, model.criteria) == pytest.approx(scale**2 * area, rel=1e-4)


def test_at_the_scale_of_the_paper_the_derived_measures_are_round():
    assert (PAPER.rest_speed, PAPER.rest_time) == (0.05, 0.2)


def test_a_column_of_bars_comes_to_rest_on_its_own_scale():
    """Quiet after 20 mm of travel: no slide at the scale of the paper, over after two output times at its own."""
    own, paper = RestDetector(SlideCriteria(0.5e-3, 5e-3, 1e-4)), RestDetector()
    story = [(0.0, 0.0, 0.0), (0.02, 0.02, 1.0), (0.04, 0.02, 1e-6), (0.06, 0.02, 1e-6)]
    assert [own.is_over(*state, 0.05) for state in story] == [False, False, False, True]
    assert not any(paper.is_over(*state, 0.05) for state in story)
