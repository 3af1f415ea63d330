"""`campaign draw` shows a scene before it is run."""

import matplotlib.image
import numpy as np
import pytest
from matplotlib.legend import Legend

from campaign import cli
from campaign.report.figures.scene_section import scene_section
from campaign.scene import load_scene
from campaign.scene.first_look import look_at
from campaign.simulation.ground import strengths_of

OVERRIDES = ["numerics.cell=2 m", "field.resolution=1 m"]


@pytest.fixture(autouse=True)
def keep_threads(monkeypatch):
    monkeypatch.setattr(cli, "_pin_threads", lambda: None)


def draw(*arguments):
    return cli.main(["draw", "ma2023", *(f"--set={override}" for override in OVERRIDES), *map(str, arguments)])


def panels(*overrides, realization=3):
    scene = load_scene("ma2023", [*OVERRIDES, *overrides])
    return scene_section(scene, look_at(scene), strengths_of(scene, realization), realization).figure.axes


def test_a_picture_is_written_where_it_is_said(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert draw() == 0
    assert capsys.readouterr().out == "ma2023-section.png\n"
    assert np.ptp(matplotlib.image.imread(tmp_path / "ma2023-section.png")[..., :3]) > 0.5
    assert draw("--out", "a.svg", "--realization", 3) == 0
    assert "peak cohesion of realization 3" in (tmp_path / "a.svg").read_text()


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["--out", "a.jpeg"], "give a name that ends in .png or .svg"),
        (["--realization", "-1"], "There is no field of a realization -1"),
        (["--out", "absent/a.png"], "cannot be written"),
        (["--set", "field.resolution=1 mm"], "the sampler then takes"),
    ],
)
def test_what_cannot_be_drawn_is_a_sentence(arguments, sentence, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert draw(*arguments) == 2
    assert sentence in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_the_section_shows_toe_mesh_and_critical_circles():
    section = panels()[0]
    assert [text.get_text() for text in section.texts] == ["toe, x = 35 m"]
    assert [text.get_text() for text in section.get_legend().texts] == [
        "0.733 with mean peak strength",
        "0.365 with residual strength",
    ]
    assert len(section.collections[0].get_segments()) == 39 + 11


def test_the_strengths_shown_are_those_of_the_realization():
    _, cohesion, friction_angle, *_ = panels()
    fields = strengths_of(load_scene("ma2023", OVERRIDES), 3).to_dataset()
    np.testing.assert_allclose(cohesion.images[0].get_array(), fields.cohesion.values / 1e3)
    np.testing.assert_allclose(friction_angle.images[0].get_array(), np.degrees(fields.friction_angle.values))


def test_a_mesh_too_fine_to_see_is_left_out():
    (toe,) = panels("numerics.cell=0.1 m")[0].collections
    assert len(toe.get_segments()) == 1


def test_the_places_asked_about_are_marked_in_every_panel():
    receptors = 'receptor=[{name = "road", x = ["44 m", "48 m"]}]'
    section, *fields = panels(receptors)
    assert [text.get_text() for text in section.texts] == ["road, x = 44 to 48 m", "toe, x = 35 m"]
    for panel in fields[:2]:
        band = panel.collections[0].get_paths()[0].get_extents()
        assert (band.x0, band.x1) == (44.0, 48.0)


def test_layers_have_their_tints_and_names():
    layers = 'layer=[{name="clay", top="8 m", law="tresca"}, {name="rock", depth="15 m"}]'
    section, cohesion, friction_angle, *_ = panels(layers)
    (legend,) = [each for each in section.artists if isinstance(each, Legend)]
    assert [text.get_text() for text in legend.texts] == ["soil", "clay", "rock"]
    assert len({patch.get_facecolor() for patch in legend.get_patches()}) == 3
    assert np.isfinite(cohesion.images[0].get_array()).all()
    assert 0.0 < np.isnan(np.ma.filled(friction_angle.images[0].get_array(), np.nan)).mean() < 1.0
