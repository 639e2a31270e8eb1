"""The command, as ``python -m codim2_app``."""

from .server.cli import main

if __name__ == "__main__":
    raise SystemExit(main())
