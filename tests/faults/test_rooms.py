"""The limits of rooms over real websockets: each is told in one sentence, and leaves no traceback."""

import asyncio

import pytest
from codim2_app.draw.packing import unpack
from codim2_app.phrases import say
from codim2_app.rooms.rooms import LONGEST_ROW, MOST_GUESTS, MOST_ROOMS, MOST_TRIES

from tests.app.serving import serving
from tests.benchmarks.bokeh_wire import Wire


@pytest.fixture
def server(tmp_path):
    """The address of a server whose log holds no traceback in the end."""
    log = tmp_path / "log.txt"
    with serving(log=log) as address:
        yield address
    assert "Traceback" not in log.read_text()


def played(talk):
    """Run what pages say to a server; in the end all of them go."""

    async def whole():
        try:
            await talk()
        finally:
            while pages:
                await pages.pop().vanish()

    asyncio.run(whole())


pages: list[Wire] = []


async def opened(address):
    wire = await Wire.connect(address.port)
    pages.append(wire)
    await wire.frame(1, a=-1.5)
    return wire


async def lecturing(address):
    wire = await opened(address)
    return wire, (await wire.ask("room", {"open": ""}))["open"]


async def told(wire, key):
    """What a page is told next under a key of the room's messages."""
    while key not in (answer := await asyncio.wait_for(wire.heard("room"), 30)):
        pass
    return answer[key]


def test_a_room_is_full_and_its_lecturer_sees_all_of_it(server):
    async def talk():
        lecturer, code = await lecturing(server)
        phones = [await opened(server) for _ in range(MOST_GUESTS + 1)]
        for phone in phones[:-1]:
            assert await phone.ask("room", {"join": code}) == {"joined": code}
        assert await phones[-1].ask("room", {"join": code}) == {"error": say("room full", most=MOST_GUESTS)}
        while len(await told(lecturer, "rows")) < MOST_GUESTS:
            pass
        await phones[0].vanish()  # one goes, and there is a place
        while len(await told(lecturer, "rows")) == MOST_GUESTS:
            pass
        assert await phones[-1].ask("room", {"join": code}) == {"joined": code}

    played(talk)


def test_no_more_rooms_than_there_may_be_until_one_ends(server):
    async def talk():
        lecturers = [await lecturing(server) for _ in range(MOST_ROOMS)]
        late = await opened(server)
        assert await late.ask("room", {"open": ""}) == {"error": say("all rooms taken", most=MOST_ROOMS)}
        first, code = lecturers[0]
        await first.event("data_event", first.root, data={"room": {"close": True}})
        assert await told(first, "ended") == code
        assert "open" in await late.ask("room", {"open": ""})

    played(talk)


def test_settings_that_are_too_long_are_a_phone_that_is_counted(server):
    async def talk():
        lecturer, code = await lecturing(server)
        phone = await opened(server)
        await phone.ask("room", {"join": code})
        [[_, _, settings, _]] = await told(lecturer, "rows") or await told(lecturer, "rows")
        assert settings == {"a": -1.5}
        long = "c" + "+0*c" * (LONGEST_ROW // 9)
        texts = {"U1": long, "U2": f"-s + {long}", "W": long}  # each may be written, all are too long for a row
        header, _ = unpack(await phone.frame(2, system="own", texts=texts))
        assert not any(header["errors"].values())
        [[_, _, settings, _]] = await told(lecturer, "rows")
        assert settings is None

    played(talk)


def test_a_room_that_has_ended_and_a_wrong_code_are_told_and_codes_are_not_guessed(server):
    async def talk():
        lecturer, code = await lecturing(server)
        phone = await opened(server)
        assert await phone.ask("room", {"join": "ZZZZ"}) == {"error": say("no such room", code="ZZZZ")}
        assert await phone.ask("room", {"join": code.lower()}) == {"joined": code}
        await lecturer.ask("room", {"close": True})
        assert await told(phone, "ended") == code
        assert await phone.ask("room", {"join": code}) == {"error": say("no such room", code=code)}
        for _ in range(MOST_TRIES - 3):
            await phone.ask("room", {"join": "ZZZZ"})
        assert await phone.ask("room", {"join": "ZZZZ"}) == {"error": say("too many codes")}
        header, _ = unpack(await phone.frame(9, a=-1.25))  # its page goes on
        assert header["id"] == 9

    played(talk)
