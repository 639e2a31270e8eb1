"""What a page that sets something is answered."""

from codim2_app.picture.draw.packing import unpack


def ask(frames, **values):
    """Set these values; return the header of the frame, and the names of the layers that were sent."""
    header, blocks = unpack(frames.answer({"id": 1, "set": values}))
    return header, {name.split(".")[0] for name in blocks}
