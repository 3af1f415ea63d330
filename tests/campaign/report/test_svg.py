"""Figures on the page: small, legible, complete in themselves."""

import xml.etree.ElementTree as ElementTree

import pytest

from campaign.report.figures.style import Illustration, in_style, new_figure
from campaign.report.figures.svg import on_hover, svg_of

SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture(scope="module")
def text():
    with in_style():
        figure, (axes,) = new_figure(3.0)
        (line,) = axes.plot([0.0, 1.0], [0.0, 1 / 3])
        on_hover(line, "5 < 6 & more")
        axes.set_xlabel("distance (m)")
        return svg_of(Illustration(figure, "", 'a "line"'), "line")


def test_a_figure_is_one_element_that_scales(text):
    root = ElementTree.fromstring(text)
    assert root.tag == f"{SVG}svg"
    assert root.attrib.keys() >= {"viewBox", "role", "aria-label"}
    assert not root.attrib.keys() & {"width", "height"}
    assert root.attrib["aria-label"] == 'a "line"'


def test_text_stays_text(text):
    assert "distance (m)" in [each.text for each in ElementTree.fromstring(text).iter(f"{SVG}text")]


def test_values_are_told_on_hover(text):
    assert [each.text for each in ElementTree.fromstring(text).iter(f"{SVG}title")] == ["5 < 6 & more"]


def test_a_figure_is_the_same_each_time_and_its_ids_are_its_own():
    with in_style():
        figures = [new_figure(3.0)[0] for _ in range(3)]
        for figure in figures:
            figure.axes[0].plot([0, 1], [0, 1], "o")
        one, again, other = (
            svg_of(Illustration(figure, "", ""), name) for figure, name in zip(figures, "aab", strict=True)
        )
    assert one == again
    ids = [
        {each.attrib["id"] for each in ElementTree.fromstring(svg).iter() if "id" in each.attrib}
        for svg in (one, other)
    ]
    assert ids[0]
    assert not ids[0] & ids[1]
