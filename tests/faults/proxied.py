"""A visitor at an address, as a browser comes there: the page, its websocket from that origin, and a frame.

``python -m tests.faults.proxied ADDRESS`` prints the slow flow of a frame, where there is no test: on another root.
"""

import asyncio
import ssl
import sys
from urllib.parse import urlsplit
from urllib.request import urlopen

from codim2_app.picture.draw.packing import unpack
from tornado.httpclient import HTTPRequest

from tests.benchmarks.wire import Wire

SETTING, SLOW_FLOW = "?a=-1&b=1&d=-1&f1=0", [0.0]


async def slow_flow_at(address):
    """Open the page of an address, which ends in a slash, and return the slow flow of its frame."""
    trusting = ssl.create_default_context()
    trusting.check_hostname, trusting.verify_mode = False, ssl.CERT_NONE
    with urlopen(address + SETTING, context=trusting) as answer:
        page = answer.read().decode()
    assert 'role="alert" style' not in page  # the name is allowed
    place = urlsplit(address)
    headers = {"Origin": f"{place.scheme}://{place.netloc}"}
    socket = f"{address.replace('http', 'ws', 1)}live{SETTING}"
    wire = await Wire.at(HTTPRequest(socket, headers=headers, validate_cert=False))
    try:
        header, _ = unpack(await wire.frame(1))
    finally:
        await wire.close()  # also where its server has ended
    return header["slow_flow"]


if __name__ == "__main__":
    print(asyncio.run(slow_flow_at(sys.argv[1])))
