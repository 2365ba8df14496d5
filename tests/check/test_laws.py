"""The checks find what is wrong: a hand-made module passes, and every fault put into it fails a law."""

from __future__ import annotations

import pytest

from kinsym.check.answers import AGREE_LAW, CLOSE_LAW, COPY_LAW, FOUND_LAW, INVERSE_LAW, RANGE_LAW
from kinsym.check.batch import SINGLE_LAW
from kinsym.check.compare import compare
from kinsym.check.control import NEAREST_LAW, STATUS_LAW
from kinsym.check.examination import ERROR_LAW, FORWARD_LAW, JACOBIAN_LAW
from kinsym.check.interface import DEFAULT_LAW, INPUT_LAW, MARK_LAW, TABLE_LAW
from kinsym.check.report import FAILED, at_most
from kinsym.check.sources import IMPORT
from kinsym.check.strange import FAR_LAW, REFUSE_LAW
from kinsym.check.windings import INSIDE_LAW, WITHIN_LAW
from tests.check import hand


def failures(module: str) -> set[str]:
    """The laws that a module by hand breaks."""
    findings = compare(hand.robot(), hand.schedule(), {"hand_rr.py": module})
    return {check.law for check in findings.checks if check.status == FAILED}


def test_the_module_passes() -> None:
    """More than a thousand poses of every kind, two solutions at random poses."""
    findings = compare(hand.robot(), hand.schedule(), {"hand_rr.py": hand.MODULE})
    assert [check for check in findings.checks if check.status == FAILED] == []
    assert findings.figures["poses"] >= 1000
    assert all(findings.figures["poses_by_kind"].values())
    assert findings.figures["solutions_at_random_poses"] == {"least": 2, "usual": 2, "most": 2}


FAULTS = {
    "sign in fk": ("+ l2 * np.sin(b)\n    return", "- l2 * np.sin(b)\n    return", FORWARD_LAW),
    "sign in the Jacobian": ("= -T[..., 1, 3], T", "= T[..., 1, 3], T", JACOBIAN_LAW),
    "sign in ik": ("x * along + y * b", "x * along - y * b", INVERSE_LAW),
    "a branch lost": ("reach & ~border]", "reach & False]", FOUND_LAW),
    "order of branches": ("enumerate((1.0, -1.0))", "enumerate((-1.0, 1.0))", AGREE_LAW),
    "border not merged": ("reach & ~border]", "reach]", COPY_LAW),
    "no clamp at the border": ("reach = (f1 >= -t1) & (f2 >= -t2)", "reach = (f1 > 0) & (f2 > 0)", CLOSE_LAW),
    "band too wide": ("TAU = 2.0**-46", "TAU = 1e-9", FOUND_LAW),
    "reach not tested": ("reach = (f1 >= -t1) & (f2 >= -t2)", "reach = f1 < 1e300", FAR_LAW),
    "NaN in what is valid": ("np.where(valid[..., None], q, np.nan), valid", "q * np.nan, valid", INVERSE_LAW),
    "angle out of range": (
        "return np.where(valid[..., None], q,",
        "return np.where(valid[..., None], q + 7,",
        RANGE_LAW,
    ),
    "reflection answered": ("np.linalg.det(np.where(np.isfinite(R), R, 0.0)) > 0", "True", REFUSE_LAW),
    "a bad pose at another place": ("np.argmin(np.ravel(fine))", "np.argmax(np.ravel(fine))", REFUSE_LAW),
    "another default of nearest": (
        "weights=None, limits=None, l1=0.6",
        "weights=None, limits=None, l1=0.600001",
        DEFAULT_LAW,
    ),
    "single and batch differ": ("return q[valid]", "return q[valid][::-1]", SINGLE_LAW),
    "noise refused": ("G <= 1e-6", "G <= 1e-12", ERROR_LAW),
    "parameter ignored": (
        "q = np.asarray(q, dtype=float)\n",
        "q = np.asarray(q, dtype=float)\n    l1 = 0.6\n",
        FORWARD_LAW,
    ),
    "nearest is the farthest": ("np.argmin((weights", "np.argmax((weights", NEAREST_LAW),
    "a status that is wrong": ('"solved" if len(free) == 2', '"unreachable" if len(free) == 2', STATUS_LAW),
    "a border that is not told": ("(valid.sum() == 1) &", "(valid.sum() == 7) &", MARK_LAW),
    "branches from one": ("np.flatnonzero(valid)", "np.flatnonzero(valid) + 1", MARK_LAW),
    "a turn too few": (".all(axis=1), 3, 0)", ".all(axis=1), 0, 0)", WITHIN_LAW),
    "wound without an end": (".all(axis=1), 3, 0)", ".all(axis=1), 3, 1)", WITHIN_LAW),
    "windings with another's marks": ("part[rows] for", "part[rows[::-1]] for", WITHIN_LAW),
    "a status of windings that is wrong": ('else "unreachable")', 'else "solved")', WITHIN_LAW),
    "the nearest outside": (
        "_inside(found.q, limits, lambda ends: 3)",
        "_inside(found.q, None, lambda ends: 3)",
        INSIDE_LAW,
    ),
    "limits of another table": ("LIMITS = ((-np.inf,", "LIMITS = ((-3.0,", TABLE_LAW),
    "another default": ("def jacobian(q, *, l1=0.6, l2=0.4)", "def jacobian(q, *, l1=0.61, l2=0.4)", DEFAULT_LAW),
    "forward kinematics of no numbers": ('    _finite([l1, l2], "l1, l2")\n    q = np', "    q = np", INPUT_LAW),
    "limits taken as they are": ("(low <= high) & ", "", INPUT_LAW),
    "a weight below zero": ("(weights < 0).any()", "False", INPUT_LAW),
    "a reference that is no number": ('reference, "a reference")', '1.0, "a reference")', INPUT_LAW),
    "no Python": ("import numpy as np", "import numpy as", IMPORT),
    "wrong names": ('JOINTS = ("theta1", "theta2")', 'JOINTS = ("theta2", "theta1")', IMPORT),
}


@pytest.mark.parametrize("fault", FAULTS)
@pytest.mark.usefixtures("few_poses")
def test_faults_are_found(fault: str) -> None:
    """Each fault breaks the law that is there for it."""
    old, new, law = FAULTS[fault]
    assert hand.MODULE.count(old) == 1
    assert law in failures(hand.MODULE.replace(old, new))


def test_figures_are_rounded_upward() -> None:
    """A bound is never below the value."""
    assert at_most(3.0000001e-15) == "<= 4e-15"
    assert at_most(9.5e-16) == "<= 1e-15"
    assert at_most(0.0) == "0"
    assert at_most(float("inf")) == "not finite"
