"""The sections of a scene, frozen and checked key by key; every number in SI units."""

from math import radians
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, create_model

from campaign.fields.correlation import KERNELS
from campaign.fields.properties import BY_NAME
from campaign.scene.constraints import (
    NOT_NEGATIVE,
    POSITIVE,
    AcuteAngle,
    AngleGrowth,
    Angles,
    Count,
    Cov,
    Fraction,
    Line,
    Name,
    OpenFraction,
    OptionalCov,
    PositiveArea,
    PositiveCount,
    PositiveLength,
    PositiveNumber,
    PositivePressure,
    PositiveTime,
    PressureGrowth,
    Pressures,
    Profile,
    RightAngle,
    Seed,
    SmallFraction,
    Stretch,
    ToleranceText,
    Top,
    listed,
    must,
    one_of,
)
from campaign.scene.units import Angle, Length, Pressure, UnitWeight
from solver.method import Basis, Filling, Locking, StressUpdate
from solver.water import UNIT_WEIGHT


class Section(BaseModel):
    """What all sections share: frozen, no unknown keys, no guessing of types, no infinities."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)


class Slope(Section):
    """A straight slope between two level grounds, on a foundation; lengths in m, angle in rad."""

    height: PositiveLength
    angle: AcuteAngle
    crest: PositiveLength
    plain: PositiveLength
    foundation: PositiveLength


class Geometry(Section):
    """The ground: either a slope, or a surface as points (x, elevation) in m above the fixed base, with its toe."""

    slope: Slope | None = None
    surface: Profile | None = None
    toe: PositiveLength | None = None


class Cohesion(Section):
    """Lognormal peak cohesion (undrained strength with the law "tresca"), and the residual one; in Pa.

    Either is its mean everywhere where its coefficient of variation is 0 or left out. Means grow by their gradients, in
    Pa/m, below the ground surface, or the top of a layer. Or the residual one is a share of the peak at each place.
    """

    mean: Annotated[Pressure, NOT_NEGATIVE]
    cov: Cov
    residual: Annotated[Pressure, NOT_NEGATIVE] | None = None
    residual_share: Fraction | None = None
    residual_cov: OptionalCov = None
    gradient: PressureGrowth = None
    residual_gradient: PressureGrowth = None


class FrictionAngle(Section):
    """Lognormal peak friction angle, and the residual one, each its mean everywhere without a variation; in rad.

    Means grow by their gradients, in rad/m. Or the residual one is a share of the peak at each place.
    """

    mean: Annotated[Angle, must("be at least 0 deg and below 90 deg", lambda angle: 0.0 <= angle < radians(90.0))]
    cov: Cov
    residual: Annotated[Angle, NOT_NEGATIVE] | None = None
    residual_share: Fraction | None = None
    residual_cov: OptionalCov = None
    gradient: AngleGrowth = None
    residual_gradient: AngleGrowth = None


class Softening(Section):
    """How strength falls from peak to residual: at a rate per unit plastic strain, or over a slip of a band in m."""

    law: Literal["exponential", "linear", "none"]
    rate: PositiveNumber | None = None
    slip_to_residual: PositiveLength | None = None
    reference_cell: PositiveLength | None = None
    internal_length: PositiveLength | None = None


class Soil(Section):
    """Constitutive law, unit weight in N/m3, Young's modulus in Pa, dilation angle in rad, and strength.

    `saturated_unit_weight` is that below the water table; `tension_cutoff` is what the law "mohr-coulomb" bears in
    tension at most, in Pa, where the cohesion has its peak. `k0` is horizontal over vertical effective stress at rest.
    """

    law: Literal["mohr-coulomb", "drucker-prager", "tresca"] = "mohr-coulomb"
    unit_weight: Annotated[UnitWeight, POSITIVE]
    saturated_unit_weight: Annotated[UnitWeight, POSITIVE] | None = None
    young_modulus: PositivePressure
    poisson_ratio: Annotated[float, must("be at least 0 and below 0.5", lambda ratio: 0.0 <= ratio < 0.5)]
    k0: Annotated[float, must("be above 0 and at most 3", lambda ratio: 0.0 < ratio <= 3.0)] | None = None
    dilation_angle: Annotated[Angle, NOT_NEGATIVE] = 0.0
    tension_cutoff: Annotated[Pressure, NOT_NEGATIVE] | None = None
    cohesion: Cohesion
    friction_angle: FrictionAngle | None = None
    softening: Softening


def _partly(section: type[Section], without: str = "", **inner: type[Section]) -> type[Section]:
    """Return a section of the same keys, of which any may be left out; `inner` are those that are sections."""
    fields: dict[str, Any] = {}
    for name, field in section.model_fields.items():
        if name != without:
            own: Any = Annotated[(field.annotation, *field.metadata)] if field.metadata else field.annotation
            given = inner.get(name, own)
            fields[name] = (given if field.is_required() else given | None, None)
    doc = f"What is other than in [soil]. {section.__doc__}"
    return create_model(f"Partly{section.__name__}", __base__=Section, __module__=__name__, __doc__=doc, **fields)


if TYPE_CHECKING:
    PartlySoil = Section
else:
    PartlyCohesion, PartlyFrictionAngle = _partly(Cohesion), _partly(FrictionAngle)
    PartlySoftening = _partly(Softening, without="internal_length")
    PartlySoil = _partly(Soil, cohesion=PartlyCohesion, friction_angle=PartlyFrictionAngle, softening=PartlySoftening)


class Layer(PartlySoil):
    """Ground below that before it: its top as points (x, elevation) in m, or as a depth in m below the surface.

    What it leaves out is as in [soil], see `campaign.scene.layers`. The fields of the random properties are those of
    all layers, or its own.
    """

    name: Annotated[Name, Field(examples=["soft clay"])]
    top: Top | None = None
    depth: PositiveLength | None = None
    field: Literal["shared", "own"] = "shared"


class GroundWater(Section):
    """Water in the ground: a table, as points (x, elevation) in m, or the ratio of pore pressure to overburden.

    `level` is the elevation in m of water that stands over ground below it, and of the table where that is left out.
    """

    table: Top | None = None
    level: PositiveLength | None = None
    r_u: Annotated[float, must("be at least 0 and at most 0.9", lambda ratio: 0.0 <= ratio <= 0.9)] | None = None
    unit_weight: Annotated[UnitWeight, POSITIVE] = UNIT_WEIGHT


CrossCorrelation = Annotated[float, must("lie between -1 and 1, both excluded", lambda rho: -1.0 < rho < 1.0)]

if TYPE_CHECKING:
    Pairs = Section
else:
    # A key for each property in the table, and below it a key for each other one.
    Partners = create_model(
        "Partners",
        __base__=Section,
        __module__=__name__,
        __doc__="Cross-correlation of a soil property with others.",
        **dict.fromkeys(BY_NAME, (CrossCorrelation | None, None)),
    )
    Pairs = create_model(
        "Pairs",
        __base__=Section,
        __module__=__name__,
        __doc__="Cross-correlation of pairs of random soil properties, `cohesion.cohesion_residual = 0.5`.",
        **{name: (Partners, Partners()) for name in BY_NAME},
    )


class RandomField(Section):
    """The correlated fields of the random soil properties; lengths in m, `angle` of the horizontal axis in rad.

    `cross_correlation` is that of peak cohesion and peak friction angle; `pairs` are those of others.
    """

    correlation: Annotated[str, one_of(KERNELS)]
    horizontal: PositiveLength
    vertical: PositiveLength
    length_kind: Literal["autocorrelation-distance", "scale-of-fluctuation"]
    cross_correlation: CrossCorrelation
    cross_correlation_of: Literal["gaussian", "lognormal"] = "gaussian"
    pairs: Pairs = Pairs()
    angle: RightAngle = 0.0
    sampler: Literal["auto", "kronecker", "circulant", "cholesky"] = "auto"
    resolution: PositiveLength | None = None

    def cross_correlations(self) -> dict[tuple[str, str], float]:
        """Return the cross-correlation of each pair of soil properties that are not independent."""
        pairs = {(one, other): rho for one, partners in self.pairs for other, rho in partners if rho}
        first = {("cohesion", "friction_angle"): self.cross_correlation} if self.cross_correlation else {}
        return first | pairs


class Numerics(Section):
    """Mesh, scheme, time step and duration; cell in m, times in s."""

    cell: PositiveLength
    particles_per_cell: Annotated[int, must("be 1, 4, 9 or 16", lambda number: number in (1, 4, 9, 16))] = 4
    filling: Filling = "cut"
    basis: Basis = "gimp"
    stress_update: StressUpdate = "musl"
    courant: Annotated[float, must("be above 0 and at most 1.5, for instance 0.6", lambda c: 0.0 < c <= 1.5)] = 0.6
    flip: Fraction = 1.0
    locking: Locking = "cell-average"
    gravity: Literal["release", "ramp"] = "release"
    ramp_time: PositiveTime = 2.0
    end_time: PositiveTime
    output_interval: PositiveTime = 0.1


class Slide(Section):
    """From which displacement since release on (m) ground belongs to the slide and a slope has failed; its front.

    `Scene.front_area` is that area in m2, also where it is left out.
    """

    displaced: PositiveLength = 0.1
    failed: PositiveLength = 1.0
    front_area: PositiveArea | None = None
    front: Literal["mass", "tip"] = "mass"


class Receptor(Section):
    """A place that a slide may reach: `x` in m from its near to its far end, which are the same for a point."""

    name: Annotated[Name, Field(examples=["road"])]
    x: Annotated[Stretch, Field(examples=["42 m"])]

    @property
    def where(self) -> str:
        """Its place in words, "x = 42 m" or "x = 40 to 46 m"."""
        near, far = self.x
        return f"x = {near:g} m" if near == far else f"x = {near:g} to {far:g} m"


class Boring(Section):
    """A boring or sounding at `x` in m: values of properties in SI, each with its depth or its elevation in m.

    `noise` is the coefficient of variation of what was measured.
    """

    name: Annotated[Name, Field(examples=["B1"])]
    x: Annotated[Length, Field(examples=["30 m"])]
    by: Literal["depth", "elevation"] = "depth"
    noise: OptionalCov = None
    cohesion: Pressures = ()
    friction_angle: Angles = ()
    cohesion_residual: Pressures = ()
    friction_angle_residual: Angles = ()


class Campaign(Section):
    """How many realizations, from which seed, and when they are enough.

    With `accuracy` that is when the mean run-out is known so well for sampling and mesh together, and the tolerances
    are not asked.
    """

    realizations: PositiveCount = 1000
    accuracy: ToleranceText | None = None
    seed: Seed = 0
    mean_tolerance: OpenFraction = 0.01
    variance_tolerance: OpenFraction = 0.25
    slide_probability_tolerance: SmallFraction = 0.1
    confidence: OpenFraction = 0.95
    minimum: Annotated[Count, must("be 10 or more, or no interval on a variance means much", lambda n: n >= 10)] = 100
    block: PositiveCount = 25
    max_failed_fraction: Fraction = 0.1
    discretisation_pairs: Count = 8
    sensitivity_pairs: Count = 4
    realization_timeout: PositiveTime = 3600.0


MOST_LAYERS = 10
FEW_LAYERS = must(
    f"be {MOST_LAYERS} layers or fewer, since the solver is compiled for all of them; join those that are alike",
    lambda layers: len(layers) <= MOST_LAYERS,
)


class SceneFile(Section):
    """What a scene file holds."""

    title: Line
    geometry: Geometry
    soil: Soil
    layer: Annotated[tuple[Layer, ...], Field(strict=False), listed("layer", "layer"), FEW_LAYERS] = ()
    water: GroundWater = GroundWater()
    field: RandomField
    numerics: Numerics
    slide: Slide = Slide()
    receptor: Annotated[tuple[Receptor, ...], Field(strict=False), listed("receptor", "place")] = ()
    boring: Annotated[tuple[Boring, ...], Field(strict=False), listed("boring", "boring")] = ()
    campaign: Campaign
