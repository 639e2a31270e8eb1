"""Long work on a Dask cluster: an executor like any other, whose workers have this package installed."""

from __future__ import annotations

from concurrent.futures import Executor
from typing import Any

SCHEDULER_TIMEOUT = 10  # seconds for a scheduler to answer


class ClusterError(Exception):
    """There is no cluster to work on: what is missing, in a sentence."""


def dask_executor(address: str) -> tuple[Executor, int]:
    """Return the executor of a Dask cluster, and how many works it does at a time.

    Parameters
    ----------
    address : str
        Of its scheduler, as ``tcp://10.0.0.1:8786``.

    Raises
    ------
    ClusterError
        Dask is not installed, or no scheduler answers.
    """
    try:
        from distributed import Client  # pyright: ignore[reportMissingImports] (extra dask)
    except ImportError:
        raise ClusterError("--dask needs Dask: install codim2[dask].") from None
    try:
        client = Client(address, timeout=SCHEDULER_TIMEOUT, set_as_default=False)
    except (OSError, ValueError):
        raise ClusterError(f"no Dask scheduler answers at {address}; give its address as tcp://HOST:PORT.") from None
    threads: Any = client.nthreads()  # not a coroutine: this client has a thread for its own
    return client.get_executor(), max(1, sum(threads.values()))
