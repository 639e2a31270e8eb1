"""What is said of periodic motions is held beside what is known of them."""

from pathlib import Path

from codim2_core.words import ROOMS

ROOT = Path(__file__).parents[2]
FORCED, FREE = "tests/core/motion/periodic/test_forced.py", "tests/core/motion/periodic/test_free.py"
HELD = {
    "repeats": FREE,
    "repeats sooner": FORCED,
    "periodic stable": FREE,
    "periodic unstable": FREE,
    "periodic undecided": FORCED,
    "periodic beside a line": FORCED,
    "start is lost": FREE,
    "not isolated": FORCED,
    "no periodic motion": FREE,
    "no derivative": FREE,
    "motion ends early": FREE,
    "comes to rest": FREE,
}


def test_every_sentence_of_a_periodic_motion_is_held():
    assert HELD.keys() == ROOMS["periodic"].keys()
    for key, path in HELD.items():
        assert f'"{key}"' in (ROOT / path).read_text(encoding="utf-8"), key
