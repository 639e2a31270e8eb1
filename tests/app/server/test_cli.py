import pytest
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
    assert "Give another --port" in capsys.readouterr().out


def test_a_command_is_needed():
    with pytest.raises(SystemExit):
        main([])
