"""Where labels stand: on nothing that is there, in the drawing, and as near to their marks as that allows."""

import numpy as np
import pytest
from codim2_app.picture.draw.vector.labels import LABEL_OFFSETS, LabelBox, clear_of, width_of

SIZE = 10.0


@pytest.mark.parametrize("anchor", ["start", "middle"])
def test_a_label_stands_where_it_would_if_there_is_room(anchor):
    wide = width_of("Q₁", SIZE)
    box = clear_of([], "Q₁", 50.0, 40.0, anchor, SIZE, 100.0, 80.0)
    assert box.x == pytest.approx(50.0 if anchor == "start" else 50.0 - wide / 2)
    assert (box.width, box.height) == (pytest.approx(wide), pytest.approx(1.1 * SIZE))
    assert box.y + box.height / 2 == pytest.approx(40.0)


def test_a_label_next_to_its_mark_may_stand_on_the_other_side():
    """To the right all is taken: it ends left of the mark, as far from it as it would begin right of it."""
    wide = width_of("C ⊙", SIZE)
    box = clear_of([LabelBox(45.0, 0.0, 55.0, 80.0)], "C ⊙", 60.0, 40.0, "start", SIZE, 100.0, 80.0)
    assert box.x + wide == pytest.approx(60.0 - 2.0 * SIZE)
    assert box.y + box.height / 2 == pytest.approx(40.0)
    in_the_middle = clear_of([LabelBox(45.0, 0.0, 55.0, 80.0)], "C ⊙", 60.0, 40.0, "middle", SIZE, 100.0, 80.0)
    assert in_the_middle.x + wide <= 45.0


def test_labels_avoid_what_is_taken_and_stay_in_the_drawing():
    rng = np.random.default_rng(8)
    for _ in range(60):
        taken = [LabelBox(*rng.uniform((0, 0), (180, 130)), *rng.uniform(5, 25, 2)) for _ in range(6)]
        x, y = rng.uniform((0, 0), (200, 150))
        box = clear_of(taken, "Q₁", x, y, "middle", SIZE, 200.0, 150.0)
        wide, high = width_of("Q₁", SIZE), 1.1 * SIZE
        free = [
            (across, up)
            for across, up in LABEL_OFFSETS
            if (one := LabelBox(x - wide / 2 + across * SIZE, y - high / 2 + up * SIZE, wide, high)).fits(200.0, 150.0)
            and not any(one.meets(other) for other in taken)
        ]
        assert free
        assert (box.x, box.y) == pytest.approx((x - wide / 2 + free[0][0] * SIZE, y - high / 2 + free[0][1] * SIZE))
    full = clear_of([LabelBox(0.0, 0.0, 200.0, 150.0)], "Q₁", 70.0, 40.0, "start", SIZE, 200.0, 150.0)
    assert (full.x, full.y) == pytest.approx((70.0, 40.0 - 0.55 * SIZE))  # nowhere: it stands where it would
