# The explorer as a container: slim base, no root, kernels compiled at build time for a baseline processor, health check.
# It runs with a read-only root: docker run --read-only --user 10001 -p 5006:5006 codim2
# What is installed is pinned with hashes: .ci/lock writes the files.
# A tag moves: --build-arg PYTHON=python:3.12-slim@sha256:… builds on the base that you have looked at.
ARG PYTHON=python:3.12-slim
FROM ${PYTHON} AS wheel
COPY app/locked/build.txt /
RUN pip install --no-cache-dir --require-hashes -r /build.txt
COPY pyproject.toml README.md LICENSE /source/
COPY app /source/app
COPY codim2_core /source/codim2_core
RUN pip wheel --no-cache-dir --no-deps --no-build-isolation --wheel-dir /wheels /source

FROM ${PYTHON}
# What the kernels are compiled for: every server processor since 2015. On ARM: --build-arg KERNELS_FOR=generic
ARG KERNELS_FOR=x86-64-v3
ENV NUMBA_CPU_NAME=${KERNELS_FOR} \
    NUMBA_CPU_FEATURES="" \
    NUMBA_CACHE_DIR=/srv/codim2/kernels \
    PYTHONUNBUFFERED=1 \
    PYTHONDONTWRITEBYTECODE=1

RUN useradd --create-home --uid 10001 codim2
WORKDIR /srv/codim2
COPY app/locked/requirements.txt ./
COPY --from=wheel /wheels /wheels
# Tests, examples, stubs and source maps of the dependencies, a quarter of them all, are of no use here; nor is what
# Panel brings for maps, VTK, Perspective, editors and Plotly, 52 MB that no page of the explorer asks for.
RUN pip install --no-cache-dir --require-hashes -r requirements.txt \
    && pip install --no-cache-dir --no-deps /wheels/*.whl \
    && cd "$(python -c 'import panel; print(panel.__path__[0])')/.." \
    && find . -type d \( -name tests -o -name test \) -prune -exec rm -rf {} + \
    && find . \( -name "*.map" -o -name "*.pyi" \) -delete \
    && (cd panel/dist/bundled && rm -r deckglplot abstractvtkplot perspective aceplot plotlyplot) \
    && rm -r holoviews/examples \
    && codim2 warm

USER codim2
EXPOSE 5006
HEALTHCHECK --interval=15s --timeout=5s --start-period=20s \
    CMD python -c "import urllib.request as u; u.urlopen('http://127.0.0.1:${CODIM2_PORT:-${PORT:-5006}}/health', timeout=4)"
# Hosts that give a port say so in PORT. The name that visitors type must be allowed to open websockets: set CODIM2_ORIGINS=explorer.example.org
ENV CODIM2_ADDRESS=0.0.0.0
CMD ["codim2", "serve"]
