"""What will happen, in words, from a first look at a slope."""

from campaign.scene.first_look import FirstLook
from campaign.scene.limit_equilibrium import SlipCircle

CERTAIN = 0.999
"""Probability from which on "nearly every" is said, and below whose complement "no"."""

BARELY_STABLE = 1.3
"""Factor of safety below which the release of strength, or softening, may still start a slide."""


PROGRESSIVE = 1.2
"""Factor of safety up to which a brittle slope may slide: softening begins where the ground is weak and spreads. In a
benched cut of 18 m (slip to residual strength 0.4 m, residual factor 0.5) 60 of 60 realizations slid at 1.04, where
one strength everywhere foretells 36 %, 7 of 10 at 1.11 (19 %), 6 of 10 at 1.14 (14 %), 4 of 10 at 1.17 (11 %) and 2 of
24 at 1.27 (4 %)."""


def may_slide(look: FirstLook) -> bool:
    """Whether realizations may slide, as far as factors of safety tell."""
    return look.peak is None or look.slide_probability > 1.0 - CERTAIN


def outlook(look: FirstLook, is_brittle: bool = False, is_progressive: bool = False) -> str:
    """Say what the factors of safety let expect, in sentences.

    Parameters
    ----------
    look
        With the factors.
    is_brittle, is_progressive
        How quick softening is; see `campaign.scene.softening`.
    """
    if look.peak is None:
        return "No circle gives a factor of safety here; only a run tells."
    if look.slide_probability >= CERTAIN:
        return f"Nearly every realization slides.{_end(look)}"
    if look.slide_probability > 1.0 - CERTAIN:
        many = "Most" if look.slide_probability > 0.5 else "Some"
        return f"{many} realizations slide: {_between(look, look.peak, is_brittle, is_progressive)}.{_end(look)}"
    if look.peak.factor < BARELY_STABLE and look.residual is not None and look.residual.factor < 1.0:
        return (
            "Hardly any realization slides by this measure, but softening can start a slide where the factor of safety "
            "is little above 1: look at the deterministic run first."
        )
    return "No realization is expected to slide."


def _between(look: FirstLook, peak: SlipCircle, is_brittle: bool, is_progressive: bool) -> str:
    """Say how many slide: to first order in the strengths if each had one everywhere, and what that leaves out."""
    share = look.slide_probability
    percent = f"{100 * share:.{0 if 0.01 <= share <= 0.99 else 1}f} %"
    one = f"{percent} if each had one strength everywhere (standard deviation of the factor {look.spread:.2g})"
    averaged = f"{'more' if share > 0.5 else 'fewer'} where strength varies within the slope and averages out"
    softens = (is_brittle or is_progressive) and look.residual is not None and look.residual.factor < 1.0
    if not softens or (not is_brittle and peak.factor > PROGRESSIVE):
        return f"{one}, {averaged}"
    spreads = "it begins where the ground is weak and spreads"
    if not is_brittle:
        return f"{one}, and perhaps more, since softening may begin where the ground is weak and spread"
    if peak.factor <= PROGRESSIVE:
        return (
            f"{one}, and more, perhaps most, where softening is as quick as here: {spreads}, so that even slopes with "
            f"a factor of about {PROGRESSIVE:g} may slide"
        )
    if peak.factor < BARELY_STABLE:
        return f"{one}, and perhaps more, since softening is quick here: {spreads}"
    return (
        f"{one}, {averaged}. Softening is quick here, and may add some: {spreads}, which was seen up to a factor of "
        f"about {BARELY_STABLE:g}, and {peak.factor:.2f} is beyond"
    )


def _end(look: FirstLook) -> str:
    if look.residual is not None and look.residual.factor >= 1.0:
        return " What slides soon stops, because even the residual strength holds the slope."
    return ""
