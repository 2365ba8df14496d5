"""kinsym from Python: what ``import kinsym`` offers, and that it is what the command line gives."""

from __future__ import annotations

import ast
import subprocess
import sys
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import kinsym as ks
from kinsym import derivation
from kinsym.check import compare, compiler, extension
from kinsym.check.report import FAILED, Check
from kinsym.emit.live import live_module
from kinsym.errors import KinsymError, OutputError
from kinsym.interface import compiling
from kinsym.interface.compiling import FLAGS
from kinsym.live import live

Q = np.array([0.3, -1.2, 0.9, 0.4, 0.7, -0.5])
TEMPLATES = Path(__file__).resolve().parent.parent / "templates"


@cache
def derived(name: str) -> ks.Solution:
    return ks.derive(ks.load(name))


def run(code: str) -> str:
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def test_the_import_is_quick() -> None:
    """It loads neither SymPy nor NumPy, and neither do the names and the gallery."""
    heavy = "print(sorted({'sympy', 'numpy', 'jinja2', 'mpmath'} & set(sys.modules)))"
    assert run(f"import sys, kinsym; kinsym.gallery(); dir(kinsym); kinsym.KinsymError; {heavy}") == "[]"


def test_everything_that_is_offered_is_there() -> None:
    assert [name for name in ks.__all__ if not hasattr(ks, name)] == []
    assert set(ks.__all__) <= set(dir(ks))
    with pytest.raises(AttributeError, match="no attribute 'derives'"):
        _ = ks.derives  # type: ignore[attr-defined]


def test_a_type_checker_sees_what_is_loaded() -> None:
    """The imports that are for type checkers alone name the places that the names are loaded from, and no others."""
    source = Path(str(ks.__file__)).read_text(encoding="utf-8")
    (block,) = (
        node for node in ast.parse(source).body if isinstance(node, ast.If) and "not" not in ast.dump(node.test).lower()
    )
    seen = {item.name: node.module for node in block.body if isinstance(node, ast.ImportFrom) for item in node.names}
    assert seen == ks._PLACES
    assert sorted({*seen, "__version__"}) == sorted(ks.__all__)
    assert Path(str(ks.__file__)).with_name("py.typed").exists()


@pytest.mark.parametrize("name", ["ur5", "ufactory_xarm6"])
def test_the_formulas_can_be_called(name: str) -> None:
    """With joint vectors and poses they are the generated module."""
    found, module = derived(name), live_module(derived(name).schedule)
    pose = found.fk(Q)
    assert np.array_equal(pose, module.fk(Q))
    assert np.array_equal(found.jacobian(Q), module.jacobian(Q))
    assert np.array_equal(found.ik(pose), module.ik(pose))
    assert np.abs(found.fk(found.ik(pose)) - pose).max() < 1e-9
    with pytest.raises(ValueError, match="shape"):
        found.fk([0.1])
    with pytest.raises(ValueError, match="no rigid motion"):
        found.ik(np.full((4, 4), np.nan))


def test_parameters_without_a_value_are_keywords() -> None:
    found = derived("planar_rr")
    pose = found.fk([0.3, 0.7], l1=0.4, l2=0.3)
    assert np.allclose(found.ik(pose, l1=0.4, l2=0.3), [[0.3, 0.7], found.ik(pose, l1=0.4, l2=0.3)[1]])
    with pytest.raises(TypeError, match="l2"):
        found.fk([0.3, 0.7], l1=0.4)


@pytest.mark.parametrize("name", ["fanuc_s900w", "stanford_screw", "scara", "raven_2"])
def test_the_formulas_in_sympy_are_the_numbers(name: str) -> None:
    """T and J as matrices of SymPy, base, tool, twists and all, evaluated at a posture."""
    found = derived(name)
    robot = found.robot
    missing = {key: 0.3 + 0.1 * k for k, (key, value) in enumerate(robot.parameters.items()) if value is None}
    known = {key: float(value) for key, value in robot.parameters.items() if value is not None}
    q = Q[: len(robot.variables)]
    point = {**missing, **known, **dict(zip(robot.variables, q, strict=True))}
    for formulas, numbers in (
        (found.fk.sympy(), found.fk(q, **missing)),
        (found.jacobian.sympy(), found.jacobian(q, **missing)),
    ):
        assert np.abs(np.array(formulas.subs(point).evalf(), dtype=float) - numbers).max() < 1e-12


def test_the_steps_are_those_of_the_plan() -> None:
    ik = derived("puma560").ik
    assert [step.unknown for step in ik] == ["theta1", "theta3", "theta2", "theta4", "theta5", "theta6"]
    assert (len(ik), ik.maximum, ik.closed_form, ik[0].branches) == (6, 8, True, 2)
    assert ik.branches[0] == "shoulder left, elbow up, wrist flipped"
    assert "theta3 = Atan2(s3, c3)" in ik["theta3"].text()
    assert ik["theta3"].why
    with pytest.raises(KeyError, match="no step finds 'theta23'; the steps find theta1, theta3"):
        ik["theta23"]
    general = derived("ufactory_xarm6").ik
    assert (len(general), general.maximum, general.closed_form, general.branches) == (0, 16, False, ())
    with pytest.raises(KeyError, match="there is no closed form"):
        general["theta1"]


def test_documents_are_those_of_the_command(capsys: pytest.CaptureFixture[str]) -> None:
    from kinsym.cli import main
    from kinsym.emit.latex import document

    found = derived("puma560")
    assert main(["show", "puma560"]) == 0
    shown = capsys.readouterr().out
    assert shown == found.text()
    for part in (found.ik.text(), found.singular.text(), found.ik["theta4"].text()):
        assert part in shown
    assert found.latex() == document(found.derivation)
    assert main(["show", "puma560", "--full"]) == 0
    full = capsys.readouterr().out
    assert full == found.text(full=True)
    assert found.jacobian.text() in full
    for part in found.fk.text().split("\n\n  T = "):
        assert part in full


def test_files_are_checked_and_written(tmp_path: Path) -> None:
    """As ``kinsym derive`` does: sources and report, the report's verdict with them."""
    written = derived("planar_rr").write(tmp_path / "out")
    assert [path.name for path in written.paths] == [
        f"planar_rr{suffix}" for suffix in (".py", ".c", ".h", ".tex", ".report.json")
    ]
    assert written.report.passed
    assert {path.name for path in (tmp_path / "out").iterdir()} == {path.name for path in written.paths}
    texts = derived("planar_rr").sources()
    assert {name: (tmp_path / "out" / name).read_text() for name in texts} == texts


def test_one_target_without_checks(tmp_path: Path) -> None:
    written = derived("ur5").write(tmp_path, "numpy", check=False)
    assert [path.name for path in written.paths] == ["ur5.py", "ur5.report.json"]
    assert written.report.verdict == "not run"
    with pytest.raises(KinsymError, match=r"no target 'nunpy'. Did you mean numpy\?"):
        derived("ur5").write(tmp_path, ["nunpy"])


def test_what_fails_its_checks_is_not_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    failed = Check(law="FK(IK(T)) = T", subject="C", status=FAILED, tried=9, failed=1)
    monkeypatch.setattr(compare, "compare", lambda *_: compare.Findings(checks=(failed,)))
    with pytest.raises(ks.CheckFailed, match=r"planar_rr: 1 of 1 checks failed: C: FK\(IK\(T\)\) = T. Nothing was"):
        derived("planar_rr").write(tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_a_file_in_the_way_is_told_first(tmp_path: Path) -> None:
    (tmp_path / "out").write_text("mine")
    with pytest.raises(OutputError, match="out"):
        derived("planar_rr").write(tmp_path / "out")
    assert (tmp_path / "out").read_text() == "mine"


def test_a_live_arm_has_the_functions_of_the_module() -> None:
    arm = derived("puma560").numpy()
    module, pose = arm.module, arm.fk(Q)
    q, valid = arm.ik_batch(pose[None])
    assert np.array_equal(q[valid], module.ik_batch(pose)[0])
    assert np.array_equal(arm.ik(pose), module.ik(pose))
    assert np.array_equal(arm.jacobian(Q), module.jacobian(Q))
    near = arm.nearest(pose, Q + 2 * np.pi, weights=np.ones(6))
    assert near is not None
    assert np.allclose(near, Q + 2 * np.pi)
    solved = arm.solve(pose)
    assert [module.BRANCHES[k] for k in solved.branch] == list(solved.names)
    limits = np.array([[-0.5, 0.5], *[[-np.inf, np.inf]] * 5])
    assert 0 < len(arm.within(pose, limits=limits).q) < len(solved.q)
    assert arm.solve(np.zeros((4, 4))).status == "not a pose"


def test_solutions_show_themselves() -> None:
    """A table of branches; a joint that is free and a length of zero say what they are."""
    arm = derived("puma560").numpy()
    solved = arm.solve(arm.fk([0.1, 0.2, 0.3, 0.4, 0.0, 0.6]), reference=[0.0, 0.0, 0.0, -1e-9, 0.0, 0.0])
    lines = str(solved).splitlines()
    assert lines[0].split() == ["branch", *arm.robot.variables]
    assert len(lines) == 1 + len(solved.q)
    assert "0.0000 free" in str(solved)
    assert "-0.0000" not in solved.text()
    assert solved.markdown().splitlines()[0].startswith(r"| branch | $\theta_{1}$ |")
    beyond = arm.solve(np.diag([1.0, 1.0, 1.0, 1.0]) + np.eye(4, k=3) * 9)
    assert beyond.markdown() == beyond.text() == "unreachable"


def test_an_input_has_a_value_and_may_get_another() -> None:
    robot = ks.lock(ks.load("kuka_iiwa"), {"theta3": None})
    arm = ks.derive(robot).numpy({"theta3": 0.4})
    pose = arm.fk([0.3, 0.5, 0.4, -1.0, 0.2, 0.7, 0.1])
    assert set(arm.ik(pose)[:, 2]) == {0.4}
    assert set(arm.ik(pose, theta3=0.5)[:, 2]) == {0.5}
    assert set(arm.solve(pose, theta3=0.5).q[:, 2]) == {0.5}
    with pytest.raises(ks.RobotError, match="theta3 has no value"):
        ks.derive(robot).numpy()


def test_compiled_it_is_the_same() -> None:
    """C in place of NumPy, with the values that are given; the folder it was built in is gone."""
    values = {"l1": 0.4, "l2": 0.3}
    compiled, plain = ks.compile(ks.load("planar_rr"), values), live(ks.load("planar_rr"), values)
    assert not Path(str(compiled.module.__file__)).exists()
    assert compiled.module._core.__name__.endswith("_core")
    q = np.linspace(-3.0, 3.0, 40).reshape(20, 2)
    poses = plain.fk(q)
    assert np.allclose(compiled.fk(q), poses, rtol=0, atol=1e-14)
    assert np.allclose(compiled.ik(poses[0]), plain.ik(poses[0]), rtol=0, atol=1e-12)
    found, valid = compiled.ik_batch(poses)
    expected = plain.ik_batch(poses)
    assert np.array_equal(valid, expected[1])
    assert np.allclose(found, expected[0], rtol=0, atol=1e-9, equal_nan=True)
    assert compiled.solve(poses[0]).names == plain.solve(poses[0]).names
    with pytest.raises(ks.RobotError, match="l2 has no value"):
        ks.compile(ks.load("planar_rr"), {"l1": 0.4})


def test_flags_are_those_of_the_package() -> None:
    setup = (TEMPLATES / "extension" / "setup.py.jinja").read_text(encoding="utf-8")
    assert ", ".join(f'"{flag}"' for flag in FLAGS[1:]) in setup


@pytest.mark.parametrize(
    ("missing", "message"),
    [("find_compiler", "no C compiler was found. Install gcc or clang"), ("headers", r"Python.h is not in .*python3")],
)
def test_what_a_build_needs_is_told(missing: str, message: str, monkeypatch: pytest.MonkeyPatch) -> None:
    assert {"find_compiler": compiler, "headers": extension}[missing].__dict__[missing]() is not None
    monkeypatch.setattr(compiling, missing, lambda: None)
    with pytest.raises(KinsymError, match=f"(?s)ur5 cannot be compiled: {message}.* needs none"):
        derived("ur5").compile()


def test_what_is_no_robot_is_told() -> None:
    for call in (ks.derive, ks.compile):
        with pytest.raises(ks.RobotError, match=r"ur5.* is no robot. Load it first: derive\(load\(\"ur5\"\)\)"):
            call("ur5")  # type: ignore[operator]


def test_an_arm_whose_entries_fill_pages_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    found = ks.derive(ks.load("planar_rr"))
    assert "J_1 = " in found.jacobian.text()
    monkeypatch.setattr(derivation, "MOST_TERMS", 0)
    pages = (found.fk.text(), found.jacobian.text(), found.fk.markdown(), found.jacobian.markdown())
    assert ["would fill pages" in page for page in pages] == [True] * 4
    assert not ["J_1 = " for page in pages if "J_1 = " in page or "p_x =" in page]


def test_short_names_for_the_console() -> None:
    found = derived("puma560")
    names = [repr(thing) for thing in (found, found.fk, found.ik, found.jacobian, found.singular, found.ik["theta3"])]
    assert names == [
        "<Solution of puma560>",
        "<ForwardKinematics of puma560>",
        "<InverseKinematics of puma560>",
        "<Jacobian of puma560>",
        "<SingularPoses of puma560>",
        "<step 2 of puma560: theta3>",
    ]
    assert str(found.ik["theta3"]) == found.ik["theta3"].text()
    assert len(found.singular.conditions) == 3
