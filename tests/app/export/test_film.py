"""A film shows the figure at each position of a slider, there and back, and is bounded."""

import io

import numpy as np
import pytest
from codim2_app.export import film as films
from codim2_app.export.film import POSITIONS, film, joined, picture
from codim2_app.export.view import view_of
from codim2_app.server.cli import main
from PIL import Image, ImageSequence

VIEW = view_of("case1-cm4")


def solid(*colours):
    """Pictures of one colour each, as PNG."""
    found = []
    for colour in colours:
        file = io.BytesIO()
        Image.new("RGB", (40, 30), colour).save(file, "PNG")
        found.append(file.getvalue())
    return found


def frames(made):
    return [frame.copy() for frame in ImageSequence.Iterator(Image.open(io.BytesIO(made)))]


@pytest.mark.parametrize("kind", [".gif", ".webp"])
def test_it_goes_there_and_back_and_rests_at_the_ends(kind):
    colours = [(250, 10, 10), (10, 250, 10), (10, 10, 250)]
    made = joined(solid(*colours), kind)
    seen = [np.asarray(frame.convert("RGB"))[15, 20].tolist() for frame in frames(made)]
    assert [colours[int(np.argmax(one))] for one in seen] == [colours[i] for i in (0, 1, 2, 1)]
    durations = [frame.info["duration"] for frame in frames(made)] if kind == ".gif" else None
    assert durations in (None, [480, 60, 480, 60])


def test_each_picture_is_the_figure_there():
    made = [picture(VIEW, "f1=-1,1", value) for value in (-0.5, 0.75)]
    shown = [np.asarray(Image.open(io.BytesIO(one)).convert("L"), float) for one in made]
    assert shown[0].shape == shown[1].shape  # however long a portrait's name is
    assert np.abs(shown[0] - shown[1]).mean() > 1
    assert picture(VIEW, "f1=-1,1", -0.5) == made[0]
    assert picture(VIEW.changed({"f1": 0.75}), "f1=-1,1", 0.75) == made[1]


@pytest.mark.parametrize("value", [-1.5, -0.5])
def test_small_marks_keep_their_colours(value):
    drawn = picture(VIEW, "f1=-2,2", value)
    [shown] = frames(joined([drawn]))
    apart = np.asarray(Image.open(io.BytesIO(drawn)).convert("RGB"), int) - np.asarray(shown.convert("RGB"), int)
    assert np.abs(apart).max() <= 24  # 8 bits; the median cut gives 71


def test_every_picture_is_told_and_the_present_value_is_among_them(monkeypatch):
    asked, told = [], []
    monkeypatch.setattr(films, "picture", lambda view, slider, value, style: asked.append(value) or solid("red")[0])
    film(VIEW, "f1=-1,1", positions=5, progress=lambda *done: told.append(done))
    assert asked == [-1.0, -0.5, 0.0, 0.5, 1.0]
    assert VIEW.number("f1") in asked
    assert told == [(i, 5) for i in range(1, 6)]


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"slider": "nothing"}, "no slider"),
        ({"slider": "f1=1,-1"}, "range"),
        ({"slider": "f1", "kind": ".mp4"}, r"\.gif, \.webp"),
        ({"slider": "f1", "positions": 1}, "2 to 121"),
        ({"slider": "f1", "positions": 10**6}, "2 to 121"),
    ],
)
def test_what_cannot_be_had_is_said_in_one_sentence(given, says):
    with pytest.raises(ValueError, match=says):
        film(VIEW, **given)


def test_one_that_is_too_large_is_refused(monkeypatch):
    monkeypatch.setattr(films, "MOST", 100)
    with pytest.raises(ValueError, match="fewer layers"):
        joined(solid("red", "blue"))


def test_the_command_writes_it_and_says_what_is_wrong(tmp_path, capsys, monkeypatch):
    output = tmp_path / "sweep.gif"
    command = ["film", "case1-cm4", "--slider", "f1=-1,1", "--positions", "3", "-o", str(output)]
    assert main(command) == 0
    assert len(frames(output.read_bytes())) == 4
    assert main([*command[:-1], str(tmp_path / "sweep.mp4")]) == 2
    assert ".gif" in capsys.readouterr().err
    assert POSITIONS <= 121

    def stop(*_given):
        raise KeyboardInterrupt

    monkeypatch.setattr(films, "picture", stop)
    output.unlink()
    assert main(command) == 130
    assert "nothing was written" in capsys.readouterr().err
    assert not output.exists()
