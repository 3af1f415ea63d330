"""Cross-correlations are of random soil properties, each pair once, and possible all together."""

from campaign.fields.cross_correlation import NotPositiveDefiniteError, Pair, gaussian_matrix, lower_factor
from campaign.fields.marginals import Lognormal, attainable_correlations
from campaign.fields.properties import BY_NAME, PROPERTIES
from campaign.scene.rules.rule import Rules
from campaign.scene.rules.soil import FRICTIONLESS

FIRST_PAIR = ("cohesion", "friction_angle")
"""The pair that has a key of its own."""

KEYS = {(one, other): f"field.pairs.{one}.{other}" for one in BY_NAME for other in BY_NAME}
COV_KEYS = tuple(row.cov_key for row in PROPERTIES)
OF = "field.cross_correlation_of"

RULES = Rules()


def _add_rules_of(one: str, other: str) -> None:
    """Add the rules for the key of one pair."""
    covs = BY_NAME[one].cov_key, BY_NAME[other].cov_key

    # Layers in which a property is not random have nothing to correlate there.
    @RULES.on(KEYS[one, other], KEYS[other, one], *covs, in_layers=False)
    def _once_and_random(rho: float | None, again: float | None, *covs: float | None) -> str | None:
        if not rho:
            return None
        if one == other:
            return "a property has a correlation of 1 with itself; leave it out"
        if {one, other} == set(FIRST_PAIR):
            return "this pair has its key, field.cross_correlation; give it there, and leave it out here"
        if again and list(BY_NAME).index(one) > list(BY_NAME).index(other):
            return f"this pair is given as {KEYS[other, one]} too; leave out one of the two"
        for row, cov in zip((BY_NAME[one], BY_NAME[other]), covs, strict=True):
            if cov is None:
                return f"the {row.long_name} is the same everywhere; give {row.cov_key}, or leave the pair out"
        return None

    RULES.on(KEYS[one, other], OF, *covs)(_attainable)
    for section in {key.rpartition(".")[0] for key in covs}:
        RULES.on(KEYS[one, other], section, in_layers=False)(_of_what_the_scene_has)


def _of_what_the_scene_has(rho: float | None, _section_left_out: None) -> str | None:
    """Refuse a pair of which a property is left out: a section has a value, None, only then."""
    return "the scene has no such property; leave the pair out" if rho else None


@RULES.on("field.cross_correlation", OF, *(BY_NAME[name].cov_key for name in FIRST_PAIR))
def _attainable(rho: float | None, of: str, *covs: float | None) -> str | None:
    """Refuse what no Gaussian pair gives: rho_G = ln(1 + rho d_c d_phi) / (s_c s_phi) must lie in (-1, 1)."""
    first, second = covs
    if of != "lognormal" or not rho or first is None or second is None:
        return None
    lowest, highest = attainable_correlations(Lognormal(1.0, first), Lognormal(1.0, second))
    if lowest < rho < highest:
        return None
    return (
        f"lognormal fields with these coefficients of variation can only have a cross-correlation "
        f'between {lowest:.3f} and {highest:.3f}; choose one, or set cross_correlation_of = "gaussian"'
    )


@RULES.on("field.cross_correlation", "laws")
def _correlation_of_two(correlation: float, laws: list[str]) -> str | None:
    if {*laws} == {FRICTIONLESS} and correlation != 0.0:
        return (
            f'with the law "{FRICTIONLESS}" the cohesion is the only strength, with nothing to be correlated to; use 0'
        )
    return None


for _one, _other in KEYS:
    _add_rules_of(_one, _other)


@RULES.on(OF, "field.cross_correlation", *COV_KEYS, *KEYS.values(), place="field.pairs")
def _possible_together(of: str, first: float, *covs_and_pairs: float | None) -> str | None:
    covs = dict(zip(BY_NAME, covs_and_pairs, strict=False))
    laws = {name: BY_NAME[name].marginal(1.0, cov) for name, cov in covs.items() if cov is not None}
    given = {pair: rho for pair, rho in zip(KEYS, covs_and_pairs[len(covs) :], strict=True) if rho}
    pairs = {pair: rho for pair, rho in ({FIRST_PAIR: first} | given).items() if laws.keys() >= set(pair)}
    if any(one == other or _attainable(rho, of, covs[one], covs[other]) for (one, other), rho in pairs.items()):
        return None
    if _exist(pairs, laws, of):
        return None
    nearer = next(percent for percent in range(95, -1, -5) if _exist(_times(percent / 100.0, pairs), laws, of))
    return (
        "no fields have these correlations and field.cross_correlation at once: their matrix is not positive definite; "
        f"bring them nearer to 0, for instance all of them to {nearer} % of what they are"
    )


def _times(factor: float, pairs: dict[Pair, float]) -> dict[Pair, float]:
    return {pair: factor * rho for pair, rho in pairs.items()}


def _exist(pairs: dict[Pair, float], laws: dict[str, Lognormal], of: str) -> bool:
    try:
        lower_factor(gaussian_matrix(laws, pairs, of))
    except NotPositiveDefiniteError:
        return False
    return True
