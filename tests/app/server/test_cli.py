import re

import pytest
from codim2_app.lessons import library
from codim2_app.server.cli import main, parser


def test_defaults_are_safe():
    chosen = parser().parse_args(["serve"])
    assert (chosen.address, chosen.port, chosen.processes, chosen.allow_origin) == ("localhost", 5006, 1, [])
    assert chosen.show is False  # no screen in tests


def test_warm_says_what_it_did(capsys):
    assert main(["warm"]) == 0
    assert "compiled" in capsys.readouterr().out


def test_a_taken_port_is_said_with_the_remedy(capsys):
    import socket

    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        assert main(["serve", "--address", "127.0.0.1", "--port", str(taken.getsockname()[1])]) == 1
    assert "Give another --port" in capsys.readouterr().err


@pytest.fixture
def only_the_course():
    """Take back what a test offers: the same process may draw the list of lessons afterwards."""
    yield
    library._own.clear()
    library.lessons.cache_clear()


@pytest.mark.usefixtures("only_the_course")
def test_lessons_of_a_lecturer_and_what_is_wrong_with_one(tmp_path, capsys):
    import socket

    (tmp_path / "good.md").write_text("---\ntitle: T\nsummary: S.\n---\nText.\n", encoding="utf-8")
    (tmp_path / "bad.md").write_text("---\ntitle: T\n---\n", encoding="utf-8")
    with socket.socket() as taken:  # so that nothing is served
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        address = ["--address", "127.0.0.1", "--port", str(taken.getsockname()[1])]
        assert main(["serve", *address, "--lessons", str(tmp_path)]) == 1
        said = capsys.readouterr().out
        assert "left out: bad.md, line 1: 'summary' is missing." in said
        assert "1 lesson from" in said
        assert main(["serve", *address, "--lessons", str(tmp_path / "none")]) == 1
        assert "is no folder" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("given", "said"),
    [(("--address", "300.1.1.1"), r"cannot listen on 300\.1\.1\.1:0: .+\. Give another --address\.\n"),
     (("--dask", "tcp://localhost:1", "--processes", "2"), r"--dask goes with one process; give no --processes\.\n")],
)  # fmt: skip
def test_why_nothing_is_served_is_an_error(given, said, capsys):
    assert main(["serve", "--port", "0", *given]) == 1
    found = capsys.readouterr()
    assert found.out == ""
    assert re.fullmatch(f"codim2: {said}", found.err)
