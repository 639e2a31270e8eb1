"""QR codes as the page draws them, next to those of another program."""

import json
import subprocess
from unittest.mock import patch

import segno

from .test_modules import STATIC

SCRIPT = """
import {MAX_QR_BYTES, qrSquares} from %s
const longest = Array.from({length: MAX_QR_BYTES}, (_, i) => "a?&=-abcXYZ09%%_."[(i * i + (i >> 3)) %% 16]).join("")
const found = {}
for (let bytes = 1; bytes <= MAX_QR_BYTES; bytes += Math.ceil(bytes / 26)) {
  const text = longest.slice(0, bytes)
  found[text] = qrSquares(text).map((row) => row.map(Number))
}
let refused = false
try { qrSquares("x".repeat(MAX_QR_BYTES + 1)) } catch (error) { refused = error instanceof RangeError }
console.log(JSON.stringify([found, refused]))
"""


def code_of(text):
    """Return the squares of a code; Segno writes a byte of padding where none is wanted, which the standard has not."""
    padded = lambda buffer, version, length: buffer.extend([0] * (-length % 8))
    with patch("segno.encoder.write_padding_bits", padded):
        return [list(row) for row in segno.make_qr(text, error="l", boost_error=False, mode="byte", mask=0).matrix]


def test_codes_are_those_of_another_program(node):
    """Texts of a few bytes, and of every version."""
    script = SCRIPT % json.dumps((STATIC / "page" / "qr_code.js").as_uri())
    done = subprocess.run([node, "--input-type=module", "-e", script], capture_output=True, text=True, check=True)
    found, refused = json.loads(done.stdout)
    for text, squares in found.items():
        assert squares == code_of(text), text
    assert {len(squares) for squares in found.values()} == set(range(21, 178, 4))  # of every version
    assert refused
