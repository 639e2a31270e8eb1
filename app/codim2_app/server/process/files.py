"""Raise the limit of open files to the hard one: each page is one, and a shell allows 256 or 1024 by default."""

from __future__ import annotations

from contextlib import suppress

try:
    import resource
except ImportError:  # Windows
    resource = None


def many_files() -> None:
    """Raise the limit of this process, and of those that it starts, to what it may be."""
    if resource is not None:
        _, most = resource.getrlimit(resource.RLIMIT_NOFILE)
        with suppress(ValueError, OSError):  # macOS names a limit that it does not allow
            resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))


def max_files() -> int:
    """Return how many files this process may have open, as far as that is bounded."""
    most = 512 if resource is None else resource.getrlimit(resource.RLIMIT_NOFILE)[0]
    return most if most > 0 else 2**20
