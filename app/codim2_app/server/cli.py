"""The command `codim2`."""

from __future__ import annotations

import argparse
import gc
import io
import multiprocessing
import os
import socket
import sys
import webbrowser
from collections.abc import Sequence
from contextlib import suppress
from importlib.metadata import version
from pathlib import Path
from typing import Any

from ..picture.frame.dask_executor import ClusterError, dask_executor
from ..site.docs import docs_folder
from ..view import extensions
from .commands.answers import add_classify, add_presets, add_prove
from .commands.builds import add_docs, add_kernels, add_notebooks, add_static
from .commands.count import add_census
from .commands.downloads import add_data, add_figure, add_film, add_live
from .commands.numbers import join_negative_numbers
from .commands.reference import add_reference
from .process.files import many_files
from .process.logs import log_to_stderr
from .process.stopping import stop_when_asked
from .settings import add_settings, unknown_settings


def parser() -> argparse.ArgumentParser:
    """Return the parser of the command line."""
    top = argparse.ArgumentParser(
        prog="codim2", description="Dynamics near an isolated codimension-2 discontinuity set."
    )
    top.add_argument("--version", action="version", version=f"codim2 {version('codim2')}")
    commands = top.add_subparsers(dest="command", required=True)
    serve = commands.add_parser("serve", help="serve the explorer")
    add_settings(serve)
    if serve.get_default("show") is None:
        serve.set_defaults(show=_at_a_screen())
    commands.add_parser("warm", help="compile the integrator into the disk cache, so that servers start warm")
    for add in (
        add_classify,
        add_prove,
        add_presets,
        add_figure,
        add_data,
        add_live,
        add_film,
        add_reference,
        add_census,
        add_notebooks,
        add_docs,
        add_kernels,
        add_static,
    ):
        add(commands)
    return top


def _at_a_screen() -> bool:
    screen = sys.platform in ("darwin", "win32") or "DISPLAY" in os.environ or "WAYLAND_DISPLAY" in os.environ
    return screen and sys.stdout.isatty()


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; return the exit status."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")  # a terminal that lacks Greek letters, as Windows' cp1252 does
    chosen = parser().parse_args(join_negative_numbers(sys.argv[1:] if arguments is None else arguments))
    if "run" in chosen:
        return _run_into_pipe(chosen)
    if chosen.command == "warm":
        return _warm()
    if multiprocessing.parent_process() is not None:
        raise RuntimeError('a worker imports the script that serves; put the call under if __name__ == "__main__":')
    if chosen.lessons is not None and not _offer_lessons(chosen.lessons):
        return 1
    for sentence in (*unknown_settings(), *extensions.register_all()):
        print(f"codim2: {sentence}", file=sys.stderr)
    docs_folder.serve_folder(chosen.docs)
    if chosen.docs is not None and docs_folder.site() is None:
        return _refuse(f"{chosen.docs} holds no site; build it: codim2 docs {chosen.docs}")
    log_to_stderr(chosen.log_json, chosen.log_level)
    try:
        _try_to_listen(chosen.address, chosen.port)
    except OSError as error:
        other = "--address" if isinstance(error, socket.gaierror) else "--port"
        return _refuse(f"cannot listen on {chosen.address}:{chosen.port}: {error.strerror}. Give another {other}.")
    if chosen.dask and chosen.processes > 1:
        return _refuse("--dask goes with one process; give no --processes.")
    stop_when_asked()
    with suppress(KeyboardInterrupt):
        try:
            _serve(chosen)
        except ClusterError as error:
            return _refuse(str(error))
    print("codim2: stopped", flush=True)
    os._exit(0)  # workers end with their server, and there is nothing to save: an orderly exit waits for both


def _refuse(why: str) -> int:
    """Say why nothing is served; return the exit status."""
    print(f"codim2: {why}", file=sys.stderr)
    return 1


def _run_into_pipe(chosen: argparse.Namespace) -> int:
    """Run a command; where who reads has enough, as `head` has, nothing is said."""
    try:
        status = chosen.run(chosen)
        sys.stdout.flush()
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # for what is left in the buffer
        return 0
    return status


def _warm() -> int:
    """Compile all kernels into the disk cache; print what takes how long."""
    from .kernel_cache import prepare

    uncached = prepare()
    from codim2_core.formulas.jit import policy

    from ..view.compiling.steps import warm_all

    with policy.in_thread(policy.COMPILE):
        warm_all(_say_compiled)
    if uncached:
        print(f"codim2: {uncached}", file=sys.stderr)
        return 1
    print("codim2: the integrator is compiled for all built-in regularisation functions")
    return 0


def _say_compiled(what: str, seconds: float, done: int, of: int) -> None:
    print(f"codim2: {done} of {of}: {what}: {seconds:.1f} s", flush=True)


def _say_if_compiled(what: str, seconds: float, done: int, of: int) -> None:
    """Say what had to be compiled: what is found on disk takes less than a second."""
    if seconds > 1.0:
        _say_compiled(f"compiled {what}", seconds, done, of)


def _serve(chosen: argparse.Namespace) -> None:
    """Serve until this process is interrupted."""
    many_files()
    gc.disable()  # modules are no garbage: looking for some is a fifth of the time that importing takes
    from .kernel_cache import prepare  # heavy, and not needed for --help

    if uncached := prepare():
        print(f"codim2: {uncached}", file=sys.stderr, flush=True)
    from .application import run
    from .page import make_server

    long: dict[str, Any] = {}
    if chosen.dask:
        long["executor"], long["at_once"] = dask_executor(chosen.dask)
    server = make_server(
        chosen.port,
        chosen.address,
        chosen.allow_origin,
        chosen.processes,
        workers=chosen.workers,
        prefix=chosen.prefix,
        frame_ancestors=chosen.frame_ancestors,
        sessions=chosen.sessions,
        per_address=chosen.per_address,
        proxied=chosen.proxied,
        rooms=chosen.rooms,
        report=_say_if_compiled,
        engine=None if chosen.pyodide is None else _engine(chosen.pyodide, chosen.kernels),
        **long,
    )
    everybody = chosen.address in ("0.0.0.0", "::")
    host = "localhost" if everybody else chosen.address
    whom = "everybody who reaches this machine" if everybody else "this machine only" if host == "localhost" else host
    print(f"codim2: the explorer is at http://{host}:{server.port}{server.prefix}/  (stop with Ctrl+C)", flush=True)
    names = ", ".join(chosen.allow_origin) or f"{host}:{server.port} only (--allow-origin names more)"
    print(f"codim2: version {version('codim2')}; listens for {whom}; pages work under {names}.", flush=True)
    gc.freeze()
    gc.enable()
    if chosen.show:
        server.io_loop.add_callback(webbrowser.open, f"http://{host}:{server.port}{server.prefix}/")
    run(server.io_loop)


def _engine(pyodide: Path, kernels: Path | None) -> Any:
    from ..site.wasm_kernels.build import FOLDER
    from .engine_files import EngineFiles

    try:
        return EngineFiles(pyodide, kernels or FOLDER)
    except (ValueError, OSError) as error:
        raise SystemExit(f"codim2: {error}") from None


def _offer_lessons(folder: Path) -> bool:
    """Offer the lessons of a folder; say what is wrong with those that cannot be read."""
    from ..lessons.library import add_lessons, from_folder

    try:
        found, errors = from_folder(folder)
    except ValueError as error:
        _refuse(str(error))
        return False
    for error in errors:
        print(f"codim2: left out: {error}")
    add_lessons(found)
    print(f"codim2: {len(found)} lesson{'s' * (len(found) != 1)} from {folder}")
    return True


def _try_to_listen(address: str, port: int) -> None:
    """Raise OSError before anything heavy is loaded if the address cannot be listened on."""
    family, kind, _, _, place = socket.getaddrinfo(address, port, type=socket.SOCK_STREAM)[0]
    with socket.socket(family, kind) as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        probe.bind(place)


if __name__ == "__main__":
    raise SystemExit(main())
