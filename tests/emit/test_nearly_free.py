"""Four axes that are parallel to 1e-12: four links that move, and the pose changes by as much as the tolerance.

The equation of degree four has a double root there whose vectors are hardly longer than the tolerance. The two roots,
or where rounding hides them both ends of what the tolerance merges, lead to angles far from each other, and to both
curves on which the links can move.
"""

from __future__ import annotations

import numpy as np
import pytest

from tests.emit.built import needs_compiler
from tests.emit.made_from import Arm, exactly, in_c, in_numpy, lost

CASES: dict[Arm, list[float]] = {
    ("three axes parallel, 1-3", 49): [
        *(-1.1199816773895943, -0.11063431501402289, 0.23360834432342048),
        *(-2.382508127322176e-12, 2.566743815888555, 2.607867386844828),
    ],
    ("three axes parallel, 2-4", 7): [
        *(0.9808424528430202, -0.43366480596329693, -1.2195174169719047),
        *(-2.47877658206787, -1.0216347345399462e-12, -1.730209378111039),
    ],
    ("three axes parallel, 3-5", 15): [
        *(1.4138611856153593, 1.2874845427235959e-13, 0.22166651264341874),
        *(-2.1599120527472753, 0.30315314758860396, 2.343812882902145),
    ],
    ("three axes parallel, 4-6", 31): [
        *(0.4709400037245505, -1.659617556867335, 1.2954986871540918e-13),
        *(1.8749356064248421, 1.836834798712172, 1.6947229280896863),
    ],
    ("three axes parallel, 3-5", 1, 77): [
        *(-0.7984638455189138, 2.7213731138199048e-14, -1.2301828672083603),
        *(0.9943698558808217, 2.0992547636813543, -2.9809839071211233),
    ],
}


def joint_vectors(made_up: Arm) -> np.ndarray:
    """The vector of an arm as the only row."""
    return np.array([CASES[made_up]])


@needs_compiler
@pytest.mark.parametrize("made_up", CASES)
def test_the_c_finds_both_curves(made_up: Arm) -> None:
    q = joint_vectors(made_up)
    assert not lost(made_up, in_c(made_up), q, np.zeros(q.shape))


@pytest.mark.parametrize("made_up", CASES)
def test_the_module_finds_both_curves(made_up: Arm) -> None:
    q = joint_vectors(made_up)
    assert not lost(made_up, in_numpy(made_up), q, np.zeros(q.shape))


@pytest.mark.parametrize("made_up", [*list(CASES)[1:3], *list(CASES)[4:]])
def test_the_exact_walk_finds_both_curves(made_up: Arm) -> None:
    q = joint_vectors(made_up)
    assert not lost(made_up, exactly(made_up), q, np.zeros(q.shape))


@needs_compiler
@pytest.mark.parametrize("made_up", [("three axes parallel, 3-5", 0), ("three axes parallel, 3-5", 1)])
def test_the_reference_says_where_on_a_curve_the_answer_is(made_up: Arm) -> None:
    """With axis 1 parallel to the three the next angle is free: the middle of the double root has to stay for that."""
    q = np.random.Generator(np.random.PCG64(5)).uniform(-3.0, 3.0, (24, 6))
    q[:, 1] = 0.0
    assert not lost(made_up, in_c(made_up), q, q)
