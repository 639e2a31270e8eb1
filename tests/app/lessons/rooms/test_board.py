"""Memory that processes share: each writes its part, all read all."""

import os
import random
import string

import pytest
from codim2_app.lessons.rooms import board as module
from codim2_app.lessons.rooms.board import SEGMENT_BYTES, SEGMENT_HEAD, SILENT, Board


def told(board, now=1.0):
    return {index: what for index, _, what in board.read(now)}


def test_each_process_writes_its_part_and_reads_all():
    board = Board(3)
    board.belong(0)
    child = os.fork()
    if child == 0:
        board.belong(2)
        os._exit(0 if board.write({"from": "two"}, 1.0) and told(board) == {2: {"from": "two"}} else 1)
    assert os.waitpid(child, 0)[1] == 0
    assert told(board) == {2: {"from": "two"}}
    board.write({"from": "none"}, 1.0)
    assert told(board) == {0: {"from": "none"}, 2: {"from": "two"}}


def test_what_is_half_written_is_as_it_was_before():
    board = Board()
    board.write({"a": 1}, 1.0)
    assert told(board) == {0: {"a": 1}}
    when, count, size, check = SEGMENT_HEAD.unpack_from(board._memory, 0)
    SEGMENT_HEAD.pack_into(board._memory, 0, when, count + 1, size, check ^ 1)
    assert told(board) == {0: {"a": 1}}
    fresh = Board()
    fresh._memory = board._memory
    assert told(fresh) == {}


@pytest.mark.parametrize(("later", "there"), [(SILENT, True), (SILENT + 0.1, False)])
def test_a_process_that_writes_no_more_has_ended(later, there):
    board = Board()
    board.write({}, 1.0)
    assert bool(told(board, 1.0 + later)) == there


def test_what_is_too_long_is_refused_and_one_that_is_started_again_begins_with_nothing():
    board = Board(2)
    board.belong(1)
    assert not board.write({"long": os.urandom(SEGMENT_BYTES).hex()}, 1.0)
    assert board.write({"short": 1}, 1.0)
    board.belong(1)
    assert told(board) == {}


def test_what_fits_is_read_by_all_and_writes_over_nobody(monkeypatch):
    monkeypatch.setattr(module, "SEGMENT_BYTES", 100)
    board, fits = Board(2), []
    words = "".join(random.Random(1).choices(string.ascii_letters, k=200))  # which cannot be packed by much
    for length in range(40, 140):
        board.belong(1)
        board.write({"next": 1}, 1.0)
        board.belong(0)
        fits.append(board.write({"a": words[:length]}, 1.0))
        assert told(board) == {1: {"next": 1}} | ({0: {"a": words[:length]}} if fits[-1] else {})
    assert fits[0]
    assert not fits[-1]
