"""QR codes of links, for the phones in the room."""

from __future__ import annotations

import io

import segno
from tornado.web import HTTPError, RequestHandler

LONGEST = 2000  # bytes; beyond it phones no longer read the code from a beamer


class QrCode(RequestHandler):
    """Answers ``qr.svg?text=...`` with the text as a QR code: dark squares on white, in either theme."""

    def get(self) -> None:
        """Send the code; 400 if the text is empty or too long for a phone to read."""
        text = self.get_query_argument("text", "")
        if not 0 < len(text.encode()) <= LONGEST:
            raise HTTPError(400, reason="give a text of 1 to 2000 bytes")
        picture = io.BytesIO()
        segno.make_qr(text, error="l").save(picture, kind="svg", border=3, light="#fff", xmldecl=False, omitsize=True)
        self.set_header("Content-Type", "image/svg+xml")
        self.set_header("Cache-Control", "private, max-age=3600")
        self.finish(picture.getvalue())
