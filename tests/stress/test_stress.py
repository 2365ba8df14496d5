"""The long run in short: it finds nothing in good code, and every fault in code that was broken on purpose."""

from dataclasses import replace

import numpy as np
import pytest

from kinsym.check.borders import borders
from kinsym.emit import TARGETS
from kinsym.emit.program import build_schedule
from tests import arms
from tests.emit.built import needs_compiler
from tests.reliability import HEAD, write_section
from tests.stress.measure import FAULTS, INSIDE, OUTSIDE, PAIR, RANDOM, Kind, Poses, Stress
from tests.stress.table import lines, section

pytestmark = needs_compiler

POSES = 1000
ROBOT = "elbow_rrr"

#: What is changed in the C of the robot by the fault that it leads to.
BROKEN = {
    "lost": ("for (int i1 = 0; i1 < n1; ++i1) {", "for (int i1 = 0; i1 < n1 - 1; ++i1) {"),
    "wrong": ("const double c3 = k_3 * reciprocal1;", "const double c3 = k_3 * reciprocal1 * 1.0000001;"),
    "copies": ("i1 = branch / 2, i2", "i1 = branch / 4, i2"),
    "broken": ("q[count][0] = theta1;", "q[count][0] = i2 ? theta1 : theta1 + 6.5;"),
    "batch": ("*marked = r > NEAR * t ? 0.0 : 1.0;", "*marked = r > 1e-9 * t ? 0.0 : 1.0;"),
}


@pytest.fixture(scope="module")
def found():
    return Stress(arms.derivation(ROBOT)).run(POSES)


def test_good_code_has_no_faults(found):
    assert [kind.name for kind in found][-4:] == [PAIR, INSIDE, OUTSIDE, RANDOM]
    assert found[0].name == "s3 = 0"
    assert sum(kind.poses for kind in found) >= POSES
    assert not any(sum(kind.faults.values()) for kind in found)
    assert all(0 < kind.worst < 3e-12 for kind in found)


@pytest.mark.parametrize("fault", FAULTS)
def test_every_fault_is_counted(fault):
    derivation = arms.derivation(ROBOT)
    old, new = BROKEN[fault]
    sources = TARGETS["c"](build_schedule(derivation))
    broken = {name: text.replace(old, new) for name, text in sources.items()}
    assert broken != sources
    kinds = Stress(derivation, broken).run(POSES)
    assert sum(kind.faults[fault] for kind in kinds) > 0
    assert any(len(kind.examples[fault]) for kind in kinds)


@pytest.mark.parametrize("name", ["kuka_iiwa", "abb_irb6620lx", "scorbot_5r"])
def test_locked_joints_slides_and_tasks_with_fewer_joints(name):
    kinds = Stress(arms.derivation(name)).run(1000)
    assert not any(sum(kind.faults.values()) for kind in kinds)


def test_a_way_is_followed_round_its_bends():
    """A slide of 1e-7 of the arm, theta1 as near to its border: within the tolerance axis 2 turns by a radian.

    The way passes s5 = 0, where axes 4 and 6 turn on it while theta5 changes by a millionth.
    """
    stress = Stress(arms.derivation("stanford_arm"))
    arm = (-0.42608683606376063, 2.191359976785872, -3.536667590582449e-05)
    wrist = (-2.373573143248012, -1.5909866895084743e-06, 0.5720852015430925)
    q = np.array([[*arm, *wrist]])
    poses = Poses(name="s5 = 0", q=q, T=stress.kinematics.forward(q), distance=np.array([1e-6]))
    kind = Kind(name=poses.name)
    stress._hold(poses, slice(0, 1), kind)
    assert not any(kind.faults.values())
    assert kind.solutions
    q = q.copy()
    q[:, 3] += 0.1
    stress._hold(replace(poses, q=q), slice(0, 1), kind)
    assert kind.faults["lost"] == 1


def test_outside_of_a_border_is_nothing():
    """The lost motion leads outward, and the depth is measured along it: a stretched arm of two links."""
    stress = Stress(arms.derivation("planar_rr"))
    edge = borders(stress.kinematics, stress.schedule.task, np.array([[0.4, 0.0]]), stress.postures.revolute)
    radial = stress.kinematics.forward(edge.q)[0, :2, 3]
    assert np.allclose(edge.outward[0, :2], radial / np.linalg.norm(radial))
    inside = stress.kinematics.forward(edge.inside(np.array([0]), np.array([1e-6])))[0, :2, 3]
    depth = (np.linalg.norm(radial) - np.linalg.norm(inside)) / stress.kinematics.size
    assert depth == pytest.approx(1e-6, rel=1e-3)


def test_the_page_names_the_command_the_faults_and_where(found, tmp_path):
    page = tmp_path / "reliability.md"
    broken = Kind(name="s3 = 0", poses=5, worst=0.5, faults={**dict.fromkeys(FAULTS, 0), "wrong": 3})
    broken.examples["wrong"] = [[1e-9, 0.25]]
    write_section("Long runs", section({"one": found, "two": [broken]}, "python -m tests.stress one two"), page)
    text = page.read_text(encoding="utf-8")
    assert text.startswith(HEAD)
    assert "    python -m tests.stress one two\n" in text
    assert "    wrong: 1e-09 0.25" in text
    assert "3 wrong" in text
    assert "| two | 5 |" in text
    # the other section stays when one is written anew
    write_section("The checks catch sabotage", ["sabotage"], page)
    write_section("Long runs", ["new"], page)
    text = page.read_text(encoding="utf-8")
    assert text.index("\nsabotage\n") < text.index("\nnew\n")
    assert "one two" not in text
    assert lines("one", [broken])[1] == "    wrong: 1e-09 0.25"
