"""The generated C: it compiles with every compiler at hand and agrees with the NumPy module."""

from __future__ import annotations

import math
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kinsym.check.compiler import FLAGS, compile_shared, find_compiler
from kinsym.emit import TARGETS
from kinsym.emit.schedule import Schedule
from kinsym.errors import CheckFailed
from tests.emit.built import CLibrary, both, needs_compiler, same_angles
from tests.emit.schedules import every_kernel, planar_2r, polar, puma
from tests.emit.test_numpy import joint_vectors, puma_poses

pytestmark = needs_compiler
CPP = ("-x", "c++", "-std=c++17", *FLAGS[1:])


def without_value() -> Schedule:
    """The planar arm whose second length the caller must give."""
    return planar_2r(a2=None)


def write(schedule: Schedule, folder: Path) -> None:
    """The C files of a schedule."""
    for name, text in TARGETS["c"](schedule).items():
        (folder / name).write_text(text, encoding="utf-8")


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
@pytest.mark.parametrize("flags", [FLAGS, CPP], ids=["c99", "c++17"])
@pytest.mark.parametrize("make", [planar_2r, without_value, polar, puma, every_kernel])
def test_compiles_without_a_warning(
    make: Callable[[], Schedule], flags: tuple[str, ...], compiler: str, tmp_path: Path
) -> None:
    if shutil.which(compiler) is None:
        pytest.skip(f"{compiler} is not installed")
    write(make(), tmp_path)
    assert compile_shared(tmp_path, make().name, tmp_path, compiler=compiler, flags=flags).is_file()


@pytest.mark.parametrize("make", [planar_2r, polar, puma])
def test_agrees_with_numpy_at_random_poses(make: Callable[[], Schedule]) -> None:
    module, library = both(make)
    for q in joint_vectors(300, len(module.JOINTS), seed=7):
        _same(module, library, q, None)


@pytest.mark.parametrize("kind", ["wrist", "elbow", "wrist, nearly", "elbow, nearly"])
def test_agrees_with_numpy_at_singular_poses(kind: str) -> None:
    module, library = both(puma)
    for q in puma_poses(kind, 100):
        pose = module.fk(q)
        count, solutions = library.ik(pose, q)
        expected = module.ik(pose, reference=q)
        if count == len(expected):
            # Next to a singular pose digits of the angles are lost, in each language others, and none of the pose.
            assert (same_angles(solutions, expected) < 0.1).all()
        else:
            # theta4 is free in one language, and has a twin in the other, where s5 is within rounding of tau.
            assert 5e-15 < np.abs(np.sin([*solutions[:, 4], *expected[:, 4]])).min() < 4e-14
        for solution in solutions:
            np.testing.assert_allclose(library.fk(solution), pose, atol=1e-12)


def _same(module: Any, library: CLibrary, q: np.ndarray, reference: np.ndarray | None) -> None:
    pose = module.fk(q)
    np.testing.assert_allclose(library.fk(q), pose, atol=1e-15)
    np.testing.assert_allclose(library.jacobian(q), module.jacobian(q), atol=1e-14)
    count, solutions = library.ik(pose, reference)
    expected = module.ik(pose, reference=reference)
    assert count == len(expected)
    assert (same_angles(solutions, expected) < 1e-9).all()  # pi may be next to -pi in the other language


@pytest.mark.parametrize("reach", [1.2, 1.2 - 1e-9, 1.2 + 1e-11, 0.2, 0.2 - 1e-11, 5.0])
def test_agrees_with_numpy_at_the_border(reach: float) -> None:
    module, library = both(planar_2r)
    pose = np.eye(4)
    pose[:2, 3] = reach * math.cos(2.0), reach * math.sin(2.0)
    count, solutions = library.ik(pose)
    np.testing.assert_allclose(solutions, module.ik(pose), atol=1e-12)
    assert count == len(solutions)


def test_gate_and_wider_border_as_in_numpy() -> None:
    module, library = both(polar)
    pose = np.eye(4)
    for height, count in [(0.0, 2), (1e-10, 2), (1e-6, 0)]:
        pose[:3, 3] = 0.3, 0.4, height
        assert library.status(pose) == len(module.ik(pose)) == count
    _, library = both(planar_2r)
    pose = np.eye(4)
    pose[0, 3] = 1.2 + 1e-9
    assert library.status(pose) == 0
    pose[0, 0] += 1e-8
    assert library.status(pose) == 1


@pytest.mark.parametrize("scale", [1e-60, 1e-3, 1e3, 1e70, 1e140])
def test_huge_and_tiny_arms_as_in_numpy(scale: float) -> None:
    module, library = both(puma)
    lengths = {name: scale * value for name, value in module.PARAMETERS.items()}
    for q in joint_vectors(30, 6):
        pose = module.fk(q, **lengths)
        np.testing.assert_allclose(library.ik(pose, parameters=lengths)[1], module.ik(pose, **lengths), atol=1e-9)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 5.0, 1e300])
@pytest.mark.parametrize("place", range(16))
def test_what_is_no_pose_has_its_own_status(place: int, value: float) -> None:
    module, library = both(puma)
    pose = np.eye(4)
    pose.flat[place] = value
    if place in (3, 7, 11) and value == 5.0:
        assert library.status(pose) == 0  # a pose, out of reach
        return
    assert library.status(pose) == -1
    with pytest.raises(ValueError, match="no rigid motion"):
        module.ik(pose)


def test_reflections_and_zeros_are_no_poses() -> None:
    _, library = both(puma)
    assert library.status(np.zeros((4, 4))) == -1
    assert library.status(np.diag([1.0, 1.0, -1.0, 1.0])) == -1


def test_parameters() -> None:
    module, library = both(without_value)
    pose = module.fk([0.3, 0.4], a2=0.6)
    assert library.status(pose) == -2
    assert np.isnan(library.fk([0.3, 0.4])).all()
    assert np.isnan(library.jacobian([0.3, 0.4])).all()
    np.testing.assert_allclose(library.fk([0.3, 0.4], {"a2": 0.6}), pose, atol=1e-15)
    count, solutions = library.ik(pose, parameters={"a2": 0.6})
    assert count == 2
    np.testing.assert_allclose(solutions, module.ik(pose, a2=0.6), atol=1e-12)
    assert library.status(pose, {"a2": math.nan}) == -2
    assert library.status(pose, {"a2": math.inf}) == -2


def test_given_parameters_replace_those_of_the_table() -> None:
    module, library = both(puma)
    q, lengths = np.full(6, 0.4), {"a2": 0.5, "d3": 0.0}
    pose = module.fk(q, **lengths)
    np.testing.assert_allclose(library.fk(q, lengths), pose, atol=1e-15)
    np.testing.assert_allclose(library.ik(pose, parameters=lengths)[1], module.ik(pose, **lengths), atol=1e-12)


def test_the_plain_function_takes_the_reference_zero() -> None:
    module, library = both(puma)
    pose = module.fk([0.1, 0.2, 0.3, 0.4, 0.0, 0.5])
    near = library.ik(pose, np.zeros(6))
    q = np.zeros((8, 6))
    count = library._call("ik", pose.ctypes, None, q.ctypes)
    assert count == near[0]
    np.testing.assert_array_equal(q[:count], near[1])


def test_rotation_off_by_rounding_is_mended_as_in_numpy() -> None:
    module, library = both(puma)
    random = np.random.default_rng(5)
    for q in joint_vectors(50, 6, seed=9):
        pose = module.fk(q)
        pose[:3, :3] += random.uniform(-1e-9, 1e-9, (3, 3))
        np.testing.assert_allclose(library.ik(pose)[1], module.ik(pose), atol=1e-9)


def test_example_of_the_header_compiles(tmp_path: Path) -> None:
    for make in (puma, without_value):
        schedule = make()
        write(schedule, tmp_path)
        header = (tmp_path / f"{schedule.name}.h").read_text(encoding="utf-8")
        example = [line[6:] for line in header.splitlines() if line.startswith(" *     ")]
        body = "\n".join(example).replace("a2};", "0.5};")
        program = f'#include <stdio.h>\n#include "{schedule.name}.h"\n#define use(q) printf("%g\\n", (q)[0])\n'
        program += f"int main(void) {{\n{body}\nreturn 0;\n}}\n"
        (tmp_path / "example.c").write_text(program, encoding="utf-8")
        finished = subprocess.run(
            [find_compiler() or "cc", "-std=c99", "-fsyntax-only", "example.c"],
            cwd=tmp_path,
            capture_output=True,
            text=True,
            check=False,
        )
        assert finished.returncode == 0, finished.stderr


def test_a_source_that_does_not_compile_is_reported(tmp_path: Path) -> None:
    (tmp_path / "bad.c").write_text("int f(void) { int unused; return 0; }\n", encoding="utf-8")
    with pytest.raises(CheckFailed, match=r"bad\.c does not compile"):
        compile_shared(tmp_path, "bad", tmp_path)
