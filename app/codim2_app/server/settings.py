"""All settings of `codim2 serve`: each is a flag, or a variable CODIM2_*, or its default. One table for all."""

from __future__ import annotations

import argparse
import os
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from typing import Any

LEVELS = ("debug", "info", "warning", "error")
#: Of the tests and the continuous integration: no settings of the server.
OTHERS = frozenset({"CODIM2_CHROMIUM", "CODIM2_PAPER", "CODIM2_NGINX", "CODIM2_BEFORE"})


_NAME = r"(\*|[\w.*-]+|\[[0-9a-fA-F:.]+\])"
HOST = re.compile(rf"{_NAME}(:\d{{1,5}})?", re.ASCII)
PATH = re.compile(r"(/?[\w.~-]+)*/?", re.ASCII)
SOURCE = re.compile(rf"'self'|'none'|[a-z][a-z0-9+.-]*:|([a-z]+://)?{_NAME}(:(\d{{1,5}}|\*))?(/[\w./~%-]*)?", re.ASCII)
#: More of them no machine has.
MOST_PROCESSES = 512


def whole_number(least: int, most: int) -> Callable[[str], int]:
    """Return what reads a whole number that is neither smaller nor larger."""

    def number(text: str) -> int:
        if (
            not (text.isascii() and text.strip().isdecimal())
            or int(text) < least
            or (most is not None and int(text) > most)
        ):
            allowed = f"from {least} on" if most is None else f"from {least} to {most}"
            raise argparse.ArgumentTypeError(f"{text!r} given; give a whole number {allowed}.")
        return int(text)

    return number


def host(text: str) -> str:
    """Return a host, with its port if one is given, of what may be the address of a page."""
    place = text.partition("//")[2].partition("/")[0] if "//" in text else text.partition("/")[0]
    if not HOST.fullmatch(place):
        raise argparse.ArgumentTypeError(f"{text!r} given; give a host such as explorer.example.org, or host:port.")
    return place


def path(text: str) -> str:
    """Return a path of plain names."""
    if not PATH.fullmatch(text) or {".", ".."}.intersection(text.split("/")):
        raise argparse.ArgumentTypeError(f"{text!r} given; give a path such as /explorer.")
    return text


def sources(text: str) -> str:
    """Return sources of a Content-Security-Policy."""
    for source in filter(None, text.split(" ")):
        if not SOURCE.fullmatch(source):
            raise argparse.ArgumentTypeError(
                f"{source!r} given; give hosts such as https://course.example.org, with spaces between them."
            )
    return text


@dataclass(frozen=True)
class Setting:
    """One setting."""

    name: str  # of the flag, without dashes
    default: Any
    words: str  # what it is, as `--help` says it
    # reads its text; bool is a switch, `host` reads each of a flag that may be repeated (commas in the variable)
    kind: Any = str
    shown: str = ""  # what stands for a value in `--help`
    variable: str = ""  # its variable; default CODIM2_ and the name in capitals
    choices: tuple[str, ...] = ()
    second: str = ""  # a variable without CODIM2_ that hosting services set, read where its own is not there

    @property
    def env(self) -> str:
        """Name of its environment variable."""
        return self.variable or "CODIM2_" + self.name.upper().replace("-", "_")


SETTINGS = (
    Setting("port", 5006, "0 takes any free port", whole_number(0, 65535), "PORT", second="PORT"),
    Setting("address", "localhost", "0.0.0.0 for all interfaces", str, "HOST"),
    Setting("allow-origin", (), "a host under which browsers reach this server; may be repeated", host, "HOST[:PORT]",
            "CODIM2_ORIGINS"),
    Setting("prefix", "", "the path below which a proxy shows this server", path, "/PATH"),
    Setting("frame-ancestors", "'self'", "who else may embed the pages, as in Content-Security-Policy", sources,
            "SOURCES"),
    Setting("processes", 1, "server processes that share the port", whole_number(1, MOST_PROCESSES), "N"),
    Setting("workers", 0, "processes for long work, of each of these; 0 shares the processors",
            whole_number(0, MOST_PROCESSES), "N"),
    Setting("dask", "", "the scheduler of a Dask cluster that does the long work in place of these", str, "ADDRESS"),
    Setting("sessions", 400, "open pages of a server process; one more is asked to wait", whole_number(1, 1_000_000),
            "N"),
    Setting("per-address", 200, "open pages of one network address, which a class behind one router is",
            whole_number(1, 1_000_000), "N"),
    Setting("proxied", False, "a proxy in front gives each visitor's address in X-Real-IP", bool),
    Setting("rooms", 20, "rooms open at once, of a server process; 0 for none", whole_number(0, 10_000), "N"),
    Setting("lessons", None, "a folder of your own lessons, after the course; /?lesson=NAME opens one", Path, "DIR"),
    Setting("docs", None, "a folder with the site that `codim2 docs DIR` built; else the package's own", Path, "DIR"),
    Setting("pyodide", None, "a folder with Pyodide's release: pages compute on their visitors' devices", Path, "DIR"),
    Setting("kernels", None, "a folder that `codim2 kernels` wrote, for pages; else the package's own", Path, "DIR"),
    Setting("log-level", "warning", "what is logged to standard error", str, "LEVEL", choices=LEVELS),
    Setting("log-json", False, "log JSON lines", bool),
    Setting("show", None, "open a browser window (default: when started from a terminal on a screen)", bool),
)  # fmt: skip


def add_settings(serve: argparse.ArgumentParser, environment: Mapping[str, str] = os.environ) -> None:
    """Add all settings to a parser, with what the environment says as defaults."""
    for setting in SETTINGS:
        given = environment.get(setting.env) or environment.get(setting.second)
        words = setting.words
        if setting.kind not in (bool, host) and setting.default not in ("", None):
            words += f"; default {setting.default}"
        options: dict[str, Any] = {"help": f"{words} [{setting.env}]".replace("%", "%%")}
        if setting.kind is bool:
            options |= {"action": argparse.BooleanOptionalAction, "default": _switch(setting, given)}
        elif setting.kind is host:
            options |= {"action": "append", "metavar": setting.shown, "type": host,
                        "default": _hosts(serve, setting, given or "")}  # fmt: skip
        else:
            # argparse reads a default that is text as it reads a flag, and says what is wrong with it
            options |= {"type": setting.kind, "metavar": setting.shown, "default": given or setting.default}
            if setting.choices:
                options["choices"] = setting.choices
        serve.add_argument(f"--{setting.name}", **options)


def _hosts(serve: argparse.ArgumentParser, setting: Setting, given: str) -> list[str]:
    """Return the hosts of a variable; argparse reads no default that is a list."""
    try:
        return [host(one.strip()) for one in given.split(",") if one.strip()]
    except argparse.ArgumentTypeError as error:
        serve.error(f"{setting.env}: {error}")


def _switch(setting: Setting, given: str | None) -> bool | None:
    return setting.default if not given else given.lower() not in ("0", "no", "false", "off")


def unknown_settings(environment: Mapping[str, str] = os.environ) -> list[str]:
    """Return a sentence for each variable that looks like a setting and is none."""
    known = {setting.env for setting in SETTINGS}
    found = []
    for name in sorted(environment):
        if name.startswith("CODIM2_") and name not in known | OTHERS:
            near = get_close_matches(name, known, 1, 0.8)
            found.append(f"{name} is no setting" + (f"; is {near[0]} meant?" if near else "."))
    return found


def settings_table() -> str:
    """Return all settings as a Markdown table."""
    rows = ["| flag | variable | default | what |", "|---|---|---|---|"]
    for setting in SETTINGS:
        default = "" if setting.default in ((), None, "") else f"`{setting.default}`".replace("`False`", "off")
        shown = f" {setting.shown}" if setting.shown else ""
        variable = f"`{setting.env}`" + (f" or `{setting.second}`" if setting.second else "")
        rows.append(f"| `--{setting.name}{shown}` | {variable} | {default} | {setting.words} |")
    return "\n".join(rows)
