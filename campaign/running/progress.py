"""How a campaign is getting on, in plain lines: a pipe, a log file and a terminal all show them alike."""

import math
import time
from collections.abc import Callable

from campaign.statistics.forecast import predicted_stop
from campaign.statistics.intervals import Interval, std_of
from campaign.statistics.tally import Tally
from campaign.statistics.wording import chance_of_slide
from campaign.terminal import clock, counted, duration, say

PERIOD = 15.0
"""Seconds between lines when nothing else calls for one."""

Ahead = Callable[[Tally, float], float]
"""Returns the seconds that other runs will take afterwards; the number is that of realizations a second."""


def nothing_ahead(_tally: Tally, _rate: float) -> float:
    """Nothing follows."""
    return 0.0


FEWEST = 5
"""Realizations from which on a probability is told: that of four out of four is only known to be above 40 %."""


class Progress:
    """Prints a line at every checkpoint and now and then between them.

    Parameters
    ----------
    tally
        The account of the campaign, holding what earlier starts have finished.
    ahead
        How long the runs that follow will take.
    is_beside
        Whether these are runs beside the campaign, whose account may hold realizations of the campaign itself: they
        are counted, and nothing is estimated from the mixture.
    """

    def __init__(
        self,
        tally: Tally,
        ahead: Ahead = nothing_ahead,
        speak: Callable[[str], None] = say,
        is_beside: bool = False,
    ) -> None:
        self._ahead = ahead
        self._is_beside = is_beside
        self._missing = tally.maximum - tally.done
        self._speak = speak
        self._begin = self._last = time.monotonic()
        self._before = tally.done
        self._shown = (tally.done, tally.checkpoints())

    def tick(self, tally: Tally) -> None:
        """Print a line if one is due; call it often."""
        now, state = time.monotonic(), (tally.done, tally.checkpoints())
        at_checkpoint, is_news = state[1] != self._shown[1], state[0] != self._shown[0]
        if at_checkpoint or (is_news and now - self._last > PERIOD):
            self._last, self._shown = now, state
            self._speak(self.line(tally))

    def line(self, tally: Tally) -> str:
        """Return the state of the campaign with the time since its start and the time left."""
        elapsed = time.monotonic() - self._begin
        rate = (tally.done - self._before) / elapsed if elapsed > 0 else 0.0
        if self._is_beside:
            left = tally.maximum - tally.done
            time_left = f", {duration(left / rate)} left" if left and rate > 0 else ""
            return f"[{clock(elapsed)}] {tally.done - self._before} of {self._missing} done{time_left}"
        return f"[{clock(elapsed)}] {state_line(tally)}{_time_left(tally, rate, self._ahead)}"


def state_line(tally: Tally) -> str:
    """Return counts and estimates, each with its interval; counted is what the report counts, once that is settled."""
    if tally.size is None:
        return f"{tally.done}/{tally.maximum} done, {tally.failed} failed{_estimates(tally)}"
    more = f" (and {tally.done - tally.size} beyond the end)" if tally.done > tally.size else ""
    return f"{counted(tally.size, 'realization')}{more}, {tally.failed_in_prefix} failed{_estimates(tally)}"


def _estimates(tally: Tally) -> str:
    latest = tally.latest()
    slides, usable = latest.outcomes.slides, latest.outcomes.usable
    if usable == 0:
        return ""
    chance = f" | {slides} of {usable} slid"
    if usable >= FEWEST:
        chance += f", P(slide) {chance_of_slide(latest.slide_probability)}"
    if slides < 2:
        return chance
    if not latest.outcomes.bound_the_mean:
        return f"{chance} | run-out at least {latest.mean.estimate:.2f} m, {latest.outcomes.cut_short} cut short"
    return f"{chance} | run-out {_mean(latest.mean)}, std {_std(std_of(latest.variance))}"


def _mean(mean: Interval) -> str:
    """Return the mean run-out with its half-width, "10.80 +- 0.05 m"."""
    return f"{mean.estimate:.2f} +- {mean.half_width:.2f} m"


def _std(std: Interval) -> str:
    """Return the standard deviation with its interval, "0.51 m (0.48 to 0.54)"."""
    return f"{std.estimate:.2f} m ({std.lower:.2f} to {std.upper:.2f})" if std.is_known else "not enough yet"


def _forecast(predicted: float, maximum: int) -> str:
    """Say how many realizations the campaign needs, or that it ends before it has these."""
    if predicted <= maximum:
        return f"about {predicted:,.0f} needed"
    return f"ends at {maximum:,}, not converged: about {predicted:,.0f} would be needed"


def _time_left(tally: Tally, rate: float, ahead: Ahead) -> str:
    needed, forecast = tally.maximum, ""
    latest = tally.latest()
    if tally.prefix >= (tally.rule.minimum if latest.outcomes.slides else tally.rule.block):
        predicted = predicted_stop(latest, tally.rule)
        needed = int(min(predicted, tally.maximum)) if math.isfinite(predicted) else tally.maximum
        forecast = f" | {_forecast(predicted, tally.maximum)}" if math.isfinite(predicted) else ""
    if rate <= 0 or needed <= tally.done:
        return forecast
    after = ahead(tally, rate)
    whole = duration((needed - tally.done) / rate + after)
    parts = f", {duration(after)} of it for mesh, release and inputs" if after else ""
    if forecast:
        return f"{forecast}, {whole} left{parts}"
    may_end_earlier = tally.rule.minimum <= tally.maximum
    return f" | {'at most ' if may_end_earlier else ''}{whole} left{parts}"
