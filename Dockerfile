# The explorer as a container: slim base, no root, compiled steps warmed at build time, and a health check.
FROM python:3.12-slim

RUN useradd --create-home --uid 10001 codim2
WORKDIR /srv/codim2
COPY pyproject.toml README.md LICENSE ./
COPY app app
COPY codim2_core codim2_core
RUN pip install --no-cache-dir .

USER codim2
ENV NUMBA_CACHE_DIR=/home/codim2/.cache/numba \
    PYTHONUNBUFFERED=1
RUN codim2 warm

EXPOSE 5006
HEALTHCHECK --interval=15s --timeout=5s --start-period=20s \
    CMD python -c "import urllib.request as u; u.urlopen('http://127.0.0.1:5006/health', timeout=4)"
# The address that visitors type must be allowed to open websockets: set CODIM2_ORIGINS=explorer.example.org
CMD ["codim2", "serve", "--address", "0.0.0.0", "--port", "5006"]
