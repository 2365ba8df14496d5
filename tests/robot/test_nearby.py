"""The special arm next to a calibrated one.

The calibrations are those of three real arms, printed in the tests of Universal Robots' ROS driver
(ur_calibration/test/calibration_test.cpp): differences to the nominal table of the maker. Their d2 and d3 are up to
446 m long, because axes 2, 3 and 4 are not quite parallel any more.
"""

from __future__ import annotations

import types
from fractions import Fraction

import numpy as np
import pytest

from kinsym.deriving import derive
from kinsym.emit import TARGETS
from kinsym.emit.program import build_schedule
from kinsym.errors import RobotError
from kinsym.robot import from_inline, load
from kinsym.robot.geometry.arm import Arm, arm_of, difference
from kinsym.robot.model import Robot
from kinsym.robot.nearby import Nearly, nominal
from kinsym.robot.snapping import EXACT

# d, a, alpha in quarter turns: Universal Robots, DH parameters for calculations of kinematics and dynamics.
UR10 = ((0.1273, 0, 1), (0, -0.612, 0), (0, -0.5723, 0), (0.163941, 0, 1), (0.1157, 0, -1), (0.0922, 0, 0))
UR10E = ((0.1807, 0, 1), (0, -0.6127, 0), (0, -0.57155, 0), (0.17415, 0, 1), (0.11985, 0, -1), (0.11655, 0, 0))
# differences of d, a, theta, alpha
CALIBRATIONS = {
    "ur10": (
        UR10,
        "0.00065609212979853 1.4442162376284788 0.854147723854608 -2.2989425877563705 -1.573498686836816e-05 "
        "1.9072435590711256e-05",
        "4.6311376834935676e-05 -0.00012568315331862312 0.00186216581161458 9.918593870679266e-05 "
        "4.215462720453189e-06 0",
        "-7.290070070824746e-05 -0.01713897289704999 -0.03707159413492756 0.054279462160583214 "
        "1.488984257025741e-07 1.551499479707493e-05",
        "0.000211987863869334 -0.0072553625957652995 -0.013483226769541364 0.0013495820227329425 "
        "-0.001263136163679901 0",
    ),
    "ur10e": (
        UR10E,
        "-0.000144894975118076141 303.469135666158195 -309.88394307789747 6.41459904397394975 "
        "-4.48232900190081995e-05 -0.00087071402790364627",
        "0.000108651068627930392 0.240324175250532346 0.00180628180213493472 2.63076149165684402e-05 "
        "3.96638632500012715e-06 0",
        "1.59613525316931737e-07 -0.917209621528830232 7.12936131346499469 0.0710299029424392298 "
        "-1.64258976526054923e-06 9.17286101034808787e-08",
        "-0.000444781952841921679 -0.00160215112531214153 0.00631917793331091861 -0.00165055247340828437 "
        "0.000763682515545038854 0",
    ),
    "another_ur10e": (
        UR10E,
        "-0.000160188285741325043 439.140974079900957 -446.027059806332147 6.88618689642360149 "
        "-3.86588496858186748e-05 -0.00087908274257374186",
        "2.12234865571205891e-05 0.632017132627700651 0.00229833638891230319 -4.61409023720933908e-05 "
        "-6.39280053471801522e-05 0",
        "-2.41478068943590252e-07 1.60233952386694556 -1.68607190752171299 0.0837331147700118711 "
        "-1.01260355871157781e-07 3.91986209186123702e-08",
        "-0.000650246557584166496 0.00139416666825590402 0.00693818880325995126 -0.000811641562390219562 "
        "0.000411120504570705592 0",
    ),
}


def calibrated(name: str) -> Robot:
    table, *columns = CALIBRATIONS[name]
    rows = []
    deltas = zip(*(column.split() for column in columns), strict=True)
    for i, ((d, a, alpha), (dd, da, dtheta, dalpha)) in enumerate(zip(table, deltas, strict=True), start=1):
        rows.append(f"{alpha}*pi/2+{dalpha} {a}+{da} {d}+{dd} theta{i}+{dtheta}".replace("+-", "-"))
    return from_inline(";".join(rows), convention="paul", name=name, snapping=EXACT)


@pytest.fixture(scope="module", params=CALIBRATIONS)
def near(request: pytest.FixtureRequest) -> Nearly:
    """A calibrated arm and the special one next to it."""
    return nominal(calibrated(request.param))


def test_the_makers_table_comes_out_to_the_millimetre(near: Nearly) -> None:
    table = CALIBRATIONS[near.true.name][0]
    assert [str(joint.alpha) for joint in near.nominal.joints] == ["pi/2", "0", "0", "pi/2", "-pi/2", "0"]
    values = {name: float(value or 0) for name, value in near.nominal.parameters.items()}
    assert list(values) == ["d1", "a2", "a3", "d4", "d5", "d6"]
    expected = [table[0][0], table[1][1], table[2][1], *(row[0] for row in table[3:])]
    assert list(values.values()) == pytest.approx(expected, abs=1.1e-3)
    assert near.nominal.variables == near.true.variables


def test_every_deviation_is_told(near: Nearly) -> None:
    """Twists by thousandths, common normals by tenths of a millimetre, T by millimetres; the true arm is untouched."""
    changes = {change.where: change for change in near.deviation.changes}
    assert {"row 1, alpha", "row 2, alpha", "row 3, alpha", "row 4, alpha", "row 5, alpha"} <= set(changes)
    assert all(change.difference < 0.02 for change in changes.values())
    assert 1e-4 < near.deviation.position < 8e-3
    assert 1e-3 < near.deviation.rotation < 3e-2
    assert near.nominal.deviation == near.deviation
    assert (near.deviation.position, near.deviation.rotation) == difference(arm_of(near.true), arm_of(near.nominal))
    assert "off by" in near.nominal.notes[0]


def test_the_neighbour_has_a_closed_form(near: Nearly) -> None:
    assert derive(near.nominal).plan.maximum == 8


def test_its_solutions_start_newton_on_the_true_arm(near: Nearly) -> None:
    """All eight solutions of the neighbour at a pose of the true arm lead to true ones in five steps."""
    q = [0.3, -0.9, 1.2, -0.8, 1.1, 0.4]
    true = arm_of(near.true)
    (source,) = TARGETS["numpy"](build_schedule(derive(near.nominal))).values()
    module = types.ModuleType("nominal")
    exec(compile(source, "nominal.py", "exec"), module.__dict__)
    ends = [newton(true, matrix(true, q), list(start)) for start in module.ik(matrix(true, q))]
    assert len(ends) == 8
    assert all(np.abs(matrix(true, end) - matrix(true, q)).max() < 1e-12 for end in ends)
    assert min(np.abs(np.array(end) - q).max() for end in ends) < 1e-9


def matrix(arm: Arm, q: list[float]) -> np.ndarray:
    frame = arm.pose(q)
    columns = np.array([frame.x, frame.y, frame.z, frame.origin], dtype=float)
    return np.vstack([columns.T, [0, 0, 0, 1]])


def newton(arm: Arm, wanted: np.ndarray, q: list[float]) -> list[float]:
    for _ in range(5):
        here = matrix(arm, q)
        step = 1e-6
        slopes = [
            (matrix(arm, [v + step * (i == j) for j, v in enumerate(q)]) - here)[:3].ravel() / step
            for i in range(len(q))
        ]
        q = list(q + np.linalg.lstsq(np.array(slopes).T, (wanted - here)[:3].ravel(), rcond=None)[0])
    return q


def test_designed_offsets_stay() -> None:
    """A special arm is its own neighbour: the 20 mm of a Puma's elbow are no error."""
    for name in ("puma560", "ur5"):
        robot = load(name)
        near = nominal(robot)
        assert near.deviation.changes == ()
        assert near.deviation.position == 0.0
        assert list(near.nominal.parameters.values()) == list(robot.parameters.values())


def test_a_wrist_whose_axes_just_miss_each_other() -> None:
    """Both common normals and the distance of their feet go to zero, so that three axes meet in a point."""
    rows = (
        "pi/2 0 0.4 theta1; 0 0.5 0 theta2; pi/2+0.0004 0.02 0 theta3; "
        "-pi/2 0.0003 0.6 theta4; pi/2 -0.0002 0.0005 theta5; 0 0 0.1 theta6"
    )
    robot = from_inline(rows, convention="paul")
    near = nominal(robot)
    assert list(near.nominal.parameters) == ["d1", "a2", "a3", "d4", "d6"]
    assert {change.where for change in near.deviation.changes} == {
        *("row 3, alpha", "row 4, a", "row 5, a", "row 5, d"),
    }
    assert derive(near.nominal).plan.maximum == 8
    tight = nominal(robot, normals=Fraction(1, 10**5))
    assert "a4" in tight.nominal.parameters


def test_what_cannot_be_near() -> None:
    with pytest.raises(RobotError, match="the parameter l1 has no value"):
        nominal(load("planar_rr"))
    for wrong in (Fraction(0), Fraction(-1), Fraction(1, 2)):
        with pytest.raises(RobotError, match="tolerance"):
            nominal(load("ur5"), twists=wrong)
        with pytest.raises(RobotError, match="tolerance"):
            nominal(load("ur5"), normals=wrong)
