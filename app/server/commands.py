"""The commands that answer in the terminal, copy notebooks or build the site. None of them loads the server."""

from __future__ import annotations

import argparse
import json
import re
import shlex
import shutil
import sys
from collections.abc import Sequence
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import Any

import codim2_core as c2
from codim2_core.counting.draws import DRAWS
from codim2_core.paper import cite
from codim2_core.psi import FAMILIES
from codim2_core.words import subscript, written_number

from ..frame.dask_executor import ClusterError, dask_executor
from ..static_site.pyodide import VERSION

#: Where a site has its explorer without a server.
LIVE = "explorer-files/"
NOTEBOOKS = Path(__file__).parents[1] / "notebooks"


def add_classify(commands: Any) -> None:
    """Add `codim2 classify`."""
    command = commands.add_parser("classify", help="name the portrait of an e-linear system, and say what stands still")
    _add_system(command)
    command.add_argument("--json", action="store_true", help="as JSON")
    command.set_defaults(run=classify)


def add_prove(commands: Any) -> None:
    """Add `codim2 prove`."""
    command = commands.add_parser("prove", help="prove how many limit cycles an e-linear system has")
    _add_system(command)
    command.add_argument("-o", "--output", type=Path, metavar="FILE", help="write the certificate there")
    command.set_defaults(run=prove)


def _add_system(command: Any) -> None:
    for name in ("a", "b", "d"):
        command.add_argument(f"-{name}", type=number, required=name != "b", default=0.0, help=f"{name} of A")
    for name in ("f1", "f2"):
        command.add_argument(f"--{name}", type=number, default=0.0)
    _add_psi(command)


def _add_psi(command: argparse.ArgumentParser) -> None:
    known = ", ".join(
        family.name + (f":{family.parameter.name.upper()}" if family.parameter else "")
        for family in FAMILIES.values()
        if not family.typed
    )
    command.add_argument("--psi", default="1", help=f"{known}, or text in s; default 1")


def add_presets(commands: Any) -> None:
    """Add `codim2 presets`."""
    command = commands.add_parser("presets", help="list the paper's figures")
    command.add_argument("--json", action="store_true", help="as JSON")
    command.set_defaults(run=presets)


def add_census(commands: Any) -> None:
    """Add `codim2 census`."""
    command = commands.add_parser("census", help="count the portraits of systems drawn at random")
    told = (
        "normal (default): e-linear ones, of standard normal a, b, d, f₁, f₂; quadratic: in e, of twelve such numbers"
    )
    command.add_argument("--draw", choices=tuple(DRAWS), default="normal", help=told)
    command.add_argument("--count", type=_whole_number, default=1_000_000, help="default a million")
    command.add_argument("--seed", type=int, default=0)
    command.add_argument("--outcomes", action="store_true", help="name what becomes of arriving orbits too, under Ψ")
    _add_psi(command)
    command.add_argument("--processes", type=int, default=1)
    command.add_argument("--dask", metavar="ADDRESS", help="count on a Dask cluster: its scheduler's address")
    command.add_argument("--resume", metavar="FILE",
                         help="keep there what is counted, and go on from it if it is there")  # fmt: skip
    command.add_argument("--csv", metavar="FILE", help="write the table there too")
    command.set_defaults(run=census)


def add_notebooks(commands: Any) -> None:
    """Add `codim2 notebooks`."""
    command = commands.add_parser("notebooks", help="copy the notebooks: first steps, the paper, your own system")
    command.add_argument("folder", nargs="?", type=Path, default=Path("codim2-notebooks"), metavar="DIR",
                         help="default codim2-notebooks; notebooks that are there already are kept")  # fmt: skip
    command.set_defaults(run=notebooks)


def add_docs(commands: Any) -> None:
    """Add `codim2 docs`."""
    command = commands.add_parser("docs", help="build the site that the explorer serves at /docs/")
    command.add_argument("folder", nargs="?", type=Path, metavar="DIR",
                         help="default the package's own; `codim2 serve --docs DIR` serves another")  # fmt: skip
    _add_release(command, required=False)
    command.set_defaults(run=docs)


def add_kernels(commands: Any) -> None:
    """Add `codim2 kernels`."""
    command = commands.add_parser("kernels", help="compile the core for pages without a server (WebAssembly): minutes")
    command.add_argument("folder", nargs="?", type=Path, metavar="DIR", help="default the package's own")
    command.set_defaults(run=kernels)


def kernels(chosen: argparse.Namespace) -> int:
    """Run `codim2 kernels`."""
    from ..wasm_kernels.build import FOLDER, build_kernels, extract_all, missing

    if missing():
        print("codim2: give this Python ziglang, which is clang and a linker: pip install ziglang", file=sys.stderr)
        return 1
    folder = chosen.folder or FOLDER
    build_kernels(folder, extract_all())
    print(f"codim2: {folder / 'kernels.so'}: {(folder / 'kernels.so').stat().st_size / 1000:.0f} kB")
    return 0


def add_static(commands: Any) -> None:
    """Add `codim2 static`."""
    command = commands.add_parser("static", help="write the explorer as a folder of files, which needs no server")
    command.add_argument("-o", "--output", type=Path, required=True, metavar="DIR", help="write the folder there")
    _add_release(command, required=True)
    command.set_defaults(run=static)


def _add_release(command: Any, required: bool) -> None:
    words = f"holds the release of Pyodide {VERSION}, and its wheel of NumPy" + "; pictures then move" * (not required)
    command.add_argument("--pyodide", type=Path, required=required, metavar="DIR", help=words)
    command.add_argument("--kernels", type=Path, metavar="DIR",
                         help="holds what `codim2 kernels` has written; default the package's own")  # fmt: skip


def number(text: str) -> float:
    """Read a number as the page does: -.5, 1e-3, −7,5; and a fraction, -2/3."""
    top, _, bottom = text.strip().replace("−", "-").replace(",", ".").partition("/")
    try:
        return float(top) / float(bottom or 1)
    except (ValueError, ZeroDivisionError):
        raise argparse.ArgumentTypeError(f"{text!r} given; give a number such as -0.5, 1e-3 or 2/3.") from None


def join_negative_numbers(words: Sequence[str]) -> list[str]:
    """Join an option and the negative number after it, which argparse takes for an option: "-d", "-1e-3"."""
    joined: list[str] = []
    for word in words:
        negative = re.match(r"[-−][.\d]", word)
        if negative and joined and joined[-1].startswith("-") and "=" not in joined[-1]:
            joined[-1] += f"={word}"
        else:
            joined.append(word)
    return joined


def _whole_number(text: str) -> int:
    value = number(text)
    if not value.is_integer():
        raise argparse.ArgumentTypeError(f"{text} is no whole number")
    return int(value)


def classify(chosen: argparse.Namespace) -> int:
    """Print the portrait of one system."""
    try:
        psi = c2.psi.from_text(chosen.psi)
        system = c2.ELinear(chosen.a, chosen.b, chosen.d, (chosen.f1, chosen.f2))
        found = c2.classify(system, psi)
    except ValueError as error:
        print(f"codim2: {error}", file=sys.stderr)
        return 2
    equator, critical = c2.equator_equilibria(system), c2.critical_sets(system, psi)
    if chosen.json:
        print(
            json.dumps(
                {
                    "case": found.case,
                    "name": found.name,
                    "sentence": found.sentence,
                    "degeneracies": [item.name for item in found.degeneracies],
                    "limit_directions": [
                        {"theta": t, "lambda_rho": r, "lambda_theta": a}
                        for t, r, a in zip(
                            equator.theta.tolist(),
                            equator.lambda_rho.tolist(),
                            equator.lambda_theta.tolist(),
                            strict=True,
                        )
                    ],
                    "critical_sets": [
                        {"e": list(map(float, C.e)), "kind": C.kind, "trace": C.trace, "determinant": C.determinant}
                        for C in critical
                    ],
                }
            )
        )
        return 0
    print(found.sentence)
    for item in found.degeneracies:
        print(f"  {item.name}: {item.sentence}")
    for i, theta in enumerate(equator.theta.tolist()):
        rates = f"λ_ρ = {_six(equator.lambda_rho[i])}, λ_θ = {_six(equator.lambda_theta[i])}"
        print(f"  Q{subscript(i + 1)}: θ = {_six(theta)}, {rates}")
    for C in critical:
        place = f"e = ({_six(C.e[0])}, {_six(C.e[1])})"
        print(f"  C: {place}, {C.kind}, tr J = {_six(C.trace)}, det J = {_six(C.determinant)}")
    return 0


def prove(chosen: argparse.Namespace) -> int:
    """Print how many limit cycles one system has, and whether that is proved: then the status is 0, else 1."""
    try:
        psi = c2.psi.from_text(chosen.psi)
        system = c2.ELinear(chosen.a, chosen.b, chosen.d, (chosen.f1, chosen.f2))
        found = c2.limit_cycles(system, psi, prove=True)
    except ValueError as error:
        print(f"codim2: {error}", file=sys.stderr)
        return 2
    proved = found.proved
    assert proved is not None
    print(f"Limit cycles: {len(found)}. {proved.reason}")
    for i, (cycle, alone) in enumerate(zip(found, proved.cycles, strict=True)):
        told = f"{cycle.kind}, period {_six(cycle.period)}, multiplier {_six(cycle.multiplier)}"
        print(f"  cycle {i + 1}: {told}{', proved' if alone else ''}")
    if chosen.output is not None and proved.certificate is None:
        print(f"codim2: {chosen.output} is not written: what is said above rests on no certificate.", file=sys.stderr)
        return 1
    if chosen.output is not None:
        proved.save(chosen.output)
        print(f"wrote {chosen.output}; to check it: {Path(sys.executable).name} {proved.checker()} < {chosen.output}")
    return 0 if proved else 1


def _six(value: float) -> str:
    return written_number(float(value), 6)


def presets(chosen: argparse.Namespace) -> int:
    """Print the presets: key, the paper's label, title."""
    if chosen.json:
        print(json.dumps({key: {"label": p.label, "title": p.title} for key, p in c2.presets.items()}))
        return 0
    wide = max(map(len, c2.presets))
    for key, preset in c2.presets.items():
        print(f"{key:{wide}}  {preset.title}  ({cite(preset.label)})")
    return 0


def census(chosen: argparse.Namespace) -> int:
    """Print the table of a census."""

    def progress(done: int, count: int) -> None:
        if sys.stderr.isatty():
            print(f"\r{done / count:6.1%}", end="", file=sys.stderr, flush=True)

    if chosen.dask and chosen.processes > 1:
        print("codim2: --dask has processes of its own; give no --processes.", file=sys.stderr)
        return 2
    try:
        with _executor(chosen) as executor:
            found = c2.census(
                chosen.draw, c2.psi.from_text(chosen.psi), chosen.count, seed=chosen.seed, outcomes=chosen.outcomes,
                resume=chosen.resume, executor=executor, progress=progress,
            )  # fmt: skip
    except (ValueError, ClusterError) as error:
        print(f"codim2: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print(f"\ncodim2: stopped; {chosen.resume} keeps what is counted." if chosen.resume else "\ncodim2: stopped.",
              file=sys.stderr)  # fmt: skip
        return 130
    wide = max(len(row.name) for row in found.table)
    if found.contradictions:
        print(f"codim2: {found.contradictions} systems contradict index theory; please report this.", file=sys.stderr)
    if chosen.csv:
        found.to_csv(chosen.csv)
    print(f"\r{'portrait':{wide}} {'count':>12} {'share':>9}  95 % interval")
    for row in found.table:
        print(f"{row.name:{wide}} {row.count:12d} {row.share:9.5f}  {row.low:.5f} to {row.high:.5f}")
    return 0


def _executor(chosen: argparse.Namespace) -> AbstractContextManager[Executor | None]:
    """Return what counts: this process, several, or a cluster."""
    if chosen.dask:
        return dask_executor(chosen.dask)[0]
    return ProcessPoolExecutor(chosen.processes) if chosen.processes > 1 else nullcontext()


def notebooks(chosen: argparse.Namespace) -> int:
    """Copy the notebooks into a folder, and say how they are opened."""
    try:
        chosen.folder.mkdir(parents=True, exist_ok=True)
        for notebook in sorted(NOTEBOOKS.glob("*.ipynb")):
            place = chosen.folder / notebook.name
            if place.exists():
                print(f"{place} is there already, and kept")
            else:
                shutil.copyfile(notebook, place)
                print(place)
    except OSError as error:
        print(f"codim2: {chosen.folder} cannot be written: {error.strerror}.", file=sys.stderr)
        return 1
    print(f"Open them with: jupyter lab {shlex.quote(str(chosen.folder))}")
    return 0


def _write_static(folder: Path, chosen: argparse.Namespace) -> int | None:
    """Write the folder, and return its size; say what is wrong where it cannot be written."""
    from ..static_site.folder import write_folder
    from ..wasm_kernels.build import FOLDER

    try:
        return write_folder(folder, chosen.pyodide, chosen.kernels or FOLDER)
    except (ValueError, OSError) as error:
        print(f"codim2: {error}", file=sys.stderr)
        return None


def static(chosen: argparse.Namespace) -> int:
    """Write the folder, and say how large it is."""
    size = _write_static(chosen.output, chosen)
    if size is None:
        return 1
    print(f"{chosen.output}: {size / 1e6:.0f} MB; put the folder on any web space, or see it here:")
    print(f"  python -m http.server -d {shlex.quote(str(chosen.output))}")
    return 0


def docs(chosen: argparse.Namespace) -> int:
    """Build the site."""
    from ..docs.build import main
    from ..docs.docs_folder import PACKAGED_SITE

    folder = PACKAGED_SITE if chosen.folder is None else chosen.folder
    if chosen.pyodide is None:
        return main(folder)
    return main(folder, LIVE) or int(_write_static(folder / LIVE, chosen) is None)
