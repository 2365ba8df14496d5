"""The poses that are asked for one at a time: ordinary ones, singular ones, and some at every distance from these."""

from __future__ import annotations

import numpy as np
import pytest

from kinsym.check.poses import DISTANCES, KINDS, QUARTER, SINGULAR, UNIFORM, Samples
from kinsym.check.questions import ORDINARY_POSES, SPECIAL_POSES, asked


def samples(special: int) -> Samples:
    """A hundred ordinary joint vectors, and special ones at one distance after the other."""
    kind = np.repeat([KINDS.index(UNIFORM), KINDS.index(SINGULAR), KINDS.index(QUARTER)], [100, special, special])
    offset = np.concatenate([np.full(100, np.inf), *2 * [np.resize(DISTANCES, special)]])
    return Samples(q=np.zeros((len(kind), 6)), kind=kind, offset=offset)


def test_special_poses_at_every_distance_and_more_that_are_singular() -> None:
    every = samples(300)
    rows, plain = asked(every, general=False)
    assert len(rows) == len(set(rows)) == ORDINARY_POSES + SPECIAL_POSES
    assert (every.of(UNIFORM)[rows] == plain).all()
    offsets = every.offset[rows[~plain]]
    assert set(offsets) == set(DISTANCES)
    assert (offsets == 0.0).sum() > SPECIAL_POSES // 2


@pytest.mark.parametrize(
    ("special", "general", "ordinary", "others"), [(7, False, 12, 14), (0, False, 12, 0), (300, True, 1, 4)]
)
def test_as_many_as_there_are(special: int, general: bool, ordinary: int, others: int) -> None:
    _, plain = asked(samples(special), general=general)
    assert (plain.sum(), (~plain).sum()) == (ordinary, others)
