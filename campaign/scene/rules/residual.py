"""What soil softens to: a strength, or a share of the peak, and at hardly any place more than the peak."""

from math import exp
from sys import float_info
from typing import Any, NamedTuple

from campaign.fields.cross_correlation import Pair
from campaign.fields.marginals import Lognormal, gaussian_cross_correlation, scatter_of_ratio, share_below
from campaign.fields.properties import BY_NAME, RESIDUALS, SoilProperty
from campaign.scene.rules.rule import Rules
from campaign.scene.rules.soil import SOFTENING_LAW, largest_allowed_cov
from campaign.terminal import rounded_down

ALLOWED_SHARE, MOST_SHARE = 0.01, 0.2
"""Of the ground whose peak is raised to the residual: up to which nothing is said, and from which on it is refused."""

QUANTILE = -2.3263
"""Standard Gaussian value below which lies `ALLOWED_SHARE`."""

LEAST = float_info.min
"""Of which a share or a logarithm can still be taken."""

RULES = Rules()


class Drop(NamedTuple):
    """Peak and residual strength at a depth in the same soil.

    Attributes
    ----------
    residual : SoilProperty
        Which it is.
    peak_law, residual_law : Lognormal
        Their distributions there.
    correlation : float
        Of the Gaussian fields behind them.
    """

    residual: SoilProperty
    peak_law: Lognormal
    residual_law: Lognormal
    correlation: float

    @property
    def raised_share(self) -> float:
        """The share of places at which the peak is drawn below the residual, and raised to it."""
        if not self.residual_law.mean or not self.peak_law.mean:
            return float(self.residual_law.mean > 0.0)
        return share_below(self.peak_law, self.residual_law, self.correlation)

    def complaint(self, share: float) -> str:
        """Say that in a share of the ground the peak is raised, and what to write instead."""
        key, mean = self.residual.share_key.rpartition(".")[2], self.residual_law.mean / self.peak_law.mean
        told = (
            f"in {100 * share:.2g} % of the ground the {BY_NAME[self.residual.peak].long_name} that is drawn is below "
            "it and is raised to it, which makes the ground stronger and less variable than it is written"
        )
        if mean == 1.0:
            return f"{told}; if it is not to soften, give {key} = 1 in its place, all of the peak at each place"
        scatter = scatter_of_ratio(self.peak_law, self.residual_law, self.correlation)
        most = max(exp(self.peak_law.log_mean + QUANTILE * scatter + 0.5 * self.residual_law.sigma**2), LEAST)
        unit = self.residual.unit
        shown = f"{rounded_down(most * unit.shown_per_si)} {unit.shown}"
        return f'{told}; give {key} = {mean:.2g} in its place, a share of the peak at each place, or at most "{shown}"'


def gaussian_correlation(rho: float, of: str, peak: Lognormal, residual: Lognormal) -> float:
    """Return the correlation of the Gaussian fields behind peak and residual where `rho` is that of the kind `of`."""
    return gaussian_cross_correlation(rho, peak, residual) if of == "lognormal" else rho


def _add_rules_of(row: SoilProperty) -> None:
    peak = BY_NAME[row.peak]
    name = row.share_key.rpartition(".")[2]

    @RULES.on(row.mean_key, row.share_key, SOFTENING_LAW)
    def _one_residual(mean: float | None, share: float | None, law: str) -> str | None:
        if mean is None and share is None and law != "none":
            example = row.unit.show(5.0 / row.unit.shown_per_si)
            return (
                f'the {law} law needs it; add for instance residual = "{example}", or {name} = 0.5, a share of the '
                'peak at each place, or choose softening.law = "none"'
            )
        if mean is not None and share is not None:
            return f"the {name} says the same in other terms; leave out one of the two"
        return None

    def of_the_peak(value: float | None, share: float | None) -> str | None:
        if value and share is not None:
            return f"with a {name} it scatters and grows as the peak does; leave it out"
        return None

    for key in (row.cov_key, row.gradient_key):
        RULES.on(key, row.share_key)(of_the_peak)

    pair: Pair = (row.peak, row.name)
    pair_keys = tuple(f"field.pairs.{one}.{other}" for one, other in (pair, pair[::-1]))

    @RULES.on(
        row.mean_key,
        row.cov_key,
        row.gradient_key,
        peak.mean_key,
        peak.cov_key,
        peak.gradient_key,
        SOFTENING_LAW,
        "field.cross_correlation_of",
        *pair_keys,
    )
    def _seldom_above_peak(*values: Any) -> str | None:
        mean, cov, growth, peak_mean, peak_cov, peak_growth, law, of, *pairs = values
        # Where means grow with depth the share is that of the ground, see `campaign.scene.raised_peaks`.
        if not mean or law == "none" or mean > peak_mean or growth or peak_growth:
            return None
        if peak_cov >= largest_allowed_cov(peak_mean, peak.limit):
            return None
        laws = Lognormal(peak_mean, peak_cov), Lognormal(mean, cov or 0.0)
        drop = Drop(row, *laws, gaussian_correlation(next(filter(None, pairs), 0.0), of, *laws))
        share = drop.raised_share
        return drop.complaint(share) if share > MOST_SHARE else None


for _row in RESIDUALS:
    _add_rules_of(_row)
