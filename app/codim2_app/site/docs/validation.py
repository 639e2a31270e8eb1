"""The page that holds this package against motions whose values are known: computed as the site is built."""

from __future__ import annotations

from codim2_core.motion.reference import ReferenceMotion, catalogue

HEAD = """# Validation

Motions with dry friction whose values are known, in closed form or to twelve digits by an independent computation, and
how far from these `simulate_nonsmooth`, `periodic_motion` and `equator_equilibria` are. The page was computed as it was
built. `codim2 reference NAME` computes a motion again, `--json` writes it with bounds of its errors, and
`--engine mujoco` scores MuJoCo instead. `codim2_core.motion.reference` holds any other solver against them:

```python
from codim2_core import reference

box = reference.catalogue["box-stops"]
for row in box.compare(lambda: (1.22, 3.67), solver="mine"):
    print(row.name, row.exact, row.difference)
```
"""
TABLE = "| value | | is | off by | how it is known |\n|---|---|---|---|---|\n"


def validation_page() -> str:
    """Return the page as Markdown, all motions computed."""
    return "\n".join([HEAD, *map(_section, catalogue.values())])


def _section(motion: ReferenceMotion) -> str:
    rows = [
        f"| {known.name} | {'' if known.unit == '1' else known.unit} | {known.value:.12g} | {one.difference:.0e} "
        f"| {known.formula} |".replace("|w|", "\\|w\\|").replace("|(x, y)|", "\\|(x, y)\\|")
        for known, one in zip(motion.values, motion.compare(), strict=True)
    ]
    heading = f"## {motion.title}\n\n{motion.sentence} `{motion.key}`, after {motion.source}.\n\n"
    return heading + TABLE + "\n".join(rows) + "\n"
