"""A film shows the figure at each position of a slider, there and back, and is bounded."""

import io
import shutil
import subprocess

import numpy as np
import pytest
from codim2_app.exports import film as films
from codim2_app.exports.figure import TITLE
from codim2_app.exports.film import POSITIONS, STYLE, encode_film, film, picture
from codim2_app.exports.live import Slider
from codim2_app.exports.play import CHART, PLAY, SCALE, scenery
from codim2_app.exports.view import view_of
from codim2_app.picture.state.animation_pacing import MIN_PACE
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
    made = encode_film(solid(*colours), kind)
    seen = [np.asarray(frame.convert("RGB"))[15, 20].tolist() for frame in frames(made)]
    assert [colours[int(np.argmax(one))] for one in seen] == [colours[i] for i in (0, 1, 2, 1)]
    durations = [frame.info["duration"] for frame in frames(made)] if kind == ".gif" else None
    assert durations in (None, [480, 60, 480, 60])


@pytest.mark.skipif(shutil.which("ffmpeg") is None, reason="no ffmpeg here")
def test_as_mp4_it_goes_the_same_way_at_the_same_pace(tmp_path):
    colours = [(250, 10, 10), (10, 250, 10), (10, 10, 250)]
    (tmp_path / "film.mp4").write_bytes(encode_film(solid(*colours), ".mp4"))
    command = ["ffmpeg", "-v", "error", "-i", str(tmp_path / "film.mp4"), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    raw = subprocess.run(command, capture_output=True, check=True).stdout
    seen = np.frombuffer(raw, np.uint8).reshape(-1, 30, 40, 3)[:, 15, 20]
    assert np.argmax(seen, axis=1).tolist() == [0] * 8 + [1] + [2] * 8 + [1]


def test_without_ffmpeg_it_is_said_what_to_do(monkeypatch):
    monkeypatch.setenv("PATH", "")
    with pytest.raises(ValueError, match=r"ffmpeg.*\.gif"):
        encode_film(solid("red", "blue"), ".mp4")


def test_each_picture_is_the_figure_there():
    made = [picture(VIEW, "f1=-1,1", value) for value in (-0.5, 0.75)]
    shown = [np.asarray(Image.open(io.BytesIO(one)).convert("L"), float) for one in made]
    assert shown[0].shape == shown[1].shape  # however long a portrait's name is
    assert np.abs(shown[0] - shown[1]).mean() > 1
    assert picture(VIEW, "f1=-1,1", -0.5) == made[0]
    assert picture(VIEW.with_values({"f1": 0.75}), "f1=-1,1", 0.75) == made[1]


def test_it_goes_slowly_where_something_happens_and_shows_it():
    chosen = Slider.from_text(VIEW, "f1=-2,6;1,3,9")
    assert chosen.events == (1.0, 3.0)  # the other is not passed
    values = np.array(chosen.values(81, -0.5))
    steps = np.diff(values)
    assert (values[0], values[-1]) == (-2.0, 6.0)
    assert {1.0, 3.0} <= set(values)
    near = [steps[np.argmin(abs(values[:-1] - at))] for at in (1.0, 3.0)]
    assert near == pytest.approx([MIN_PACE * steps[0]] * 2, rel=0.5)
    assert steps.min() > 0.0
    with pytest.raises(ValueError, match="give NAME=LOW,HIGH"):
        Slider.from_text(VIEW, "f1=-2,6;x")


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
        ({"slider": "nothing"}, "no slider"), ({"slider": "f1=1,-1"}, "range"),
        ({"slider": "f1", "kind": ".mov"}, r"\.gif, \.webp"), ({"slider": "f1", "positions": 1}, "2 to 121"),
        ({"slider": "f1", "positions": 10**6}, "2 to 121"),
    ],
)  # fmt: skip
def test_what_cannot_be_had_is_said_in_one_sentence(given, says):
    with pytest.raises(ValueError, match=says):
        film(VIEW, **given)


def test_one_that_is_too_large_is_refused(monkeypatch):
    monkeypatch.setattr(films, "MAX_FILM_BYTES", 100)
    with pytest.raises(ValueError, match="fewer layers"):
        encode_film(solid("red", "blue"))


def test_the_command_writes_it_and_says_what_is_wrong(tmp_path, capsys, monkeypatch):
    output = tmp_path / "sweep.gif"
    command = ["film", "case1-cm4", "--slider", "f1=-1,1", "--positions", "3", "-o", str(output)]
    assert main(command) == 0
    assert len(frames(output.read_bytes())) == 4
    assert main([*command[:-1], str(tmp_path / "sweep.mov")]) == 2
    assert ".gif" in capsys.readouterr().err
    assert POSITIONS <= 121

    def stop(*_given):
        raise KeyboardInterrupt

    monkeypatch.setattr(films, "picture", stop)
    output.unlink()
    assert main(command) == 130
    assert "nothing was written" in capsys.readouterr().err
    assert not output.exists()


PLAYED = view_of("preset=case1-cm4&orbits=0.3,0.4;1.4,0.5")


@pytest.mark.parametrize(("number", "fast"), [(1, True), (2, False)])
def test_a_film_of_play_has_its_dots_on_the_orbit_and_on_both_lines(number, fast):
    still = scenery(PLAYED.with_values({"orbit": number}), STYLE)
    assert still.orbit.fast is fast
    time, bare = still.orbit.time, np.asarray(still.drawn, int)
    for share in (0.35, 0.8):
        shown = np.asarray(Image.open(io.BytesIO(still.picture_at(share))), int)
        v, u = np.nonzero(np.abs(shown - bare).sum(axis=2))
        now = time[0] + share * (time[-1] - time[0])
        [k] = np.nonzero(np.diff(np.sign(time - now)))
        inside = u < still.corner[0]
        point = still.orbit.points[k[0]]
        if np.abs(point).max() > 1.75:  # the dot is beyond the picture
            assert not inside.any()
            continue
        [[x, y]] = still.place.points(point)
        assert np.hypot(u[inside].mean() - SCALE * x, v[inside].mean() - SCALE * (y + TITLE)) < 12
        assert abs(u[~inside].mean() - still.corner[0] - CHART * still.chart.place(now, 0.0)[0]) < 1


def test_a_film_of_play_runs_once_and_begins_anew(tmp_path):
    output = tmp_path / "play.gif"
    command = ["film", "?preset=case1-cm4&orbits=0.3,0.4", "--play", "--positions", "4", "-o", str(output)]
    assert main(command) == 0
    assert [frame.info["duration"] for frame in frames(output.read_bytes())] == [480, 60, 60, 480]


def test_a_picture_of_play_costs_what_moves_in_it():
    view = view_of("?preset=case1-cm4&orbits=0.3,0.4")
    few, many = (len(film(view, PLAY, positions=count)) for count in (2, 22))
    assert many - few < few  # twenty more than the first two


@pytest.mark.parametrize("query", ["v=1", "orbits=0.3,0.4&orbit=0", "orbits=0.3,0.4,-"])
def test_without_a_launched_orbit_there_is_no_play(query):
    with pytest.raises(ValueError, match="Click the picture to launch one"):
        film(view_of(query), PLAY)


def test_on_the_equator_no_time_passes():
    with pytest.raises(ValueError, match="no time"):
        film(view_of("orbits=1,0"), PLAY)
