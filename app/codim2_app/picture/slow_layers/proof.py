"""The proof of how many limit cycles a scene has: what is proved, the certificate, and the program that checks it."""

from __future__ import annotations

import json
from pathlib import Path

from codim2_core.portrait.cycles.limit_cycles import proof_of
from codim2_core.results.words import printed_sentence
from codim2_core.scene import Scene


def proof(scene: Scene) -> bytes:
    """Search for a proof; return, as JSON, what `Proof` holds, and the text of the checker next to a certificate."""
    found = proof_of(scene.problem)
    checker = None if found.certificate is None else Path(found.checker()).read_text(encoding="utf-8")
    return json.dumps(
        {
            "whole": found.whole,
            "cycles": found.cycles,
            "sentence": printed_sentence(found.reason),
            "certificate": found.certificate,
            "checker": checker,
        }
    ).encode()
