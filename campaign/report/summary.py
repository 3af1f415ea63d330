"""The last words of a campaign on the terminal, which are those of its report."""

from textwrap import fill

from campaign.report.answer import Outcome, answer, outcomes
from campaign.report.choices import modelling_choices
from campaign.report.error_budget import Row, error_budget
from campaign.report.inputs import sentences
from campaign.report.places import reach_estimates
from campaign.report.reservations import reasons_for_doubt
from campaign.results.results import Results
from campaign.statistics.wording import chances, estimated_chance
from campaign.terminal import counted, paragraph, width


def summary(results: Results) -> str:
    """Return the answer of a campaign, its error budget and what it rests on as text."""
    choices = modelling_choices(results.scene)
    margin = max(map(len, choices)) + 3
    return "\n".join(
        [
            *(fill(sentence, width()) for sentence in (answer(results), *reasons_for_doubt(results))),
            f"How {counted(results.realizations, 'realization')} ended",
            *(paragraph(f"{each.realizations}", _ended(each), 8) for each in outcomes(results)),
            *_places(results),
            *(fill(sentence, width()) for sentence in sentences(results)),
            f"Error budget at {100 * results.confidence:g} % confidence",
            *(paragraph(row.source, _words(row), 18) for row in error_budget(results)),
            "What the answer rests on",
            *(paragraph(name, choice, margin) for name, choice in choices.items()),
        ]
    )


def _ended(outcome: Outcome) -> str:
    """Return how realizations ended, and what is said of the most of them."""
    return f"{outcome.meaning}. {outcome.reasons[0]}" if outcome.reasons else outcome.meaning


def _places(results: Results) -> list[str]:
    """Return lines on whether slides reach receptors, below a heading; nothing without receptors or results."""
    known = [each for reach in reach_estimates(results) for each in reach]
    margin = 4 + max((len(each.receptor) for each in known), default=0)
    told = [f"{each.quantity}: {estimated_chance(each.interval)} ({chances(each.interval)})" for each in known]
    lines = [paragraph(each.receptor, text, margin) for each, text in zip(known, told, strict=True)]
    return ["At the places asked about", *lines] if lines else []


def _words(row: Row) -> str:
    interval, n = f" ({row.interval})" if row.interval else "", f", n = {row.n}" if row.n else ""
    return f"{row.quantity}: {row.value}{interval}{n}"
