"""The package answers as the NumPy module does: for arms of every kind, and where its calls differ."""

from __future__ import annotations

import inspect
import threading

import numpy as np
import pytest

from kinsym.check import sources
from kinsym.check.compare import compare
from kinsym.check.report import FAILED, NOT_RUN, PASSED
from kinsym.command.rendering import rendered
from kinsym.emit.program import build_schedule
from tests.extension.built import ARMS, derivation, pair, same

FUNCTIONS = ("fk", "jacobian", "ik", "ik_batch", "ik_sweep", "solve", "within", "nearest")
CONSTANTS = "NAME TITLE JOINTS JOINT_TYPES PARAMETERS LOCKED TASK MAX_SOLUTIONS BRANCHES LIMITS".split()


@pytest.mark.parametrize("name", ARMS)
def test_it_can_take_the_modules_place(name: str) -> None:
    """The same constants, the same functions, the same arguments with the same defaults."""
    package, module, *_ = pair(name)
    for constant in CONSTANTS:
        assert getattr(package, constant, None) == getattr(module, constant, None)
    for function in FUNCTIONS:
        assert hasattr(package, function) == hasattr(module, function)
        if hasattr(module, function):
            own, other = (inspect.signature(getattr(one, function)).parameters for one in (package, module))
            assert [(p.name, p.kind, p.default) for p in own.values()] == [
                (p.name, p.kind, p.default) for p in other.values()
            ]
    assert package.Solutions._fields == module.Solutions._fields


@pytest.mark.parametrize("name", ARMS)
def test_same_answers(name: str) -> None:
    """Every function, at random poses and at singular ones, where joints are free and the reference counts.

    Where an arm without a closed form moves while its tool stands still it is left open which solutions come out.
    """
    package, module, given, asked = pair(name)
    q, poses = pair(name).poses(30)
    if derivation(name).plan:
        # the last joint but one is that of a wrist, whose axes come in line at zero
        q[:6, -2] = 0.0
        poses[:6] = module.fk(q[:6], **given)
    near = q + 0.3
    assert same(package.fk(q, **given), module.fk(q, **given), 1e-12)
    assert same(package.jacobian(q[0], **given), module.jacobian(q[0], **given), 1e-12)
    assert same(
        package.ik_batch(poses, reference=near, **asked),
        module.ik_batch(poses, reference=near, **asked),
        1e-7,
        turns=True,
    )
    limits = [(-4.0, 7.0)] * q.shape[1]
    for row, T in enumerate(poses):
        assert same(package.ik(T, **asked), module.ik(T, **asked), 1e-7, turns=True)
        for extra in ({}, {"reference": near[row]}):
            assert same(package.solve(T, **asked, **extra), module.solve(T, **asked, **extra), 1e-7, turns=True)
            assert same(
                package.within(T, limits=limits, **asked, **extra), module.within(T, limits=limits, **asked, **extra)
            )
        weights = np.arange(1.0, 1.0 + q.shape[1])
        assert same(
            package.nearest(T, near[row] + 5.0, weights=weights, **asked),
            module.nearest(T, near[row] + 5.0, weights=weights, **asked),
            1e-7,
            turns=True,
        )


@pytest.mark.parametrize("name", ["puma560", "kuka_iiwa", "two_inputs", "planar_rr"])
def test_batches_of_any_shape(name: str) -> None:
    """Axes before the last ones, none of them, an empty one; values of locked joints broadcast against the poses."""
    package, module, given, asked = pair(name)
    q, poses = pair(name).poses(6)
    for shape in ((6,), (2, 3), (), (0,), (3, 0, 2)):
        some = np.resize(q, (*shape, q.shape[1])) if shape else q[0]
        T = module.fk(some, **given)
        assert same(package.fk(some, **given), T, 1e-12)
        assert same(package.jacobian(some, **given), module.jacobian(some, **given), 1e-12)
        for reference in (None, q[0], some):
            assert same(
                package.ik_batch(T, reference=reference, **asked), module.ik_batch(T, reference=reference, **asked)
            )
    for joint in getattr(module, "LOCKED", {}):
        values = {**asked, joint: np.linspace(-1.0, 1.0, 6)}
        assert same(package.ik_batch(poses[:, None], **values), module.ik_batch(poses[:, None], **values))
        assert same(package.ik_sweep(poses[0], **values), module.ik_sweep(poses[0], **values))


@pytest.mark.parametrize("name", ["kuka_iiwa", "planar_rr"])
def test_every_law_is_kept(name: str) -> None:
    """The checks of a derivation hold the package to every law, and against the module."""
    found = derivation(name)
    schedule = build_schedule(found)
    findings = compare(found.robot, schedule, rendered(found, schedule, ("numpy", "extension")))
    assert [check for check in findings.checks if check.status != PASSED] == []
    own = {check.law for check in findings.checks if check.subject == "extension"}
    assert {check.law for check in findings.checks if check.subject == "NumPy"} <= own
    assert {check.law for check in findings.checks if check.subject == "NumPy and extension"} >= {
        "same status",
        "same solutions in the same order",
        "same branches, free and border joints",
        "same numbers of solutions on both sides of a border",
    }


@pytest.mark.usefixtures("few_poses")
def test_laws_see_a_wrong_package() -> None:
    """A package whose C or Python was changed fails, and not with a crash."""
    found = derivation("planar_rr")
    schedule = build_schedule(found)
    files = rendered(found, schedule, ("extension",))
    core, package = "planar_rr-solver/c/_core.c", "planar_rr-solver/src/planar_rr/__init__.py"
    for path, old, new, law in (
        (core, "memcpy(&q[marks[k].branch * JOINTS]", "memcpy(&q[0]", "FK(IK(T)) = T for every solution"),
        (core, "PyMODINIT_FUNC", "PyMODINIT_FUNCTION", "the package can be built"),
        (package, "_core.fk(q, l1, l2)", "_core.fk(q, l2, l1)", "forward kinematics equal the exact ones"),
        (package, "MAX_SOLUTIONS: Final = 2", "MAX_SOLUTIONS: Final = 3", "the module can be imported"),
    ):
        assert old in files[path]
        checks = compare(found.robot, schedule, {**files, path: files[path].replace(old, new)}).checks
        assert law in {check.law for check in checks if check.status == FAILED}


@pytest.mark.usefixtures("few_poses")
@pytest.mark.parametrize(("missing", "words"), [("find_compiler", "no C compiler"), ("headers", "no Python.h")])
def test_without_a_compiler(missing: str, words: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The package is written, and the report says that it was not built."""
    monkeypatch.setattr(sources, missing, lambda: None)
    found = derivation("planar_rr")
    schedule = build_schedule(found)
    checks = compare(found.robot, schedule, rendered(found, schedule, ("extension",))).checks
    (left_out,) = (check for check in checks if check.law == "the package can be built")
    assert left_out.status == NOT_RUN
    assert words in left_out.note


def test_threads() -> None:
    """Batches run beside each other; every thread gets its own answer."""
    package, module, *_ = pair("puma560")
    _, poses = pair("puma560").poses(4000)
    parts = np.split(poses, 4)
    answers: list[np.ndarray | None] = [None] * 4

    def work(number: int) -> None:
        for _ in range(5):
            answers[number] = package.ik_batch(parts[number])[0]

    threads = [threading.Thread(target=work, args=(number,)) for number in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for part, answer in zip(parts, answers, strict=True):
        assert same(answer, module.ik_batch(part)[0])
