"""The end of the C code: which angles branches share, what follows from a mirror image, how much is computed."""

from __future__ import annotations

import ctypes
import math
from dataclasses import replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from kinsym.algebra.tree import Call, Sym
from kinsym.check.compiler import compile_shared
from kinsym.deriving import derive
from kinsym.emit import TARGETS
from kinsym.emit.ending import ending, summands
from kinsym.emit.environment import render
from kinsym.emit.operations import inverse_operations, line_operations
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from kinsym.emit.source.needs import inverse_needs
from kinsym.emit.symmetry import signs
from kinsym.robot.loading import load
from tests.emit.built import PLAIN, needs_compiler
from tests.emit.schedules import assign, planar_2r, puma

HALF_TURN, OPPOSITE = "half_turn", "opposite"


@cache
def gallery(name: str) -> Schedule:
    """The schedule of a robot of the gallery."""
    return build_schedule(derive(load(name)))


@pytest.mark.parametrize(
    ("name", "ik", "jacobian"),
    [
        ("puma560", "121 + -, 231 *, 12 /, 13 sqrt, 22 atan2", "27 + -, 46 *, 5 sincos"),
        ("ur5", "184 + -, 285 *, 8 /, 8 sqrt, 20 atan2", None),
        ("stanford_arm", "78 + -, 128 *, 7 /, 8 sqrt, 16 atan2", None),
    ],
)
def test_operations(name: str, ik: str, jacobian: str | None) -> None:
    schedule = gallery(name)
    assert str(inverse_operations(schedule)) == ik
    assert f"ik        {ik} (for all solutions)" in TARGETS["c"](schedule)[f"{name}.c"]
    assert f"{inverse_operations(schedule, shared=False)} (for" in TARGETS["numpy"](schedule)[f"{name}.py"]
    if jacobian:
        assert str(line_operations(schedule, schedule.jacobian)) == jacobian


@pytest.mark.parametrize(
    ("name", "kernel", "other"), [("ur5", "heading", "direction"), ("puma560", "direction", "heading")]
)
def test_a_direction_keeps_its_length_if_its_angle_alone_reads_it(name: str, kernel: str, other: str) -> None:
    source = TARGETS["c"](gallery(name))[f"{name}.c"]
    assert source.count(f" solve_{kernel}(") == 2
    assert f" solve_{other}(" not in source


def test_a_wrist_is_solved_once_for_both_of_its_postures() -> None:
    end = ending(puma(), inverse_needs(puma()).statements)
    assert end.mirrored
    assert {angle.name: (angle.count, angle.changes) for angle in end.angles} == {
        "theta1": (2, ()),
        "theta3": (4, ()),
        "theta2": (4, ()),
        "theta4": (4, ((3, HALF_TURN),)),
        "theta5": (4, ((3, OPPOSITE),)),
        "theta6": (4, ((3, HALF_TURN),)),
    }
    assert (end.pairs, end.room) == (22, 24)


def test_angles_are_shared_where_the_branches_are_not() -> None:
    end = ending(gallery("ur5"), inverse_needs(gallery("ur5")).statements)
    assert not end.mirrored
    shared = {angle.name: (angle.levels, angle.changes) for angle in end.angles if angle.changes}
    assert shared == {
        "theta234": ((1,), ((2, HALF_TURN),)),
        "theta5": ((1,), ((2, OPPOSITE),)),
        "theta6": ((1,), ((2, HALF_TURN),)),
        "theta3": ((1, 2), ((3, OPPOSITE),)),
    }
    assert [item.name for item in end.sums] == ["theta4"]


def test_signs_between_the_roots_of_a_step() -> None:
    statements = inverse_needs(puma()).statements
    last = signs(statements, 3)
    assert {name: last[name] for name in ("c4", "s4", "c5", "s5", "c6", "s6")} == {
        "c4": -1, "s4": -1, "c5": 1, "s5": -1, "c6": -1, "s6": -1,
    }  # fmt: skip
    assert "c3" not in last
    elbow = signs(statements, 2)
    assert (elbow["k_2"], elbow["w_2"], elbow["c23"]) == (1, -1, None)


def test_a_sum_of_anything_but_angles_is_wrapped_by_all_turns() -> None:
    theta = Sym("theta1")
    assert summands(Call("wrap", (theta,)), ["theta1"]) == 1
    assert summands(Call("wrap", (theta,)), []) is None
    assert summands(theta, ["theta1"]) is None


def test_an_angle_that_the_branches_read_is_taken_there() -> None:
    plain = planar_2r()
    for value, names in [("theta1*p_x", {"theta1", "theta2", "read"}), ("theta1*c1", {"theta2"})]:
        schedule = replace(plain, inverse=(*plain.inverse, *assign(1, f"read = {value}")), solution=("read", "theta2"))
        assert ending(schedule, inverse_needs(schedule).statements).names == names
        source = TARGETS["c"](schedule)["planar.c"].partition("/* Many poses at once")[0]
        assert ("double theta1 = angle_of(s1, c1);" in source) == ("theta1" not in names)
        assert ("read_of[arms] = read;" in source) == ("read" not in names)


@needs_compiler
def test_turns_stay_above_minus_pi_and_at_most_pi() -> None:
    names = ("half_turn", "opposite", "unwound")
    exported = "".join(
        f"double ask_{name}(double x);\ndouble ask_{name}(double x) {{ return {name}(x); }}\n" for name in names
    )
    source = "#include <math.h>\n" + render("c/helpers.c.jinja", functions=set(names), core=PLAIN) + exported
    with TemporaryDirectory() as folder:
        (Path(folder) / "turns.c").write_text(source, encoding="utf-8")
        library = ctypes.CDLL(str(compile_shared(folder, "turns", folder)))
    calls = {}
    for name in names:
        calls[name] = getattr(library, f"ask_{name}")
        calls[name].restype, calls[name].argtypes = ctypes.c_double, [ctypes.c_double]
    pi = math.pi
    values = [0.0, -0.0, 1e-300, -1e-300, 2.2e-16, 2.3e-16, -2.3e-16, 1.0, -1.0, pi, math.nextafter(-pi, 0.0)]
    for x in values:
        for name, exact in (("half_turn", x + pi), ("opposite", -x)):
            assert -pi < calls[name](x) <= pi
            assert abs(math.sin((calls[name](x) - exact) / 2.0)) < 1e-15
        for whole in (x, x + 2.0 * pi, x - 2.0 * pi):
            assert -pi < calls["unwound"](whole) <= pi
    assert all(math.isnan(call(math.nan)) for call in calls.values())


def test_the_mirror_image_of_an_elbow_has_the_opposite_angle() -> None:
    end = ending(planar_2r(), inverse_needs(planar_2r()).statements)
    assert not end.mirrored  # the first angle has nothing of a mirror image
    assert [(angle.name, angle.count, angle.changes) for angle in end.angles] == [
        ("theta2", 1, ((1, OPPOSITE),)),
        ("theta1", 2, ()),
    ]
