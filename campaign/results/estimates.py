"""What statistics say, as variables of the dataset; the attribute `front` names the front whose run-out they are of."""

from campaign.results.variables import Variables, status_flags, variable
from campaign.statistics.convergence import ConvergenceHistory
from campaign.statistics.discretisation import METHOD, Discretisation
from campaign.statistics.intervals import Interval
from campaign.statistics.release import ReleaseComparison
from campaign.statistics.total import TOTAL, total_mean

BOUNDS = ("checkpoint", "bound")
EXACT = "(Clopper and Pearson)"

CUT = "that the wall ahead or the end of the run has cut short (status reached_wall, not_settled)"
CUT_SHORT = f"a slide {CUT} counts with the distance it came"
OPEN = (
    f"a slide {CUT} before that counts as one that does not get beyond, which makes the estimate a lower bound, and "
    "for the upper bound of the interval as one that does"
)
"""What numbers of run-outs make of slides that may have come farther."""

COMMENTS = {
    "exceedance": OPEN,
    "exceedance_given_sliding": OPEN,
    "runout_mean": CUT_SHORT,
    "runout_variance": CUT_SHORT,
}
"""What is said of the numbers at the checkpoints."""


def of_history(history: ConvergenceHistory) -> Variables:
    """Return the estimates at every checkpoint."""
    at, beyond = "checkpoint", "beyond that of the deterministic run"
    variables = {
        "n": variable(at, history.n, "1", "realizations with a result, of a slide or not", "i4"),
        "n_slides": variable(at, history.n_slides, "1", "realizations that slid", "i4"),
        "slide_probability": variable(at, history.slide_probability, "1", "probability of a slide"),
        "slide_probability_ci": variable(
            BOUNDS, history.slide_probability_ci, "1", f"confidence interval of slide_probability {EXACT}"
        ),
        "exceedance": variable(at, history.exceedance, "1", f"probability of a run-out {beyond}; zero without a slide"),
        "exceedance_ci": variable(
            BOUNDS, history.exceedance_ci, "1", "confidence interval of exceedance (Clopper and Pearson)"
        ),
        "exceedance_given_sliding": variable(
            at, history.exceedance_given_sliding, "1", f"probability that a slide has a run-out {beyond}"
        ),
        "exceedance_given_sliding_ci": variable(
            BOUNDS,
            history.exceedance_given_sliding_ci,
            "1",
            "confidence interval of exceedance_given_sliding (Clopper and Pearson)",
        ),
        "runout_mean": variable(at, history.mean, "m", "mean final run-out of the slides"),
        "runout_mean_ci": variable(BOUNDS, history.mean_ci, "m", "confidence interval of runout_mean (Student t)"),
        "runout_variance": variable(at, history.variance, "m2", "variance of the final run-out of the slides"),
        "runout_variance_ci": variable(
            BOUNDS, history.variance_ci, "m2", "confidence interval of runout_variance (Bonett)"
        ),
        "predicted_n": variable(at, history.predicted_n, "1", "realizations expected to satisfy the rule"),
    }
    for name, comment in COMMENTS.items():
        variables[name].attrs["comment"] = comment
    return variables


def of_total(history: ConvergenceHistory, found: Discretisation | None) -> Variables:
    """Return the mean run-out with all that is known of its error."""
    lower, upper = history.mean_ci[-1].tolist()
    sampled = Interval(float(history.mean[-1]), lower, upper, int(history.n_slides[-1]))
    total = total_mean(sampled, found, history.mean_is_bounded)
    mean = variable((), total.estimate, "m", "mean final run-out of the slides")
    mean.attrs["comment"] = TOTAL
    return {
        "runout_mean_total": mean,
        "runout_mean_total_ci": variable(
            "bound", total[1:3], "m", "confidence interval of runout_mean_total, for sampling and mesh"
        ),
    }


def of_discretisation(found: Discretisation) -> Variables:
    """Return what half the cell changes."""
    change = "final run-out with half the cell minus that with the cell"
    error = variable((), found.error, "m", "estimated size of the discretisation error of runout_mean")
    error.attrs |= {"cell": found.cell, "half_cell": found.cell / 2, "pairs": found.interval.n, "comment": METHOD}
    differences = variable("pair", found.differences, "m", change)
    differences.attrs |= {"repeated": found.repeated, "standing": found.standing}
    return {
        "pair": variable("pair", range(len(found.differences)), "1", "realization repeated with half the cell", "i4"),
        "discretisation_error": error,
        "discretisation_change": variable((), found.interval.estimate, "m", f"mean over pairs of {change}"),
        "discretisation_change_ci": variable(
            "bound", found.interval[1:3], "m", "confidence interval of discretisation_change (Student t)"
        ),
        "paired_difference": differences,
        "deterministic_paired_difference": variable((), found.deterministic, "m", f"{change}, with mean strengths"),
    }


def of_release(found: ReleaseComparison) -> Variables:
    """Return the deterministic run with the other release protocol."""
    name = f'final run-out of the deterministic run with gravity = "{found.other}"'
    return {
        "other_release_final_runout": variable((), found.summary.final_runout, "m", f"{name}, front-most particle"),
        "other_release_final_runout_mass": variable((), found.summary.final_runout_mass, "m", f"{name}, front of mass"),
        "other_release_status": status_flags(found.status),
    }
