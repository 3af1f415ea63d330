"""What can go wrong and is the user's to mend: one base, so that one clause catches all of it."""


class CampaignError(Exception):
    """The message says what is wrong, with the offending value, and what to do."""


class RefusalError(CampaignError):
    """The command cannot be carried out as asked."""


class SceneError(CampaignError):
    """Everything that is wrong with a scene; each message names the place, the value and the remedy."""

    def __init__(self, messages: list[str]) -> None:
        super().__init__(messages)
        self.messages = messages

    def __str__(self) -> str:
        return "\n".join(self.messages)


class SamplerError(CampaignError):
    """A sampler cannot draw this field; the message says why and what to use instead."""


class DamagedRecordError(CampaignError):
    """A record's bytes are not what was written; the message names the file."""
