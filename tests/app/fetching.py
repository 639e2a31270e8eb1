"""Requests to an application of Tornado's, in a thread: a test in a browser may run a loop in this one."""

import asyncio
from concurrent.futures import ThreadPoolExecutor

from tornado.httpclient import AsyncHTTPClient
from tornado.httpserver import HTTPServer
from tornado.testing import bind_unused_port


def fetch_all(application, requests):
    """Return the answers to requests, (path, headers) each, one after the other; of any status, and not unpacked."""

    async def answers():
        sockets, port = bind_unused_port()
        server = HTTPServer(application)
        server.add_sockets([sockets])
        client = AsyncHTTPClient(force_instance=True)
        options = {"raise_error": False, "decompress_response": False}
        try:
            return [await client.fetch(f"http://127.0.0.1:{port}{path}", headers=headers, **options)
                    for path, headers in requests]  # fmt: skip
        finally:
            client.close()
            server.stop()
            await server.close_all_connections()

    with ThreadPoolExecutor(1) as pool:
        return pool.submit(asyncio.run, answers()).result()
