"""The factor of safety of a slope by Bishop's simplified method, as a first look before anything is run.

A circular slip surface is cut into vertical slices of width ``b`` and weight ``W``, whose bases dip by ``alpha``
towards the toe, with the pore pressure ``u``. Moments about the centre, with no shear between slices, give (Bishop
1955, Geotechnique 5:7)

    F = sum [(c b + (W - u b) tan(phi)) / (cos(alpha) + sin(alpha) tan(phi) / F)] / sum W sin(alpha)

with the mean of ``c`` and ``tan(phi)`` over the base of a slice, which interfaces of layers may cut. Standing water is
in balance with itself: below its level ground has its buoyant weight, and ``u`` is in excess of it. The critical circle
is the one with the least ``F``. Circles end on the ground surface, stay above the fixed base, and fall by a good part
of the height of the slope, or the weakest one would be that of a bump on the crest.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from campaign.scene.layers import layer_at, weight_above
from solver.surface import Surface
from solver.water import NO_WATER, Water

Array = NDArray[np.float64]

SLICES = 30
BASE_PLACES = 6  # of each slice, at which the layer is looked up
SAGITTAS = (0.02, 0.5)  # depths of arcs under their chords, over the length of these
COARSE = (28, 28, 10)  # places on the surface where circles begin, where they end, and circles through both
FINE = 11  # the same three, in the neighbourhood of the best
REFINEMENTS = 8
ITERATIONS = 15
LEAST_FALL = 0.2  # of a circle from end to end, in heights of the slope: on less a bump or a bank fails by itself
DEPTHS = 200  # places at which the depth of a circle is measured


class SlipCircle(NamedTuple):
    """A circular slip surface and its factor of safety."""

    factor: float
    x: float  # m, of the centre
    y: float  # m
    radius: float  # m
    entry: float  # m, where it leaves the ground surface uphill
    exit: float  # m, and downhill

    @property
    def lowest(self) -> float:
        """Least elevation in m, of the arc between its two ends."""
        return float(_lowest(*(np.array(number) for number in (self.x, self.y, self.radius, self.entry, self.exit))))

    def depth(self, surface: Surface) -> float:
        """Return its greatest depth in m below the surface."""
        x = np.linspace(self.entry, self.exit, DEPTHS, dtype=np.float64)
        return float(np.max(surface.height_at(x) - self.elevation(x)))

    def elevation_of_ends(self, surface: Surface) -> tuple[float, float]:
        """Return the elevations in m at which it leaves the surface uphill and downhill."""
        upper, lower = surface.height_at(np.array([self.entry, self.exit]))
        return float(upper), float(lower)

    def area(self, surface: Surface) -> float:
        """Return the area in m2 between it and the surface."""
        x = np.linspace(self.entry, self.exit, DEPTHS, dtype=np.float64)
        return float(np.mean(surface.height_at(x) - self.elevation(x))) * (self.exit - self.entry)

    def elevation(self, x: Array) -> Array:
        """Return the elevation in m of the arc at places between its ends."""
        return np.asarray(self.y - np.sqrt(np.maximum(self.radius**2 - (x - self.x) ** 2, 0.0)))


NO_CIRCLE = SlipCircle(np.inf, np.nan, np.nan, np.nan, np.nan, np.nan)
"""What there is where nothing drives a slide, or nothing resists it."""


class Strata(NamedTuple):
    """Layers of the ground from the surface down, each with one strength everywhere, or one that grows with depth."""

    cohesion: tuple[float, ...]  # Pa, at the top of each layer
    friction_angle: tuple[float, ...]  # rad
    unit_weight: tuple[float, ...]  # N/m3
    interfaces: tuple[Surface, ...] = ()  # the k-th is the top of the layer k + 1, nowhere above those before
    saturated_unit_weight: tuple[float, ...] = ()  # N/m3, below a water table; none given: the same
    water: Water = NO_WATER
    cohesion_gradient: tuple[float, ...] = ()  # Pa/m; none given: 0
    friction_gradient: tuple[float, ...] = ()  # rad/m
    tops: tuple[Surface, ...] = ()  # from which they grow, that of the first included; needed with a gradient

    def strength_at(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Return cohesion in Pa and the tangent of the friction angle at places."""
        layer = layer_at(self.interfaces, x, y)
        cohesion, tangent = np.asarray(self.cohesion)[layer], np.tan(self.friction_angle)[layer]
        if not any(self.cohesion_gradient) and not any(self.friction_gradient):
            return cohesion, tangent
        depth = np.zeros(layer.shape)
        for number, top in enumerate(self.tops):
            depth = np.where(layer == number, np.maximum(top.height_at(x) - y, 0.0), depth)
        cohesion = cohesion + np.asarray(self.cohesion_gradient)[layer] * depth
        angle = np.asarray(self.friction_angle)[layer] + np.asarray(self.friction_gradient)[layer] * depth
        return cohesion, np.tan(angle)


def critical_circle(surface: Surface, strata: Strata) -> SlipCircle:
    """Return the circle with the least factor of safety, slides towards +x; `NO_CIRCLE` if there is none.

    Parameters
    ----------
    surface : Surface
        Of the ground; its base is at elevation 0.
    strata : Strata
    """
    limits = [(0.0, surface.width), (0.0, surface.width), SAGITTAS]
    steps = [(high - low) / (count - 1) for (low, high), count in zip(limits, COARSE, strict=True)]
    axes = [np.linspace(low, high, count) for (low, high), count in zip(limits, COARSE, strict=True)]
    axes[:2] = [np.union1d(axis, surface.x) for axis in axes[:2]]
    for _ in range(1 + REFINEMENTS):
        entry, exit_, sagitta = (values.ravel() for values in np.meshgrid(*axes))
        factors = factors_of_safety(surface, strata, entry, exit_, sagitta)
        best = int(np.argmin(factors))
        circle = entry[best], exit_[best], sagitta[best]
        axes = [
            np.linspace(value - 2.0 * step, value + 2.0 * step, FINE).clip(low, high)
            for value, step, (low, high) in zip(circle, steps, limits, strict=True)
        ]
        steps = [4.0 * step / (FINE - 1) for step in steps]
    if not np.isfinite(factors[best]):
        return NO_CIRCLE
    a, b, s = circle
    centre_x, centre_y, radius = _circles(surface, a[None], b[None], s[None])
    return SlipCircle(
        float(factors[best]), float(centre_x[0]), float(centre_y[0]), float(radius[0]), float(a), float(b)
    )


def factor_on(circle: SlipCircle, surface: Surface, strata: Strata) -> float:
    """Return the factor of safety of a given circle for another strength."""
    width = (circle.exit - circle.entry) / SLICES
    x = np.linspace(circle.entry, circle.exit, SLICES, endpoint=False, dtype=np.float64) + 0.5 * width
    sine, base = (circle.x - x[None]) / circle.radius, np.minimum(circle.elevation(x), surface.height_at(x))
    return float(_bishop(_slices(surface, strata, x[None], base[None], np.array([[width]]), sine))[0])


def factors_of_safety(surface: Surface, strata: Strata, entry: Array, exit_: Array, sagitta: Array) -> Array:
    """Return the factor of safety of each circle, infinite where it is none or nothing drives it.

    Parameters
    ----------
    surface : Surface
    strata : Strata
    entry, exit_ : ndarray (k,)
        Places in m where a circle cuts the surface.
    sagitta : ndarray (k,)
        Depth of the arc under its chord, over the chord's length.
    """
    is_possible = entry < exit_
    factor = np.full(entry.size, np.inf)
    entry, exit_, sagitta = entry[is_possible], exit_[is_possible], sagitta[is_possible]
    centre_x, centre_y, radius = _circles(surface, entry, exit_, sagitta)
    width = (exit_ - entry) / SLICES
    x = entry[:, None] + width[:, None] * (np.arange(SLICES) + 0.5)
    sine = (centre_x[:, None] - x) / radius[:, None]
    falls = surface.height_at(entry) - surface.height_at(exit_)
    with np.errstate(invalid="ignore"):
        base = centre_y[:, None] - radius[:, None] * np.sqrt(1.0 - sine**2)
        is_arc = centre_y >= surface.height_at(entry)  # else the arc would overhang
        is_arc &= _lowest(centre_x, centre_y, radius, entry, exit_) >= 0.0
        is_arc &= np.all(surface.height_at(x) - base >= 0.0, axis=1)
        is_arc &= falls >= LEAST_FALL * surface.height
    slices = _slices(surface, strata, x[is_arc], base[is_arc], width[is_arc, None], sine[is_arc])
    factor[np.flatnonzero(is_possible)[is_arc]] = _bishop(slices)
    return factor


class _Slices(NamedTuple):
    """Vertical slices of k circles, each (k, slices)."""

    weight: Array  # N/m, buoyant under standing water
    uplift: Array  # N/m, u b
    cohesive_force: Array  # N/m, c b
    tangent: Array  # tan(phi) at the base
    sine: Array  # of the dip of the base
    cosine: Array


def _slices(surface: Surface, strata: Strata, x: Array, base: Array, width: Array, sine: Array) -> _Slices:
    """Return slices of a `width` in m around `x`, whose bases have their middle at the elevation `base` in m."""
    cosine = np.sqrt(1.0 - sine**2)
    unit_weights = strata.unit_weight, strata.saturated_unit_weight or strata.unit_weight
    weight = weight_above(surface, strata.interfaces, unit_weights, strata.water.height_at(x), x, base)
    pore_pressure = strata.water.pore_pressure(x, base, weight) - strata.water.standing_pressure(base)
    weight = weight - strata.water.uplift(surface.height_at(x), base)
    count = BASE_PLACES if strata.interfaces else 1
    aside = (width * ((np.arange(count) + 0.5) / count - 0.5))[..., None, :]
    places = x[..., None] + aside, base[..., None] - (sine / cosine)[..., None] * aside
    cohesion, tangent = (each.mean(axis=-1) for each in strata.strength_at(*places))
    return _Slices(weight * width, pore_pressure * width, cohesion * width, tangent, sine, cosine)


def _circles(surface: Surface, entry: Array, exit_: Array, sagitta: Array) -> tuple[Array, Array, Array]:
    """Return the centres and radii of circles through two places of the surface."""
    top, bottom = surface.height_at(entry), surface.height_at(exit_)
    chord = np.hypot(exit_ - entry, top - bottom)
    radius = chord * (0.25 + sagitta**2) / (2.0 * sagitta)
    rise = (radius - sagitta * chord) / chord
    return (
        0.5 * (entry + exit_) + rise * (top - bottom),
        0.5 * (top + bottom) + rise * (exit_ - entry),
        radius,
    )


def _lowest(centre_x: Array, centre_y: Array, radius: Array, entry: Array, exit_: Array) -> Array:
    """Return the least elevation of arcs between their ends."""
    aside = np.clip(centre_x, entry, exit_) - centre_x
    return np.asarray(centre_y - np.sqrt(np.maximum(radius**2 - aside**2, 0.0)))


def _bishop(slices: _Slices) -> Array:
    driving = np.sum(slices.weight * slices.sine, axis=1)
    resisting = slices.cohesive_force + (slices.weight - slices.uplift) * slices.tangent
    factor = np.ones(driving.size)
    with np.errstate(divide="ignore", invalid="ignore"):
        for _ in range(ITERATIONS):
            share = slices.cosine + slices.sine * slices.tangent / factor[:, None]
            factor = np.sum(resisting / share, axis=1) / driving
            factor = np.where((driving > 0.0) & (share.min(axis=1) > 0.2) & (factor > 0.0), factor, np.inf)
    return factor
