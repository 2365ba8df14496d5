"""The gallery: every robot loads, says what it is, and survives being written and read again."""

from __future__ import annotations

import subprocess
import sys
import tomllib
from fractions import Fraction

import pytest
import sympy

from kinsym.errors import RobotError
from kinsym.robot import bind, digest, gallery, gallery_path, gallery_titles, load, table_lines, to_toml
from kinsym.robot.expressions import symbol
from kinsym.robot.files import from_draft
from kinsym.robot.rows import cells_of

JOINTS = {
    "abb_irb120": "RRRRRR",
    "abb_irb140": "RRRRRR",
    "abb_irb6620lx": "PRRRRR",
    "adept_cobra600": "RRPR",
    "aubo_i5": "RRRRRR",
    "brooks_pf400": "PRRR",
    "comau_racer3": "RRRRRR",
    "cylindrical_rpp": "RPP",
    "doosan_m1013": "RRRRRR",
    "dvrk_psm": "RRPRRR",
    "elbow_6r_screw": "RRRRRR",
    "elbow_rrr": "RRR",
    "fanuc_crx10ial": "RRRRRR",
    "fanuc_lrmate200id": "RRRRRR",
    "fanuc_s900w": "RRRRRR",
    "franka_panda": "RRRRRRR",
    "gudel_fp1": "PPP",
    "hans_elfin5": "RRRRRR",
    "katana_450": "RRRRR",
    "kinova_j2s6s300": "RRRRRR",
    "kinova_jaco": "RRRRRR",
    "kuka_iiwa": "RRRRRRR",
    "kuka_kr6_r900": "RRRRRR",
    "kuka_youbot": "RRRRR",
    "mitsubishi_rv4fl": "RRRRRR",
    "nao_left_leg": "RRRRRR",
    "niryo_one": "RRRRRR",
    "open_manipulator_x": "RRRR",
    "planar_rr": "RR",
    "planar_rrr_craig": "RRR",
    "planar_rrr_paul": "RRR",
    "planar_rrr_screw": "RRR",
    "puma560": "RRRRRR",
    "raven_2": "RRPRRR",
    "rethink_sawyer": "RRRRRRR",
    "scara": "RRPR",
    "scorbot_5r": "RRRRR",
    "spherical_wrist": "RRR",
    "stanford_arm": "RRPRRR",
    "stanford_paul": "RRPRRR",
    "stanford_screw": "RRPRRR",
    "staubli_tx2_60": "RRRRRR",
    "techman_tm5_700": "RRRRRR",
    "ufactory_xarm6": "RRRRRR",
    "ur10e": "RRRRRR",
    "ur3": "RRRRRR",
    "ur5": "RRRRRR",
    "ur5e": "RRRRRR",
    "viperx_300s": "RRRRRR",
    "widowx_200": "RRRRR",
    "yaskawa_gp7": "RRRRRR",
}


def test_the_gallery_is_complete_and_sorted() -> None:
    assert list(gallery()) == sorted(JOINTS) == list(gallery_titles())


@pytest.mark.parametrize("name", JOINTS)
def test_robot_of_the_gallery(name: str) -> None:
    robot = load(name)
    assert robot.name == name
    assert "".join(joint.kind for joint in robot.moving) == JOINTS[name]
    assert robot.title == gallery_titles()[name] != name
    assert robot.source
    assert robot.task is not None
    assert robot.notes == ()
    assert table_lines(robot)[-1].startswith("parameters: ")


def test_thirty_arms_have_their_numbers() -> None:
    numbered = [name for name in gallery() if all(value is not None for value in load(name).parameters.values())]
    assert len(numbered) >= 30


@pytest.mark.parametrize("name", JOINTS)
def test_written_and_read_again_it_is_the_same(name: str) -> None:
    robot = load(name)
    again = from_draft(tomllib.loads(to_toml(robot)), where="again.toml")
    assert again == robot
    assert digest(again) == digest(robot)


def test_digests_differ() -> None:
    robots = [load(name) for name in gallery()]
    bound = bind(robots[0], {"d1": Fraction(1)})
    assert len({digest(robot) for robot in (*robots, bound)}) == len(robots) + 1


def test_numbers_of_the_puma_and_the_ur5() -> None:
    # Corke and Armstrong-Helouvry 1994, table of the Robotics Toolbox; Universal Robots, DH parameters of the UR5.
    puma = {"a2": "0.4318", "a3": "0.0203", "d3": "0.15005", "d4": "0.4318"}
    ur5 = {"d1": "0.089159", "a2": "-0.425", "a3": "-0.39225", "d4": "0.10915", "d5": "0.09465", "d6": "0.0823"}
    assert load("puma560").parameters == {name: Fraction(value) for name, value in puma.items()}
    assert load("ur5").parameters == {name: Fraction(value) for name, value in ur5.items()}


def test_unknown_robot() -> None:
    with pytest.raises(RobotError, match=r"no robot 'ur6'\. Did you mean ur5\?"):
        gallery_path("ur6")


@pytest.mark.parametrize("name", JOINTS)
def test_binding_leaves_no_trace_of_the_name(name: str) -> None:
    robot = load(name)
    values = {parameter: Fraction(i + 1, 7) for i, parameter in enumerate(robot.parameters)}
    bound = bind(robot, values)
    assert bound.parameters == {}
    assert bound.variables == robot.variables
    numbers = {symbol(key): sympy.Rational(value.numerator, value.denominator) for key, value in values.items()}
    for before, after in zip(robot.joints, bound.joints, strict=True):
        for (_, cell), (_, folded) in zip(cells_of(before), cells_of(after), strict=True):
            assert folded == cell.subs(numbers)
            assert {str(item) for item in folded.free_symbols} <= set(robot.variables)


def test_binding_one_of_several() -> None:
    bound = bind(load("stanford_screw"), {"g": Fraction(1, 5)})
    assert list(bound.parameters) == ["h"]
    assert bound.home is not None
    assert bound.home.q0[0] == sympy.Rational(1, 5)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("a22", "Did you mean a2? Its parameters: a2, a3, d3, d4."),
        ("theta1", "Bind parameters only; a joint is held at a value by a lock (--lock)."),
    ],
)
def test_binding_what_is_no_parameter(name: str, words: str) -> None:
    with pytest.raises(RobotError) as caught:
        bind(load("puma560"), {name: Fraction(1)})
    assert caught.value.where == f"bind {name}"
    assert caught.value.remedy == words


def test_zero_is_folded_and_noted() -> None:
    draft = tomllib.loads(to_toml(load("fanuc_s900w"))) | {"parameters": {"a3": "0", "a1": 0.0, "a2": 0.5}}
    robot = from_draft(draft, where="x.toml")
    assert list(robot.parameters) == ["a2", "d4", "d6"]
    assert robot.joints[0].a == robot.joints[2].a == 0
    assert robot.notes == (
        "a1 = 0 in the table, so it is left out of the equations.",
        "a3 = 0 in the table, so it is left out of the equations.",
    )


def test_a_binding_wins_over_a_zero_of_the_table() -> None:
    draft = tomllib.loads(to_toml(load("planar_rr"))) | {"parameters": {"l2": 0}}
    robot = from_draft(draft, where="x.toml", bindings={"l2": Fraction(1, 2)})
    assert robot.joints[1].a == sympy.Rational(1, 2)
    assert robot.notes == ()


def test_names_and_titles_need_no_sympy() -> None:
    code = "import sys, kinsym.robot as r; r.gallery_titles(); sys.exit('sympy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_text_is_the_same_whatever_the_hash_seed() -> None:
    code = (
        "from kinsym.robot import *\n"
        "for n in gallery():\n"
        "    r = load(n); print(*table_lines(r), to_toml(r), digest(r), r.notes, sep='\\n')"
    )
    outputs = {
        subprocess.run(
            [sys.executable, "-c", code],
            env={"PYTHONHASHSEED": seed, "PYTHONPATH": "."},
            check=True,
            capture_output=True,
        ).stdout
        for seed in ("0", "1", "2")
    }
    assert len(outputs) == 1
