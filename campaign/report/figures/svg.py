"""Figures as compact SVG: text stays text, ids are a figure's own, and marked artists tell their values on hover."""

import io
import re
from html import escape
from typing import Any, Final

import matplotlib as mpl
from matplotlib.artist import Artist
from matplotlib.backends.backend_svg import FigureCanvasSVG

from campaign.report.figures.style import Illustration

FONTS: Final = "system-ui,-apple-system,Segoe UI,Roboto,Helvetica Neue,Arial,DejaVu Sans,sans-serif"

HOVER: Final = "hover:"

DOTS_PER_INCH: Final = 220
"""Of what is drawn as an image."""

NUMBER = re.compile(r"-?\d+\.\d+")
LINES = re.compile(r'(?<=\sd=")[^"]*')


def on_hover(artist: Artist, text: str) -> None:
    """Have an artist tell a text when a mouse rests on it."""
    artist.set_gid(HOVER + text)


def svg_of(illustration: Illustration, name: str) -> str:
    """Return a figure as an SVG element, complete in itself; `name` keeps its ids apart from those of others."""
    buffer = io.StringIO()
    settings: dict[Any, Any] = {"svg.fonttype": "none", "svg.hashsalt": name, "svg.image_inline": True}
    with mpl.rc_context(settings):
        nothing = dict.fromkeys(("Creator", "Date", "Format", "Type"))
        illustration.figure.set_dpi(DOTS_PER_INCH)
        FigureCanvasSVG(illustration.figure).print_svg(buffer, metadata=nothing)  # savefig draws twice
    return _compact(buffer.getvalue(), illustration.alt)


def _compact(text: str, alt: str) -> str:
    text = text[text.index("<svg") :]
    text = re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL)
    text = re.sub(r'<g id="hover:([^"]*)">', r"<g><title>\1</title>", text)
    text = re.sub(r'<g id="[^"]*">', "<g>", text)
    text = re.sub(r"('[^']*', )*'[^']*', sans-serif", FONTS, text)
    text = LINES.sub(lambda found: _short_path(found[0]), text)
    text = re.sub(r">\s+<", "><", text)
    return _with_root(text, alt)


def _short_path(path: str) -> str:
    """Return the drawing of a path to a hundredth of a point, without needless space."""
    rounded = NUMBER.sub(lambda found: f"{float(found[0]):.2f}".rstrip("0").rstrip("."), path)
    return re.sub(r"\s*([MLQCz])\s*", r"\1", rounded.strip())


def _with_root(text: str, alt: str) -> str:
    box = re.search(r'viewBox="([^"]*)"', text)
    assert box is not None
    root = f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="{box[1]}" '
    return re.sub(r"<svg[^>]*>", lambda _: f'{root}role="img" aria-label="{escape(alt)}">', text, count=1).strip()
