"""Ground whose peak strength will be drawn below the residual one and raised to it, foretold for each layer."""

from collections.abc import Iterator

import numpy as np

from campaign.fields.marginals import Lognormal
from campaign.fields.properties import BY_NAME, RESIDUALS, SoilProperty
from campaign.scene.complaints import Complaint
from campaign.scene.ground_surface import surface_of
from campaign.scene.layers import Array, interfaces_of, layer_at, layer_scenes, tops_of
from campaign.scene.rules.residual import ALLOWED_SHARE, Drop, gaussian_correlation
from campaign.scene.scene import Scene

PLACES, DEPTHS = 200, 40
"""Across the section, at which depths in a layer are looked up, and how many of these stand for all."""


def raised_peaks(scene: Scene) -> Iterator[Complaint]:
    """Yield a complaint for each strength of a layer that is raised in more than 1 % of it."""
    for number, layer in enumerate(layer_scenes(scene)):
        for row in RESIDUALS:
            share = raised_share(scene, number, row)
            if share > ALLOWED_SHARE:
                key = row.mean_key if not number else f"layer.{number - 1}.{row.mean_key.partition('.')[2]}"
                yield Complaint(key, _drop(layer, row, 0.0).complaint(share))


def raised_share(scene: Scene, number: int, row: SoilProperty) -> float:
    """Return the share of a layer in which the peak is drawn below the residual `row`, on average."""
    layer = layer_scenes(scene)[number]
    if row.share_of_peak(layer) is not None or not row.reference(layer):
        return 0.0
    grows = row.gradient(layer) or BY_NAME[row.peak].gradient(layer)
    depths = _depths(scene, number) if grows else [0.0]
    return float(np.mean([_drop(layer, row, float(depth)).raised_share for depth in depths]))


def _drop(layer: Scene, row: SoilProperty, depth: float) -> Drop:
    """Return peak and residual at a depth in m below the top of a layer."""
    peak, residual = (_law_at(depth, each, layer) for each in (BY_NAME[row.peak], row))
    rho = next((r for pair, r in layer.field.cross_correlations().items() if {*pair} == {row.peak, row.name}), 0.0)
    return Drop(row, peak, residual, gaussian_correlation(rho, layer.field.cross_correlation_of, peak, residual))


def _law_at(depth: float, row: SoilProperty, layer: Scene) -> Lognormal:
    law = row.distribution(layer)
    return Lognormal(row.mean(layer) + row.gradient(layer) * depth, law.cov if law else 0.0)


def _depths(scene: Scene, number: int) -> Array:
    """Return depths in m below the top of a layer, each of which stands for as much of its area."""
    surface, top = surface_of(scene.geometry), tops_of(scene)[number]
    x, y = (np.arange(PLACES) + 0.5) * surface.width / PLACES, (np.arange(PLACES) + 0.5) * surface.top / PLACES
    x, y = (each.ravel() for each in np.meshgrid(x, y))
    is_here = (y < surface.height_at(x)) & (layer_at(interfaces_of(scene), x, y) == number)
    depth = np.maximum(top.height_at(x) - y, 0.0)[is_here]
    return np.quantile(depth, (np.arange(DEPTHS) + 0.5) / DEPTHS) if depth.size else np.zeros(1)
