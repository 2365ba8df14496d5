"""The target ikfast: compiled every way that its macros allow, and its answers beside those of the NumPy module."""

from __future__ import annotations

import ctypes
import itertools
import re
import subprocess
from dataclasses import replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest

from kinsym.check.cpp import IkfastSolver, build_ikfast
from kinsym.command.rendering import rendered
from kinsym.deriving import derive
from kinsym.emit import TARGETS
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from kinsym.emit.source.ikfast import companions
from kinsym.errors import RobotError
from kinsym.robot import from_inline
from kinsym.robot.model import Task
from tests.arms import derivation
from tests.emit.built import numpy_module, same_angles
from tests.emit.schedules import planar_2r, puma
from tests.targets.built import COMPILERS, compiled, needs_compiler, write

pytestmark = needs_compiler

#: Every macro that ikfast.h names, each compiled with another standard.
MACROS = {
    "plain": ("-std=c++11",),
    "library": ("-std=c++17", "-DIKFAST_HAS_LIBRARY"),
    "no main": ("-std=c++11", "-DIKFAST_NO_MAIN"),
    "c library": ("-std=c++17", "-DIKFAST_CLIBRARY", "-DIKFAST_NO_MAIN"),
    "namespace": ("-std=c++11", "-DIKFAST_NAMESPACE=robot"),
    "float": ("-std=c++17", "-DIKFAST_REAL=float"),
    "all": ("-std=c++20", "-DIKFAST_HAS_LIBRARY", "-DIKFAST_CLIBRARY", "-DIKFAST_NAMESPACE=robot"),
}


def iiwa() -> Schedule:
    """Seven joints, theta3 an input."""
    return build_schedule(derivation("kuka_iiwa"))


def five() -> Schedule:
    """Five joints that place a point and an axis: the last twist turns the tool's axis away from axis 5."""
    table = "pi/2 0 0.3 theta1; 0 0.4 0 theta2; 0 0.35 0 theta3; pi/2 0 0 theta4; pi/2 0 0.1 theta5"
    return build_schedule(derive(from_inline(table, convention="paul", name="five")))


def prepare(schedule: Schedule, folder: Path) -> None:
    """The solver beside a header of the same interface."""
    write(schedule, "ikfast", folder)
    for name, text in companions(schedule).items():
        (folder / name).write_text(text, encoding="utf-8")


@cache
def solver(make: object) -> IkfastSolver:
    """The solver of a schedule, compiled inside a namespace as MoveIt's plugin has it."""
    schedule = make()  # type: ignore[operator]
    with TemporaryDirectory() as folder:
        write(schedule, "ikfast", Path(folder))
        return IkfastSolver(build_ikfast(schedule, Path(folder), COMPILERS[0]), schedule)


@pytest.mark.parametrize(("compiler", "macros"), list(itertools.product(COMPILERS, MACROS)))
def test_it_compiles_every_way(compiler: str, macros: str, tmp_path: Path) -> None:
    prepare(planar_2r(), tmp_path)
    compiled(compiler, tmp_path, "planar_ikfast.cpp", *MACROS[macros], "-fsyntax-only")


@pytest.mark.parametrize("compiler", COMPILERS)
@pytest.mark.parametrize("task", [Task.POSE, Task.ORIENTATION, Task.POSITION, Task.POSITION_AXIS])
def test_every_type_compiles(task: Task, compiler: str, tmp_path: Path) -> None:
    prepare(replace(planar_2r(), task=task), tmp_path)
    compiled(compiler, tmp_path, "planar_ikfast.cpp", "-std=c++11", "-fsyntax-only")


def test_two_solvers_and_a_plugin_in_one_program(tmp_path: Path) -> None:
    """Nothing of the C leaves the file: neither a macro nor a symbol that a second copy would meet."""
    prepare(planar_2r(), tmp_path)
    plugin = """#include <cmath>
#include <vector>
namespace NAME {
#define IKFAST_NO_MAIN
#include "planar_ikfast.cpp"
}
#if defined(TURN) || defined(NEAR) || defined(IS_FREE) || defined(ENTRIES) || defined(restrict)
#error "a macro is left"
#endif
"""
    for name in ("one", "two"):
        (tmp_path / f"{name}.cpp").write_text(plugin.replace("NAME", name), encoding="utf-8")
    (tmp_path / "main.cpp").write_text("int main() { return 0; }\n", encoding="utf-8")
    compiled(COMPILERS[0], tmp_path, "main.cpp", "one.cpp", "two.cpp", "-std=c++17", "-o", "program")


def test_the_first_line_is_what_the_generator_of_moveit_looks_for() -> None:
    """create_ikfast_moveit_plugin.py: the line's beginning, its pattern, a version of at least 56."""
    (text,) = TARGETS["ikfast"](puma()).values()
    first = text.splitlines()[0]
    assert first.startswith("/// ikfast version")
    found = re.search("ikfast version (.*) generated", first)
    assert found is not None
    assert int(found.group(1), 0) & ~0x10000000 == 74


@pytest.mark.parametrize(
    ("make", "told"),
    [
        (puma, [6, 0, -1, 0x67000001, 8]),
        (planar_2r, [2, 0, -1, 0x33000003, 8]),
        (iiwa, [7, 1, 2, 0x67000001, 8]),
        (five, [5, 0, -1, 0x56000007, 8]),
    ],
)
def test_it_says_what_it_is_and_agrees_with_numpy(make: object, told: list[int]) -> None:
    """Numbers of IkParameterizationType in MoveIt's plugin. Forward, back, and the same solutions in the same order."""
    own = solver(make)
    assert own.told() == told
    module = numpy_module(own.schedule)
    random = np.random.default_rng(3)
    q = random.uniform(-3.0, 3.0, (40, told[0]))
    poses, rows = module.fk(q), {0x67000001: "uvwp", 0x33000003: "p", 0x56000007: "wp"}[told[3]]
    columns = ["uvwp".index(name) for name in rows]
    np.testing.assert_allclose(own.forward(q)[:, :3, columns], poses[:, :3, columns], atol=1e-15)
    found, counts = own.inverse(poses, q)
    for pose, known, solutions, count in zip(poses, q, found, counts, strict=True):
        expected = module.ik(pose, **dict(zip(own.schedule.inputs, known[2:], strict=False)))
        assert count == len(expected) >= 1
        assert (same_angles(solutions[:count], expected) < 1e-9).all()
        assert same_angles(solutions[:count], known).min() < 1e-9


def test_a_joint_left_open_is_zero_and_no_free_parameter(tmp_path: Path) -> None:
    """In line with what MoveIt's plugin does with free parameters of a solution: it sets them to 0."""
    own = solver(puma)
    pose = own.forward(np.array([[0.3, -0.4, 0.5, 0.7, 0.0, 0.2]]))
    found, (count,) = own.inverse(pose, np.zeros((1, 6)))
    open_ = np.abs(found[0, :count, 4]) < 1e-9
    assert open_.any()
    assert (found[0, :count, 3][open_] == 0.0).all()
    prepare(puma(), tmp_path)
    program = """#include "puma_ikfast.cpp"
int main()
{
    const double q[6] = {0.3, -0.4, 0.5, 0.7, 0.0, 0.2};
    double trans[3], rot[9];
    ikfast::IkSolutionList<double> found;
    ComputeFk(q, trans, rot);
    ComputeIk(trans, rot, nullptr, found);
    unsigned before = 0, wrong = found.GetNumSolutions() < 4;
    for (size_t k = 0; k < found.GetNumSolutions(); ++k) {
        const std::vector<ikfast::IkSingleDOFSolutionBase<double> > &joints = found.GetSolution(k).joints;
        wrong += !found.GetSolution(k).GetFree().empty() || found.GetSolution(k).GetDOF() != 6;
        wrong += (k > 0 && joints[0].indices[0] <= before) || joints[0].indices[0] >= joints[0].maxsolutions;
        before = joints[0].indices[0];
        for (size_t i = 0; i < 6; ++i) {
            wrong += joints[i].jointtype != 1 || joints[i].freeind != -1;
            wrong += joints[i].indices[0] >= joints[i].maxsolutions;
        }
    }
    return (int)wrong;
}
"""
    (tmp_path / "ask.cpp").write_text("#define IKFAST_NO_MAIN\n" + program, encoding="utf-8")
    compiled(COMPILERS[0], tmp_path, "ask.cpp", "-std=c++11", "-o", "ask")
    assert subprocess.run([str(tmp_path / "ask")], check=False).returncode == 0


def test_floats_and_the_program(tmp_path: Path) -> None:
    """With IKFAST_REAL=float poses have seven digits, and so have the solutions; the program prints them all."""
    prepare(puma(), tmp_path)
    compiled(COMPILERS[0], tmp_path, "puma_ikfast.cpp", "-std=c++17", "-DIKFAST_REAL=float", "-o", "ask")
    module = numpy_module(puma())
    pose = module.fk([0.3, -0.4, 0.5, 0.7, 0.9, 0.2])
    ask = [str(tmp_path / "ask")]
    done = subprocess.run([*ask, *map(repr, map(float, pose[:3].ravel()))], capture_output=True, text=True, check=True)
    printed = np.array([[float(word) for word in line.split()] for line in done.stdout.splitlines()])
    assert (same_angles(printed, module.ik(pose)) < 1e-5).all()
    far = pose[:3] + np.array([0.0, 0.0, 0.0, 50.0])
    assert subprocess.run([*ask, *map(repr, map(float, far.ravel()))], capture_output=True, check=False).returncode == 1
    refused = subprocess.run(ask, capture_output=True, text=True, check=False)
    assert refused.returncode == 2
    assert "usage" in refused.stderr


def test_what_cannot_be_answered_is_false() -> None:
    """No rigid motion, NaN, and a free joint that is not given."""
    own = solver(iiwa)
    good = own.forward(np.full((1, 7), 0.4))
    for bad in (good * 1.01, np.full((1, 4, 4), np.nan)):
        assert own.inverse(bad, np.full((1, 7), 0.4))[1] == [0]
    assert own.inverse(good, np.full((1, 7), np.nan))[1] == [0]
    q = np.empty((8, 7))
    assert own._library.inverse(good.ctypes.data, ctypes.c_void_p(None), q.ctypes.data, 8) == 0


def test_a_parameter_without_a_value_is_refused() -> None:
    with pytest.raises(RobotError, match=r"planar: .* a2 has no value\. Fold numbers in, .*--bind a2="):
        TARGETS["ikfast"](planar_2r(a2=None))


def test_a_title_stays_in_its_comment(tmp_path: Path) -> None:
    prepare(planar_2r(title="*/ int trap; /*"), tmp_path)
    compiled(COMPILERS[0], tmp_path, "planar_ikfast.cpp", "-std=c++11", "-fsyntax-only")
    assert list(rendered(derivation("kuka_iiwa"), iiwa(), ("ikfast",))) == ["kuka_iiwa_ikfast.cpp"]
