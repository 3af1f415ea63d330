"""What every manifest holds, of whatever format; what else is in one is no matter."""

from typing import Annotated, Any

from pydantic import BaseModel, Field, ValidationError


class _Start(BaseModel):
    at: str
    ranks: int
    realization_sha256: str
    versions: dict[str, str]


class _End(BaseModel):
    exit_code: int
    verdict: str


class _Manifest(BaseModel):
    format: int = 0
    reader: str = ""
    title: str
    scene: str
    overrides: list[str]
    identity: dict[str, Any]
    digest: str
    campaign: dict[str, Any]
    starts: Annotated[list[_Start], Field(min_length=1)]
    end: _End | None


def check_shape(manifest: object) -> None:
    """Make sure that something read from JSON is a manifest.

    Raises
    ------
    ValueError
        When it is not; the message says in a few words why.
    """
    try:
        _Manifest.model_validate(manifest, strict=True)
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(map(str, first["loc"]))
        raise ValueError(f"{place}: {first['msg']}" if place else first["msg"]) from None
