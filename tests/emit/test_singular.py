"""Singular poses in the terminal, on paper, in the sources and in the report say the same."""

from __future__ import annotations

import json
import re
from functools import cache

import pytest

from kinsym.check.reporting import report_of
from kinsym.deriving import derive
from kinsym.emit import TARGETS
from kinsym.emit.latex import document
from kinsym.emit.program import build_schedule
from kinsym.emit.text import equations
from kinsym.robot import load, lock
from kinsym.robot.files import from_draft
from tests.arms import NAMES, derivation


def section(name: str, width: int = 96) -> str:
    """The section of the terminal."""
    return equations(derivation(name), width=width).partition("Singular poses\n")[2]


@cache
def sources(name: str) -> dict[str, str]:
    """The generated sources by file name."""
    schedule = build_schedule(derivation(name))
    return {file: text for target in ("numpy", "c", "extension") for file, text in TARGETS[target](schedule).items()}


def test_the_terminal_names_the_three_singularities_of_the_puma() -> None:
    text = section("puma560")
    for line in (
        "  det J = a2*s5*(d4*c3 + a3*s3)*(a2*c2 + a3*c23 - d4*s23)\n",
        "  Wrist singularity: axes 4 and 6 coincide\n      s5 = 0, so theta5 = 0 or theta5 = pi\n",
        "      d4*c3 + a3*s3 = 0\n",
        "  Shoulder singularity: the wrist centre lies in the plane of axes 1 and 2\n      a2*c2 + a3*c23 - d4*s23",
        "    theta5 = pi:\n      theta4 is free; theta4 - theta6, theta1, theta2 and theta3 stay constant; theta6",
        "      theta2 is free if two links have the same length and lie folded on each other\n",
    ):
        assert line in text


def test_an_arm_without_a_square_jacobian_lists_where_its_rank_falls() -> None:
    text = section("scorbot_5r")
    assert "det J" not in text
    assert "Its rank falls, and the arm is singular, where\n" in text
    assert "      s234 = 0\n      a2*c2 + a3*c23 + a1 = 0\n" in text


def test_an_arm_without_singular_poses_says_so() -> None:
    assert "  It is never zero: the arm has no singular pose.\n" in section("three_slides")


def test_a_factor_too_long_to_read_is_told() -> None:
    text = section("symbolic_pieper")
    assert "det J =" not in text
    assert "      a factor of 74 terms = 0\n" in text
    assert "was not searched for factors of its own" in text.replace("\n  ", " ")
    assert r"\text{a factor of 74 terms} &= 0" in document(derivation("symbolic_pieper"))


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("width", [60, 96])
def test_lines_fit(name: str, width: int) -> None:
    assert max(map(len, section(name, width).splitlines())) <= width


def test_names_of_the_user_stand_in_every_sentence() -> None:
    rows = [("pi/2", "0", "h", "shoulder_pan"), ("0", "upper", "0", "shoulder_lift"), ("0", "fore", "0", "elbow")]
    joints = [
        {"type": "R", "variable": theta, "alpha": alpha, "a": a, "d": d, "theta": theta} for alpha, a, d, theta in rows
    ]
    draft = {"name": "named", "convention": "paul", "joints": joints}
    arm = derive(from_draft(draft, where="tests", bindings={}))
    text = equations(arm, width=60)
    assert "s3 = 0, so elbow = 0 or elbow = pi\n" in text
    assert "shoulder_pan is free" in text
    assert r"\mathrm{elbow} = \pi" in document(arm)


def test_the_document_has_the_section_and_its_table() -> None:
    text = document(derivation("ur5")).partition(r"\section{Singular poses}")[2]
    assert r"\det J &= a_{2} a_{3} s_{5} s_{3} (a_{2} c_{2} + a_{3} c_{23} + d_{5} s_{234})" in text
    assert r"\textbf{Wrist singularity}: axis 6 is parallel to axes 2, 3 and 4" in text
    assert r"$\theta_{5} = \pi$ & $\theta_{234}$ is free; $\theta_{234} - \theta_{6}$ and $\theta_{1}$ stay" in text


def test_the_sources_say_it_in_their_comments() -> None:
    for file in ("fanuc_s900w.py", "fanuc_s900w.h", "fanuc_s900w-solver/src/fanuc_s900w/__init__.py"):
        flat = re.sub(r"\s+\*?\s*", " ", sources("fanuc_s900w")[file])
        assert "s5 = 0: wrist singularity: axes 4 and 6 coincide." in flat
        assert "theta5 = 0: theta4 is free; theta4 + theta6, theta1, theta2 and theta3 stay constant;" in flat
        assert "a2*c2 + a3*c23 + d4*s23 + a1 = 0: theta1 is free; theta2 and theta3 stay constant;" in flat


def test_an_arm_without_singular_poses_has_no_comment_on_them() -> None:
    assert not any("Singular" in text for text in sources("three_slides").values())


def test_the_report_holds_the_same() -> None:
    arm = derivation("stanford_paul")
    content = json.loads(report_of(arm.robot, build_schedule(arm), {}, None).text())["singular_poses"]
    assert content["determinant"] == "d3^2*s5*s2"
    assert [one["zero"] for one in content["conditions"]] == [["d3"], ["s5"], ["s2"]]
    assert content["families"][0] == {
        "where": "d3 = 0",
        "free": "theta2",
        "constant": ["theta1"],
        "follows": ["theta4", "theta5", "theta6"],
        "equal_links_folded": False,
    }


def test_a_value_of_an_input_that_makes_every_pose_singular_is_told_everywhere() -> None:
    arm = derive(lock(load("kuka_iiwa"), {"theta2": None}))
    text = equations(arm, width=96)
    assert "  With joint 2 locked there, every pose is singular\n      s2 = 0, so theta2 = 0 or theta2 = pi\n" in text
    assert "With joint 2 locked there, every pose is singular" in document(arm)
    schedule = build_schedule(arm)
    header = TARGETS["c"](schedule)["kuka_iiwa.h"]
    assert "s2 = 0: with joint 2 locked there, every pose is singular." in re.sub(r"\s+\*?\s*", " ", header)
    content = json.loads(report_of(arm.robot, schedule, {}, None).text())["singular_poses"]
    assert content["conditions"][-1] == {
        "name": "",
        "zero": ["s2"],
        "meaning": "with joint 2 locked there, every pose is singular",
    }
