"""Frames of a fixed set of requests: run here and, with the kernels of a page without a server, in Pyodide."""

import random
from concurrent.futures import Executor, Future

DRAG = [{"set": {"f1": -0.5 + 0.1 * k}} for k in range(20)]
TYPED = {"system": "own", "texts": {"U1": "c - 3*s + mu + 0.1*c**3 + ellipe(c**2/2)", "U2": "3*c - s + tanh(x*y)"}}
PSI_TEXTS = ("1/(1+s)**2", "max(1 - s, 0)", "exp(-s)*(1 + sqrt(s))/2")
RANDOM_DRAGS, DRAGS_OF_ONE, RANDOM_SYSTEMS = 300, 10, 100
RANGES = {"a": (-3, 3), "b": (-3, 3), "d": (-3, 3), "f1": (-2, 2), "f2": (-2, 2), "n": (0.5, 6)}
TERMS = (
    "c", "s", "c*s", "c**2", "s**2", "c**3", "c*s**2", "sin(2*c)", "cos(s)", "exp(c/2)", "tanh(3*s)", "sqrt(1+c**2)",
)  # fmt: skip


def random_requests(seed):
    """Return drags of one control at a time, from portrait to portrait, and typed systems."""
    rng = random.Random(seed)
    presets = ("case1-cm4", "case1-cm0", "case2-saddle", "case3-n2", "case3-n3")
    found = []
    for k in range(RANDOM_DRAGS):
        if k % DRAGS_OF_ONE == 0:
            found.append({"set": {"preset": presets[k // DRAGS_OF_ONE % len(presets)]}, "rest": True})
            name = rng.choice(sorted(RANGES))
        found.append({"set": {name: rng.uniform(*RANGES[name])}})
    for _ in range(RANDOM_SYSTEMS):
        rows = ["+".join(f"({rng.gauss(0, 1):.4f})*{term}" for term in rng.sample(TERMS, 4)) for _ in range(2)]
        texts = {"U1": f"{rows[0]}+{rng.gauss(0, 0.3):.4f}", "U2": rows[1]}
        found.append({"set": {"system": "own", "texts": texts}, "rest": True})
    return found


def requests():
    """Return them: drags, all portraits, families of Psi, panels, typed formulas."""
    from codim2_app.panels.registry import PANELS_BY_NAME
    from codim2_app.picture.state.portraits import portrait_keys

    from codim2_core.systems.psi import FAMILIES

    chosen = [{"preset": key} for key in portrait_keys()]
    chosen += [{"preset": "case3-n3"}, *({"panel": name} for name in PANELS_BY_NAME)]
    chosen += [{"psi": name} for name, family in FAMILIES.items() if not family.typed]
    chosen += [{"psi": "custom", "psi_text": text} for text in PSI_TEXTS]
    chosen += [TYPED, *({"parameters": {"mu": 0.1 * k}} for k in range(5))]
    return [{"all": True}, *DRAG, *({"set": one, "rest": True} for one in chosen), *random_requests(38)]


class AtOnce(Executor):
    """Computes what it is given when it is given."""

    def submit(self, fn, /, *args, **kwargs):
        future = Future()
        try:
            future.set_result(fn(*args, **kwargs))
        except Exception as error:
            future.set_exception(error)
        return future


def frames():
    """Return the frame of each request, as bytes."""
    from codim2_app.picture.frame.background_results import serve_with
    from codim2_app.picture.frame.work_queue import WorkQueue
    from codim2_app.picture.state.controls import ExplorerState
    from codim2_app.view.refresh import Frames

    serve_with(WorkQueue(AtOnce()))
    page = Frames(ExplorerState())
    return [page.answer({"id": number, **request}) for number, request in enumerate(requests())]


def written():
    """Return the frames one after the other, each after its length."""
    return b"".join(len(one).to_bytes(4, "little") + one for one in frames())
