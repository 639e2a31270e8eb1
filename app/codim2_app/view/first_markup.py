"""A page before any script runs: its markup, and which scripts may run."""

from __future__ import annotations

import base64
import hashlib
import re

#: What a page is called, and where its markup is put.
TITLE = "Isolated codimension-2 discontinuity: explorer"
MARKUP = "<!-- codim2 markup -->"

_INLINE = re.compile(rb"<script(?![^>]*\bsrc=)(?![^>]*application/json)[^>]*>(.*?)</script>", re.DOTALL)

POLICY = (
    "default-src 'self'; script-src 'self'{hashes}; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; "
    "font-src 'self' data:; connect-src 'self'; worker-src 'self'; object-src 'none'; base-uri 'none'; "
    "form-action 'self'; frame-ancestors {ancestors}"
)


def policy(page: bytes, ancestors: str = "'self'") -> str:
    """Return the Content-Security-Policy of a page: its own inline scripts, by their hashes."""
    digests = (base64.b64encode(hashlib.sha256(script).digest()).decode() for script in _INLINE.findall(page))
    return POLICY.format(hashes="".join(f" 'sha256-{digest}'" for digest in digests), ancestors=ancestors)
