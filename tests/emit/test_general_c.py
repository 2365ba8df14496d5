"""The generated C of arms without a closed form: it finds every solution, whatever it is asked."""

from __future__ import annotations

import math
import os
import shutil
import subprocess
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from kinsym.check.compiler import FLAGS, compile_shared
from kinsym.emit import TARGETS
from kinsym.robot.model import Task
from tests.emit.built import CLibrary, needs_compiler, same_angles
from tests.emit.general_arms import TABLES, five_joints, general_schedule

pytestmark = needs_compiler
CPP = ("-x", "c++", "-std=c++17", *FLAGS[1:])
FAST = (*FLAGS[:1], "-O3", *FLAGS[2:])
COMPILED = {"lengths": FLAGS, "mirrored": FAST, "slide3": CPP, "slides36": CPP}
VALUED = ["skew", "mirrored", "cobot", "slide1", "slide6", "slides25"]
LENGTHS = {f"{letter}{k}": 0.1 + 0.07 * k for letter in "ad" for k in range(1, 7)}


@cache
def built(name: str) -> CLibrary:
    """The compiled source of an arm."""
    return CLibrary(general_schedule(name))


def parameters(name: str) -> dict[str, float] | None:
    """Values for the arm that has none in its table."""
    return LENGTHS if name == "lengths" else None


def joint_vectors(count: int, seed: int) -> np.ndarray:
    """Random joint vectors; a slide moves by three units, five times the size of the arm."""
    return np.random.default_rng(seed).uniform(-math.pi, math.pi, (count, 6))


def distance(name: str, solutions: np.ndarray, q: np.ndarray) -> np.ndarray:
    """How far joint vectors are from one, whole turns of angles aside."""
    slides = [joint.kind == "P" for joint in general_schedule(name).joints]
    gap = np.where(slides, np.abs(solutions - q), np.abs(np.angle(np.exp(1j * (solutions - q)))))
    return gap.max(axis=-1)


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
@pytest.mark.parametrize("name", COMPILED)
def test_compiles_without_a_warning(name: str, compiler: str, tmp_path: Path) -> None:
    if shutil.which(compiler) is None:
        pytest.skip(f"{compiler} is not installed")
    for file, text in TARGETS["c"](general_schedule(name)).items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    assert compile_shared(tmp_path, name, tmp_path, compiler=compiler, flags=COMPILED[name]).is_file()


@pytest.mark.parametrize("name", sorted(TABLES))
def test_every_solution_reaches_the_pose_and_the_known_one_is_among_them(name: str) -> None:
    library, given = built(name), parameters(name)
    for q in joint_vectors(200, seed=3):
        pose = library.fk(q, given)
        _, solutions = library.ik(pose, parameters=given)
        for solution in solutions:
            np.testing.assert_allclose(library.fk(solution, given), pose, atol=1e-12)
        assert distance(name, solutions, q).min() < 1e-7


@pytest.mark.parametrize("name", sorted(TABLES))
def test_every_solution_leads_to_the_same_ones(name: str) -> None:
    # The pose of a solution is the same pose but for rounding: whichever it is made from, all of them come back.
    library, given = built(name), parameters(name)
    for q in joint_vectors(60, seed=4):
        _, solutions = library.ik(library.fk(q, given), parameters=given)
        for solution in solutions:
            count, again = library.ik(library.fk(solution, given), parameters=given)
            assert count == len(solutions)
            assert all(distance(name, again, other).min() < 1e-6 for other in solutions)


@pytest.mark.parametrize("name", ["skew", "mirrored", "slide3"])
def test_angles_lie_in_one_turn_and_rows_are_distinct_and_in_order(name: str) -> None:
    library = built(name)
    revolute = [joint.kind == "R" for joint in general_schedule(name).joints]
    for q in joint_vectors(100, seed=5):
        _, solutions = library.ik(library.fk(q))
        angles = solutions[:, revolute]
        assert (angles > -math.pi).all()
        assert (angles <= math.pi).all()
        rows = [tuple(row) for row in np.round(angles, 6)]
        assert rows == sorted(rows) or not revolute[0]
        for number, solution in enumerate(solutions):
            others = np.delete(solutions, number, axis=0)
            assert not len(others) or distance(name, others, solution).min() > 1e-6


def test_mirrored_arms_have_an_even_number_of_solutions_with_equal_last_angles() -> None:
    # The mirror image of a posture: theta1 + pi, -theta2, theta3 + pi - 2 theta2 and so on reaches the same pose.
    library = built("mirrored")
    for q in joint_vectors(200, seed=6):
        count, solutions = library.ik(library.fk(q))
        assert count % 2 == 0
        for row in solutions:
            twin = (same_angles(solutions[:, 4:], row[4:]) < 1e-6) & (same_angles(solutions[:, 0], row[0]) > 3.1)
            assert twin.any()


@pytest.mark.parametrize("name", ["skew", "mirrored", "cobot", "slide3"])
def test_poses_where_everything_is_at_a_right_angle(name: str) -> None:
    # Where the determinant vanishes for every angle a pose beside this one gives the starts; at a few of the mirrored
    # arm's poses several continua meet and Newton converges too slowly.
    library = built(name)
    q = np.random.default_rng(8).integers(-2, 3, (200, 6)) * (math.pi / 2)
    counts = np.array([library.ik(library.fk(row))[0] for row in q])
    assert (counts == 0).sum() <= 2 * (name == "mirrored")


def singular_vectors(library: CLibrary, count: int, seed: int) -> list[np.ndarray]:
    """Joint vectors at which the Jacobian is singular, by bisection of its determinant along the third joint."""

    def sign(q: np.ndarray) -> bool:
        return bool(np.linalg.det(library.jacobian(q)) > 0.0)

    found: list[np.ndarray] = []
    for q in joint_vectors(20 * count, seed):
        low, high = q, q + np.array([0.0, 0.0, 1.0, 0.0, 0.0, 0.0])
        if sign(low) == sign(high) or len(found) == count:
            continue
        side = sign(low)
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if sign(middle) == side else (low, middle)
        found.append(low)
    return found


@pytest.mark.parametrize(("beside", "near"), [(0.0, 1e-3), (1e-8, 1e-3), (1e-6, 1e-3), (1e-4, 1e-6), (1e-2, 1e-8)])
def test_poses_at_and_beside_singular_ones(beside: float, near: float) -> None:
    # Two solutions meet here, or are about twice as far from each other as the joint vector is from the singular one.
    # The rounding of a pose parts a double solution by 1e-8, by 1e-6 where the pose hardly depends on that joint.
    library = built("skew")
    copies = 0
    for singular in singular_vectors(library, 40, seed=15):
        q = singular + beside * np.array([0.3, -0.5, 0.6, 0.2, -0.4, 0.3])
        _, solutions = library.ik(library.fk(q))
        assert distance("skew", solutions, q).min() < near
        copies += (distance("skew", solutions, q) < 1e-3).sum() > 1
    assert copies <= 1 or beside > 0.0


def test_solutions_that_share_their_suppressed_angle() -> None:
    # With theta4 = 0 the arm lies in a plane, and four solutions share theta4, which the cuts of this arm suppress.
    library = built("cobot")
    assert {cut.suppressed for cut in general_schedule("cobot").general.cuts} & {4}
    for q in joint_vectors(100, seed=12):
        q[3] = 0.0
        _, solutions = library.ik(library.fk(q))
        assert distance("cobot", solutions, q).min() < 1e-6
        assert (np.abs(solutions[:, 3]) < 1e-6).sum() >= 2


@pytest.mark.parametrize("name", VALUED)
def test_nothing_is_found_out_of_reach(name: str) -> None:
    library = built(name)
    pose = np.eye(4)
    pose[:3, 3] = 3.0, 4.0, 5.0
    if "P" not in {joint.kind for joint in general_schedule(name).joints}:
        assert library.status(pose) == 0
    pose[:3, 3] = 3e12, 4e140, 5e12
    assert library.status(pose) >= 0


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 1e300, 5.0])
@pytest.mark.parametrize("name", ["skew", "mirrored", "slide3"])
def test_what_is_no_pose_has_its_own_status(name: str, value: float) -> None:
    library = built(name)
    for place in range(16):
        pose = np.eye(4)
        pose.flat[place] = value
        if place in (3, 7, 11) and value == 5.0:
            assert library.status(pose) >= 0
        else:
            assert library.status(pose) == -1
    assert library.status(np.zeros((4, 4))) == -1
    assert library.status(np.diag([1.0, 1.0, -1.0, 1.0])) == -1


def test_parameters_are_read_at_every_call() -> None:
    library = built("lengths")
    q = np.full(6, 0.4)
    other = LENGTHS | {"a2": 0.9, "d4": -0.3}
    pose = library.fk(q, other)
    assert distance("lengths", library.ik(pose, parameters=other)[1], q).min() < 1e-9
    solutions = library.ik(pose, parameters=LENGTHS)[1]
    assert not len(solutions) or distance("lengths", solutions, q).min() > 1e-3
    for bad in (math.nan, math.inf):
        assert library.status(pose, LENGTHS | {"a2": bad}) == -2
    assert library.library.lengths_ik_near(pose.ctypes, None, None, np.zeros(96).ctypes) == -2
    assert library.status(np.eye(4), dict.fromkeys(LENGTHS, 0.0)) >= 0


@pytest.mark.parametrize("scale", [1e-60, 1e-3, 1e3, 1e70, 1e140])
def test_the_unit_of_length_does_not_matter(scale: float) -> None:
    library = built("lengths")
    scaled = {name: scale * value for name, value in LENGTHS.items()}
    for q in joint_vectors(20, seed=9):
        expected = library.ik(library.fk(q, LENGTHS), parameters=LENGTHS)[1]
        found = library.ik(library.fk(q, scaled), parameters=scaled)[1]
        np.testing.assert_allclose(found, expected, atol=1e-7)


def test_rotation_off_by_rounding_is_mended() -> None:
    library, random = built("skew"), np.random.default_rng(5)
    for q in joint_vectors(30, seed=10):
        pose = library.fk(q)
        pose[:3, :3] += random.uniform(-1e-9, 1e-9, (3, 3))
        assert distance("skew", library.ik(pose)[1], q).min() < 1e-6


def test_the_reference_changes_nothing() -> None:
    library = built("skew")
    for q in joint_vectors(20, seed=11):
        pose = library.fk(q)
        np.testing.assert_array_equal(library.ik(pose, q)[1], library.ik(pose)[1])


def test_five_joints_reach_a_point_and_an_axis() -> None:
    library = CLibrary(five_joints(Task.POSITION_AXIS))
    for q in joint_vectors(100, seed=13)[:, :5]:
        pose = library.fk(q)
        pose[:3, :3] = pose[:3, :3] @ turned(0.8)
        _, solutions = library.ik(pose)
        assert same_angles(solutions, q).min() < 1e-7
        for solution in solutions:
            np.testing.assert_allclose(library.fk(solution)[:3, 2:], pose[:3, 2:], atol=1e-12)


def test_five_joints_find_only_what_reaches_the_whole_pose() -> None:
    library = CLibrary(five_joints(Task.POSE))
    for q in joint_vectors(100, seed=14)[:, :5]:
        pose = library.fk(q)
        _, solutions = library.ik(pose)
        assert same_angles(solutions, q).min() < 1e-7
        for solution in solutions:
            np.testing.assert_allclose(library.fk(solution), pose, atol=1e-12)
        pose[0, 3] += 1e-6
        assert library.status(pose) == 0
        pose[:3, :3] = pose[:3, :3] @ turned(0.1)
        assert library.status(pose) == 0


def turned(angle: float) -> np.ndarray:
    """A turn about z."""
    return np.array([[math.cos(angle), -math.sin(angle), 0], [math.sin(angle), math.cos(angle), 0], [0, 0, 1]])


HOSTILE = """
#include <stdio.h>
int main(void)
{
    static const double values[] = {NAN, INFINITY, -INFINITY, 0.0, 1e300, 1e149, -1e149, 1e-300, 5e-324, 1.0, -1.0};
    unsigned state = 1;
    long found = 0;
    for (int round = 0; round < 400; ++round) {
        double q[6], T[16], rows[16][6];
        for (int i = 0; i < 6; ++i) {
            state = state * 1103515245u + 12345u;
            q[i] = round % 2 ? (double)(state >> 16) * 1e-4 : 1.5707963267948966 * (double)(state >> 16 & 3u);
        }
        NAME_fk(q, NULL, T);
        for (int i = 0; i < round % 5 * (round % 5); ++i) {
            state = state * 1103515245u + 12345u;
            T[state >> 16 & 15u] = values[(state >> 20) % 11u];
        }
        const int count = NAME_ik(T, NULL, rows);
        for (int i = 0; i < count; ++i) {
            for (int j = 0; j < 6; ++j) {
                if (!isfinite(rows[i][j])) {
                    return 1;
                }
            }
        }
        found += count > 0;
    }
    printf("%ld", found);
    return 0;
}
"""


@pytest.mark.parametrize("name", ["skew", "mirrored", "slide3", "slides34"])
def test_hostile_input_under_the_sanitizers(name: str, tmp_path: Path) -> None:
    if shutil.which("gcc") is None:
        pytest.skip("gcc is not installed")
    for file, text in TARGETS["c"](general_schedule(name)).items():
        (tmp_path / file).write_text(text + HOSTILE.replace("NAME", name) * file.endswith(".c"), encoding="utf-8")
    sanitizers = "-fsanitize=address,undefined"
    command = ["gcc", "-std=c99", "-O1", sanitizers, "-fno-sanitize-recover=all", f"{name}.c", "-o", "hostile", "-lm"]
    subprocess.run(command, cwd=tmp_path, check=True, timeout=120)
    environment = os.environ | {"ASAN_OPTIONS": "detect_leaks=0"}
    finished = subprocess.run(
        ["./hostile"], cwd=tmp_path, capture_output=True, text=True, env=environment, check=False, timeout=120
    )
    assert finished.returncode == 0, finished.stderr
    assert int(finished.stdout) > 80


def test_the_stack_stays_small(tmp_path: Path) -> None:
    if shutil.which("gcc") is None:
        pytest.skip("gcc is not installed")
    for file, text in TARGETS["c"](general_schedule("mirrored")).items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    command = ["gcc", "-std=c99", "-O2", "-fstack-usage", "-c", "mirrored.c"]
    subprocess.run(command, cwd=tmp_path, check=True, timeout=120)
    lines = (tmp_path / "mirrored.su").read_text(encoding="utf-8").splitlines()
    used = {line.split(":")[-1].split("\t")[0]: int(line.split("\t")[1]) for line in lines}
    del used["mirrored_fk_batch"]  # no solver is called there
    # More than the deepest chain of calls; sample_anew calls itself twice at most, and nothing else does.
    assert sum(used.values()) + 2 * used.get("sample_anew", 0) < 27000


def test_nothing_is_kept_between_calls() -> None:
    (source,) = (text for file, text in TARGETS["c"](general_schedule("skew")).items() if file.endswith(".c"))
    for line in source.splitlines():
        assert not line.strip().startswith("static ") or "const" in line or "(" in line, line
        assert "malloc" not in line
