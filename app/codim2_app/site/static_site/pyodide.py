"""The release of Pyodide that a folder holds: which files, and how each is known to be the one that was tried."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from pathlib import Path

VERSION, PYTHON = "0.27.7", "python3.12"
NUMPY = "numpy-2.0.2-cp312-cp312-pyodide_2024_0_wasm32.whl"
#: SHA-256 of each file.
DIGESTS = {
    "pyodide.mjs": "04c052c815abb0bf2981fa38c2dfa58e3120ee5288c956df2b2a15e301782c5f",
    "pyodide.asm.js": "6b4c90de5b7172873f04f21884d0e9d2274e305fe32116558fe3e4fbe3618d51",
    "pyodide.asm.wasm": "a50dd1843f805a0b7c45b61037ee0d7b26dfe85efe0e18ef95a34ad24e401f5f",
    "python_stdlib.zip": "16611534726e5d8ac2bd8f926410b2dcb8d6f49aa24913463533b457a2115c16",
    NUMPY: "ebb61241d962b98b21597d7ce43b67668a6d5bab3acec4fbe958657320d7cd08",
}
#: Pyodide's list of packages, of which NumPy is the only one here.
LOCK = {
    "info": {
        "abi_version": "2024_0",
        "arch": "wasm32",
        "platform": "emscripten_3_1_58",
        "python": "3.12.7",
        "version": VERSION,
    },
    "packages": {
        "numpy": {
            "depends": [],
            "file_name": NUMPY,
            "imports": ["numpy"],
            "install_dir": "site",
            "name": "numpy",
            "package_type": "package",
            "sha256": DIGESTS[NUMPY],
            "unvendored_tests": True,
            "version": "2.0.2",
        }
    },
}


def copied_files(release: Path) -> Iterator[tuple[str, bytes]]:
    """Yield the name and the content of each file of the release.

    Raises
    ------
    ValueError
        One is missing, or another.
    """
    for name, digest in DIGESTS.items():
        path = release / name
        if not path.is_file():
            raise ValueError(f"{release} holds no {name}; give the folder of Pyodide {VERSION}'s release.")
        data = path.read_bytes()
        if hashlib.sha256(data).hexdigest() != digest:
            raise ValueError(f"{path} is not that of Pyodide {VERSION}.")
        yield name, data
