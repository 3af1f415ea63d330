"""What will happen, in words, from a first look at a slope."""

from campaign.scene.first_look import FirstLook

CERTAIN = 0.999
"""Probability from which on "nearly every" is said, and below whose complement "no"."""

BARELY_STABLE = 1.3
"""Factor of safety below which the release of strength, or softening, may still start a slide."""


def outlook(look: FirstLook) -> str:
    """Say what the factors of safety let expect, in sentences."""
    if look.peak is None:
        return "No circle gives a factor of safety here; only a run tells."
    if look.slide_probability >= CERTAIN:
        return f"Nearly every realization slides.{_end(look)}"
    if look.slide_probability > 1.0 - CERTAIN:
        return f"Some realizations slide: {_between(look)}.{_end(look)}"
    if look.peak.factor < BARELY_STABLE and look.residual is not None and look.residual.factor < 1.0:
        return (
            "Hardly any realization slides by this measure, but softening can start a slide where the factor of safety "
            "is little above 1: look at the deterministic run first."
        )
    return "No realization is expected to slide."


def _between(look: FirstLook) -> str:
    share = look.slide_probability
    direction = "more" if share > 0.5 else "fewer"
    return (
        f"{share:.0%} if each had one strength everywhere (standard deviation of the factor {look.spread:.2g}), "
        f"{direction} where strength varies within the slope and averages out"
    )


def _end(look: FirstLook) -> str:
    if look.residual is not None and look.residual.factor >= 1.0:
        return " What slides soon stops, because even the residual strength holds the slope."
    return ""
