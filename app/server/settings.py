"""All settings of `codim2 serve`: each is a flag, or a variable CODIM2_*, or its default. One table for all."""

from __future__ import annotations

import argparse
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

LEVELS = ("debug", "info", "warning", "error")


@dataclass(frozen=True)
class Setting:
    """One setting.

    Attributes
    ----------
    name : str
        Of the flag, without dashes.
    default : object
    words : str
        What it is, as `--help` says it.
    kind : type or callable
        Reads its text; bool is a switch, list a flag that may be repeated (commas in the variable).
    shown : str
        What stands for a value in `--help`.
    variable : str
        Its variable; default CODIM2_ and the name in capitals.
    choices : tuple of str
    """

    name: str
    default: Any
    words: str
    kind: Any = str
    shown: str = ""
    variable: str = ""
    choices: tuple[str, ...] = ()

    @property
    def env(self) -> str:
        """Name of its environment variable."""
        return self.variable or "CODIM2_" + self.name.upper().replace("-", "_")


SETTINGS = (
    Setting("port", 5006, "0 takes any free port", int, "PORT"),
    Setting("address", "localhost", "0.0.0.0 for all interfaces", str, "HOST"),
    Setting("allow-origin", (), "a host under which browsers reach this server; may be repeated", list, "HOST[:PORT]",
            "CODIM2_ORIGINS"),
    Setting("prefix", "", "the path below which a proxy shows this server", str, "/PATH"),
    Setting("frame-ancestors", "'self'", "who else may embed the pages, as in Content-Security-Policy", str, "SOURCES"),
    Setting("processes", 1, "server processes that share the port", int, "N"),
    Setting("workers", 0, "processes for long work, of each of these; 0 shares the processors", int, "N"),
    Setting("dask", "", "the scheduler of a Dask cluster that does the long work in place of these", str, "ADDRESS"),
    Setting("sessions", 400, "open pages of a server process, beyond which a new one is asked to wait", int, "N"),
    Setting("rooms", 20, "rooms that lecturers have open at once, of a server process; 0 for none", int, "N"),
    Setting("lessons", None, "a folder of your own lessons, after the course; /?lesson=NAME opens one", Path, "DIR"),
    Setting("docs", None, "a folder with the site that `codim2 docs DIR` built; else the package's own", Path, "DIR"),
    Setting("log-level", "warning", "what is logged to standard error", str, "LEVEL", choices=LEVELS),
    Setting("log-json", False, "log JSON lines", bool),
    Setting("show", None, "open a browser window (default: when started from a terminal on a screen)", bool),
)  # fmt: skip


def add_settings(serve: argparse.ArgumentParser, environment: Mapping[str, str] = os.environ) -> None:
    """Add all settings to a parser, with what the environment says as defaults."""
    for setting in SETTINGS:
        given = environment.get(setting.env)
        words = setting.words
        if setting.kind is not bool and setting.kind is not list and setting.default not in ("", None):
            words += f"; default {setting.default}"
        options: dict[str, Any] = {"help": f"{words} [{setting.env}]".replace("%", "%%")}
        if setting.kind is bool:
            options |= {"action": argparse.BooleanOptionalAction, "default": _switch(setting, given)}
        elif setting.kind is list:
            options |= {"action": "append", "metavar": setting.shown,
                        "default": [one.strip() for one in (given or "").split(",") if one.strip()]}  # fmt: skip
        else:
            # argparse reads a default that is text as it reads a flag, and says what is wrong with it
            options |= {"type": setting.kind, "metavar": setting.shown, "default": given or setting.default}
            if setting.choices:
                options["choices"] = setting.choices
        serve.add_argument(f"--{setting.name}", **options)


def _switch(setting: Setting, given: str | None) -> bool | None:
    return setting.default if not given else given.lower() not in ("0", "no", "false", "off")


def table() -> str:
    """Return all settings as a Markdown table."""
    rows = ["| flag | variable | default | what |", "|---|---|---|---|"]
    for setting in SETTINGS:
        default = "" if setting.default in ((), None, "") else f"`{setting.default}`".replace("`False`", "off")
        shown = f" {setting.shown}" if setting.shown else ""
        rows.append(f"| `--{setting.name}{shown}` | `{setting.env}` | {default} | {setting.words} |")
    return "\n".join(rows)
