"""Every setting of the server is a flag, a variable and a default, in one table."""

import argparse
import logging
import re
from pathlib import Path

import pytest
from codim2_app.server.process.logs import MAX_CHARACTERS, shorten
from codim2_app.server.settings import SETTINGS, add_settings, settings_table, unknown_settings


def read(arguments=(), **environment):
    made = argparse.ArgumentParser()
    add_settings(made, environment)
    return made.parse_args(list(arguments))


def test_variables_are_defaults_and_flags_come_first():
    assert read().port == 5006
    assert read(CODIM2_PORT="80").port == 80
    assert read(["--port", "81"], CODIM2_PORT="80").port == 81
    assert read(CODIM2_ORIGINS="a.org, b.org:80").allow_origin == ["a.org", "b.org:80"]
    assert read(["--allow-origin", "c.org"], CODIM2_ORIGINS="a.org").allow_origin == ["a.org", "c.org"]
    assert read(CODIM2_LOG_JSON="1").log_json is True
    assert read(["--no-log-json"], CODIM2_LOG_JSON="1").log_json is False
    assert read(CODIM2_LOG_JSON="off").log_json is False


def test_hosting_services_say_the_port_and_pages_addresses_are_hosts():
    assert read(PORT="8080").port == 8080
    assert read(PORT="8080", CODIM2_PORT="81").port == 81


def test_the_image_leaves_the_port_to_its_host():
    text = (Path(__file__).parents[3] / "Dockerfile").read_text()
    given = dict(one.split("=", 1) for line in re.findall(r"^ENV (CODIM2_.*)", text, re.M) for one in line.split())
    assert given["CODIM2_ADDRESS"] == "0.0.0.0"
    assert read(**given, PORT="8080").port == 8080
    assert read(**given).port == 5006
    assert read(["--allow-origin", "https://c.org:8443/x"], CODIM2_ORIGINS="http://a.org").allow_origin == [
        "a.org", "c.org:8443",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"CODIM2_PORT": "many"}, "'many' given; give a whole number from 0 to 65535."),
        (["--log-level", "loud"], "invalid choice: 'loud'"),
        (["--processes", "-3"], "'-3' given; give a whole number from 1 to 512."),
        (["--sessions", "0"], "'0' given; give a whole number from 1 to 1000000."),
        ({"CODIM2_ORIGINS": "a.org, https://"}, "CODIM2_ORIGINS: 'https://' given; give a host such as"),
        (["--allow-origin", "https://"], "give a host such as explorer.example.org"),
    ],
)
def test_what_is_wrong_is_said_in_words(given, words, capsys):
    with pytest.raises(SystemExit):
        read(**given) if isinstance(given, dict) else read(given)
    assert words in capsys.readouterr().err


def test_a_variable_that_is_no_setting_is_told():
    given = {"CODIM2_SESSION": "5", "CODIM2_PORT": "1", "CODIM2_XYZ": "", "HOME": "/", "CODIM2_PAPER": "x"}
    assert unknown_settings(given) == [
        "CODIM2_SESSION is no setting; is CODIM2_SESSIONS meant?", "CODIM2_XYZ is no setting.",
    ]  # fmt: skip


def test_the_table_and_the_help_have_them_all(capsys):
    with pytest.raises(SystemExit):
        read(["--help"])
    said = capsys.readouterr().out
    for setting in SETTINGS:
        assert f"--{setting.name}" in said
        assert f"[{setting.env}]" in " ".join(said.split())
        assert f"`{setting.env}`" in settings_table()


def test_the_hosting_page_has_the_table():
    page = (Path(__file__).parents[3] / "app" / "codim2_app" / "site" / "docs" / "text" / "hosting.md").read_text(
        encoding="utf-8"
    )
    assert settings_table() in page


# fmt: off
ODD = {
    "--workers": ["100000", "513", "-1", "1e3", "٣"],
    "--processes": ["0", "100000"],
    "--sessions": ["0", "99999999999"],
    "--per-address": ["0", "-5"],
    "--rooms": ["-1", "99999999"],
    "--prefix": ["../x", "/a/../b", "/a b", "/x?y", "/(.*)", "/a;b", "/%2e%2e", "/.", "//x", "/a\nb"],
    "--frame-ancestors": [
        "x; script-src *",
        "a.org;",
        "a.org, b.org",
        "'unsafe-inline'",
        "a\rb",
        "https://a.org/;x",
        "<x>",
    ],
    "--allow-origin": ["a b", "a.org:x", "a.org;b", "<x>", "a.org:999999", "", "a,b", "a@b", "[::1", "a'b"],
}
# fmt: on


@pytest.mark.parametrize(("flag", "text"), [(flag, text) for flag, texts in ODD.items() for text in texts])
def test_what_would_be_no_such_setting_is_refused_in_a_sentence(capsys, flag, text):
    with pytest.raises(SystemExit):
        read([f"{flag}={text}"])
    assert "given; give" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("flag", "text"),
    [("--prefix", "/explorer"), ("--prefix", "courses/one"), ("--prefix", ""), ("--workers", "0"),
     ("--frame-ancestors", "'self' https://course.example.org *.b.org:8080 https: http://localhost:*"),
     ("--allow-origin", "[::1]:80"), ("--allow-origin", "*.example.org"), ("--allow-origin", "*")],
)  # fmt: skip
def test_what_is_usual_is_taken(flag, text):
    assert vars(read([f"{flag}={text}"]))[flag.strip("-").replace("-", "_")] in (
        text,
        int(text) if text == "0" else text,
        [text],
    )


def test_a_logged_message_is_one_short_line():
    for text in ("x" * 9000, "one\ntwo\x1b[31m"):
        record = logging.LogRecord("a", logging.WARNING, "", 0, "404 %s", (text,), None)
        assert shorten(record)
        assert len(record.getMessage()) <= MAX_CHARACTERS + 20
        assert record.getMessage().isprintable()
