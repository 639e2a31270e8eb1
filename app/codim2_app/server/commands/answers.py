"""The commands that answer in the terminal: a portrait, a proof, what there is. None of them loads the server."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import Any

import codim2_core as c2
from codim2_core.results.paper import cite
from codim2_core.results.words import subscript
from codim2_core.systems.psi import FAMILIES

from .downloads import add_view, chosen_view
from .numbers import number, six


def add_classify(commands: Any) -> None:
    """Add `codim2 classify`."""
    command = commands.add_parser(
        "classify", help="name the portrait of a system, with its limit directions and critical sets"
    )
    add_view(command)
    _add_coefficients(command)
    command.add_argument("--json", action="store_true", help="as JSON")
    command.set_defaults(run=classify)


def add_prove(commands: Any) -> None:
    """Add `codim2 prove`."""
    command = commands.add_parser(
        "prove", help="prove a portrait: its limit directions, critical sets and limit cycles"
    )
    add_view(command)
    _add_coefficients(command)
    command.add_argument("-o", "--output", type=Path, metavar="FILE", help="write the certificate there")
    command.set_defaults(run=prove)


def _add_coefficients(command: Any) -> None:
    for name in ("a", "b", "d"):
        default = 0.0 if name == "b" else None
        command.add_argument(f"-{name}", type=number, default=default, help=f"{name} of A, in place of a view")
    for name in ("f1", "f2"):
        command.add_argument(f"--{name}", type=number, default=0.0)


def _chosen_problem(chosen: argparse.Namespace) -> tuple[Any, c2.Psi]:
    """Return the system, frozen at a z, and Psi that a command names: by coefficients, as a view or by equations."""
    if (chosen.a is None) != (chosen.d is None):
        raise ValueError("Only one of -a and -d is given; give both, or a preset, or equations with -U.")
    if chosen.a is not None:
        psi = c2.psi.from_text(chosen.psi)
        return c2.ELinear(chosen.a, chosen.b, chosen.d, (chosen.f1, chosen.f2)), psi
    problem = chosen_view(chosen).scene().problem
    return problem.at, problem.psi


def add_psi(command: argparse.ArgumentParser) -> None:
    """Add --psi."""
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


def classify(chosen: argparse.Namespace) -> int:
    """Print the portrait of a system."""
    try:
        system, psi = _chosen_problem(chosen)
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
        rates = f"λ_ρ = {six(equator.lambda_rho[i])}, λ_θ = {six(equator.lambda_theta[i])}"
        print(f"  Q{subscript(i + 1)}: θ = {six(theta)}, {rates}")
    for i, C in enumerate(critical):
        name = "C" if len(critical) == 1 else f"C{subscript(i + 1)}"
        place = f"e = ({six(C.e[0])}, {six(C.e[1])})"
        print(f"  {name}: {place}, {C.kind}, tr J = {six(C.trace)}, det J = {six(C.determinant)}")
    return 0


def prove(chosen: argparse.Namespace) -> int:
    """Print what is proved of a portrait; the status is 0 if it is how many limit cycles there are, else 1."""
    try:
        system, psi = _chosen_problem(chosen)
        found, proved = c2.limit_cycles(system, psi), c2.prove_portrait(system, psi)
    except ValueError as error:
        print(f"codim2: {error}", file=sys.stderr)
        return 2
    print(f"Limit cycles: {len(found)}. {proved.reason}")
    for i, (cycle, alone) in enumerate(zip(found, proved.cycles, strict=True)):
        line = f"{cycle.kind}, period {six(cycle.period)}, multiplier {six(cycle.multiplier)}"
        print(f"  cycle {i + 1}: {line}{', proved' if alone else ''}")
    directions, sets = proved.limit_directions, proved.critical_sets
    print("Limit directions: " + ("not proved" if directions is None else f"{len(directions)}, proved"))
    print("Critical sets: " + ("not proved" if sets is None else f"{', '.join(sets) or 'none'}; proved"))
    if chosen.output is not None and proved.certificate is None:
        print(f"codim2: {chosen.output} is not written: what is said above rests on no certificate.", file=sys.stderr)
        return 1
    if chosen.output is not None:
        proved.save(chosen.output)
        print(f"wrote {chosen.output}; to check it: {Path(sys.executable).name} {proved.checker()} < {chosen.output}")
    return 0 if proved else 1


def presets(chosen: argparse.Namespace) -> int:
    """Print the presets: key, the paper's label, title."""
    if chosen.json:
        print(json.dumps({key: {"label": p.label, "title": p.title} for key, p in c2.presets.items()}))
        return 0
    wide = max(map(len, c2.presets))
    for key, preset in c2.presets.items():
        print(f"{key:{wide}}  {preset.title}  ({cite(preset.label)})")
    return 0
