"""The command that tells motions whose values are known, and holds a solver against them."""

from __future__ import annotations

import argparse
import json
import sys
from typing import Any

import codim2_core as c2
from codim2_core.motion.reference import Comparison, ReferenceMotion
from codim2_core.motion.reference.mujoco import FOLLOWED, follow_in_mujoco


def add_reference(commands: Any) -> None:
    """Add `codim2 reference`."""
    command = commands.add_parser("reference", help="motions with friction whose values are known, against a solver")
    command.add_argument("name", nargs="?", help="one of them; left out, all are listed")
    command.add_argument("--engine", choices=("mujoco",), help=f"in place of this package: {', '.join(FOLLOWED)}")
    command.add_argument("--json", action="store_true", help="as JSON, with bounds of errors and formulas")
    command.set_defaults(run=reference)


def reference(chosen: argparse.Namespace) -> int:
    """Print the list, or one motion: what it is, and the values that are known next to those of a solver."""
    motions = c2.reference.catalogue
    if chosen.name is None:
        if chosen.json:
            print(json.dumps({key: motion.title for key, motion in motions.items()}))
            return 0
        wide = max(map(len, motions))
        for key, motion in motions.items():
            print(f"{key:{wide}}  {motion.title}")
        return 0
    if chosen.name not in motions:
        print(f"codim2: there is no motion {chosen.name!r}; choose one of {', '.join(motions)}.", file=sys.stderr)
        return 2
    motion = motions[chosen.name]
    try:
        found = follow_in_mujoco(motion) if chosen.engine else motion.compare()
    except ValueError as error:
        print(f"codim2: {error}", file=sys.stderr)
        return 2
    print(json.dumps(_motion_record(motion, found)) if chosen.json else _motion_lines(motion, found))
    return 0


def _motion_record(motion: ReferenceMotion, found: Comparison) -> dict[str, Any]:
    values = [
        {
            "name": known.name, "unit": known.unit, "value": known.value, "error": known.error,
            "formula": known.formula, "found": one.found, "difference": one.difference,
        }
        for known, one in zip(motion.values, found, strict=True)
    ]  # fmt: skip
    return {
        "key": motion.key, "title": motion.title, "sentence": motion.sentence, "source": motion.source,
        "solver": found.solver, "values": values,
    }  # fmt: skip


def _motion_lines(motion: ReferenceMotion, found: Comparison) -> str:
    wide = max(len(one.name) for one in found)
    rows = [
        f"  {one.name:{wide}}  {one.exact:.12g} {'' if one.unit == '1' else one.unit:3}  "
        f"{found.solver}: {one.found:.12g}, {one.difference:+.1e}"
        for one in found
    ]
    return "\n".join([motion.sentence, f"Source: {motion.source}.", *rows])
