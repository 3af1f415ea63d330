"""What came of a campaign with an accuracy as its aim, as variables of the dataset and back."""

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import xarray as xr

from campaign.accuracy.foretold import Estimate, foretold
from campaign.accuracy.mesh_limit import MeshLimit
from campaign.accuracy.pursuit import Pursuit
from campaign.accuracy.settings import Models
from campaign.results.variables import Variables, texts, variable
from campaign.statistics.intervals import Interval
from campaign.statistics.outcomes import FEW
from campaign.statistics.receptors import QUANTILES

METHOD = (
    "sequential regression over nested realizations of all models (Anderson 1957; multilevel and multifidelity Monte "
    "Carlo), the field's own coarse map as a control with known mean. The total interval joins those of the limits of "
    "small cells from minus to plus the change by the last halving of the cell"
)


class Reached(NamedTuple):
    """What the dataset keeps of a pursuit.

    Attributes
    ----------
    limit : MeshLimit
    is_reached : bool
    cells, young_moduli : tuple of float
        Of the models in m and Pa, from the finest mesh to the cheapest.
    counts, cut_short : tuples of int
        Realizations that each has run, and slides among them whose run-out is a lower bound.
    seconds : tuple of float
        Expected of a realization of each.
    quantiles : mapping
        Run-out in m on the finest mesh within which a share of the slides stops, by that share.
    reaches : mapping
        Probability that a slide reaches a receptor, by its name.
    """

    limit: MeshLimit
    is_reached: bool
    cells: tuple[float, ...]
    young_moduli: tuple[float, ...]
    counts: tuple[int, ...]
    cut_short: tuple[int, ...]
    seconds: tuple[float, ...]
    quantiles: Mapping[float, Estimate]
    reaches: Mapping[str, Estimate]

    @property
    def bounds_the_mean(self) -> bool:
        """Whether so few runs on the finest mesh were cut short that the mean has an upper bound worth its name."""
        return self.cut_short[0] <= FEW * self.counts[0]

    @property
    def total(self) -> Interval:
        """The mean with its interval for sampling and mesh, in m."""
        return self.limit.total if self.bounds_the_mean else self.limit.total._replace(upper=math.inf)


def of_pursuit(found: Pursuit, models: Models, receptors: Sequence[float] = ()) -> Variables:
    """Return the variables; none where nothing slid. Receptors are told by their distances from the toe in m."""
    if found.limit is None:
        return {}
    scenes = [models.scenes[model] for model in found.models]
    of_slides = "mean final run-out of the slides"
    mean = variable((), found.limit.counted.estimate, "m", f"{of_slides} on the finest mesh, estimated from all models")
    mean.attrs |= {"comment": METHOD, "is_reached": int(found.is_reached), "n": found.limit.counted.n}
    change = found.limit.change
    return {
        "model": texts("model", [each.name for each in found.models], "model of the scene"),
        "model_cell": variable("model", [each.numerics.cell for each in scenes], "m", "cell of the model"),
        "model_young_modulus": variable(
            "model", [each.soil.young_modulus for each in scenes], "Pa", "Young's modulus of the model"
        ),
        "model_realizations": variable("model", found.counts, "1", "realizations that the model has run", "i4"),
        "model_cut_short": variable(
            "model", found.cut_short, "1", "slides among them whose run-out is a lower bound", "i4"
        ),
        "model_seconds": variable(
            "model", [each.cost for each in found.models], "s", "expected time of a realization of the model"
        ),
        "multilevel_runout_mean": mean,
        "multilevel_runout_mean_ci": variable(
            "bound", found.limit.counted[1:3], "m", "confidence interval of multilevel_runout_mean, for sampling"
        ),
        "multilevel_runout_mean_total_ci": variable(
            "bound", found.limit.total[1:3], "m", "confidence interval of multilevel_runout_mean, for sampling and mesh"
        ),
        "multilevel_change": variable((), change.estimate, "m", f"{of_slides}, changed by the last halving"),
        "multilevel_change_ci": variable("bound", change[1:3], "m", "confidence interval of multilevel_change"),
        **_distribution(found, models, receptors),
    }


def _distribution(found: Pursuit, models: Models, receptors: Sequence[float]) -> Variables:
    """Return quantiles and probabilities on the finest mesh; none where they are not known."""
    scene = models.scenes[found.models[0]]
    told = foretold(found.runs, scene.campaign.confidence, scene.campaign.seed)
    if told is None:
        return {}
    quantiles = [told.quantile(share) for share in QUANTILES]
    about = "final run-out on the finest mesh within which a share of the slides stops, foretold from all models"
    variables = {
        "quantile": variable("quantile", [*QUANTILES], "1", "share of the slides"),
        **_estimates("multilevel_runout_quantile", "quantile", quantiles, "m", about),
    }
    if receptors:
        reaches = [told.exceedance(distance) for distance in receptors]
        about = "probability that a slide ends at the receptor or beyond on the finest mesh, foretold from all models"
        variables |= _estimates("multilevel_reach", "receptor", reaches, "1", about)
    return variables


def _estimates(name: str, dim: str, estimates: Sequence[Estimate], units: str, about: str) -> Variables:
    sampling, total = ([each[k] for each in estimates] for k in (0, 1))
    bounds = {"ci": (sampling, "sampling"), "total_ci": (total, "sampling and mesh")}
    return {name: variable(dim, [each.estimate for each in total], units, about)} | {
        f"{name}_{suffix}": variable(
            (dim, "bound"), [each[1:3] for each in intervals], units, f"confidence interval of {name}, for {what}"
        )
        for suffix, (intervals, what) in bounds.items()
    }


def _estimates_of(data: xr.Dataset, name: str, dim: str) -> dict[Any, Estimate]:
    if name not in data:
        return {}
    n, is_least = int(data["multilevel_runout_mean"].attrs["n"]), bool(data["model_cut_short"].values.any())
    columns = [data[f"{name}{suffix}"].values.tolist() for suffix in ("", "_ci", "_total_ci")]
    return {
        label: Estimate(*(Interval(value, lower, upper, n, is_least) for lower, upper in bounds))
        for label, value, *bounds in zip(data[dim].values.tolist(), *columns, strict=True)
    }


def reached_of(data: xr.Dataset) -> Reached | None:
    """Return what the dataset says of a pursuit; None where there was none."""
    if "multilevel_runout_mean" not in data:
        return None
    mean, change = data["multilevel_runout_mean"], float(data["multilevel_change"])
    n = int(mean.attrs["n"])

    def interval(estimate: float, name: str) -> Interval:
        lower, upper = data[name].values.tolist()
        return Interval(estimate, lower, upper, n)

    limit = MeshLimit(
        interval(float(mean), "multilevel_runout_mean_ci"),
        interval(change, "multilevel_change_ci"),
        interval(float(mean), "multilevel_runout_mean_total_ci"),
    )
    names = ("model_cell", "model_young_modulus", "model_realizations", "model_cut_short", "model_seconds")
    cells, young_moduli, counts, cut_short, seconds = (tuple(data[name].values.tolist()) for name in names)
    return Reached(
        limit,
        bool(mean.attrs["is_reached"]),
        cells,
        young_moduli,
        counts,
        cut_short,
        seconds,
        _estimates_of(data, "multilevel_runout_quantile", "quantile"),
        _estimates_of(data, "multilevel_reach", "receptor"),
    )
