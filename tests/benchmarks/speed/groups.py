"""What is compared with what, and by how much kinsym must be ahead."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from tests.benchmarks.speed.arms import ARMS, Floats
from tests.benchmarks.speed.entries import Entry, Goal, Group, Library, Python
from tests.benchmarks.speed.native import PLAIN, RECOMMENDED, Program, casadi_line, compilers, toolbox_solver
from tests.benchmarks.speed.own import Own

KINSYM, RUN_TIME, BATCH = "kinsym", "kinsym, parameters at run time", "kinsym, ik_batch"
TOOLBOX, CASADI, EAIK = "Robotics Toolbox", "casadi", "EAIK"
PACKAGE, MODULE = "kinsym, package", "kinsym, NumPy module"

GENERAL = "jaco"
#: The places for solutions in Robotics Toolbox's C.
TOOLBOX_ROWS = 64
#: Poses for C, for Python, for slow Python, for batches.
MANY, SOME, FEW, CROWD = 1000, 200, 20, 100_000


@dataclass(frozen=True, kw_only=True)
class Material:
    """What was derived and generated: kinsym's files of each arm, bound and not, and the C of others by its name."""

    bound: Mapping[str, Own]
    free: Mapping[str, Own]
    others: Path
    absent: Mapping[str, str]
    crowd: int = CROWD


def groups(material: Material) -> Iterator[Group]:
    """Every comparison; programs are compiled on the way."""
    for arm in material.bound:
        for compiler in compilers():
            if arm == GENERAL:
                yield _one_pose(material, arm, compiler, RECOMMENDED, 3.0)
                continue
            yield _one_pose(material, arm, compiler, RECOMMENDED, 30.0)
            yield _one_pose(material, arm, compiler, PLAIN, 10.0)
            for function in ("fk", "jacobian"):
                yield _line(material, arm, compiler, function)
        yield _python(material, arm)
        if arm != GENERAL:
            yield _batch(material, arm)


def _poses(arm: str, number: int) -> tuple[Floats, Floats]:
    q = ARMS[arm].sample(number, seed=1)
    return q, np.ascontiguousarray(ARMS[arm].forward(q))


def _one_pose(material: Material, arm: str, compiler: str, flags: str, ahead: float) -> Group:
    bound, free = material.bound[arm], material.free[arm]
    tag = f"{compiler}_{'plain' if flags == PLAIN else 'best'}"
    shape = (bound.schedule.maximum, len(bound.schedule.joints))
    number = MANY if bound.schedule.general is None else FEW * 5
    entries = [
        _entry(KINSYM, arm, _built(bound.solver(), compiler, flags, f"ik_{tag}"), shape, number),
        _entry(RUN_TIME, arm, _built(free.solver(), compiler, flags, f"ik_{tag}"), shape, number),
    ]
    goals = [Goal(entry=RUN_TIME, ratio=1.25, most=True), Goal(entry=TOOLBOX, ratio=ahead)]
    if bound.has_batch:
        entries.append(_entry(BATCH, arm, _built(bound.batch(), compiler, flags, f"batch_{tag}"), shape, number))
        goals += [Goal(entry=BATCH, ratio=1.0, most=True)] if flags == RECOMMENDED and number == MANY else []
    source = material.others / f"{arm}_toolbox.c"
    if source.exists():
        program = Program(folder=material.others, sources=(source.name,), adapter=toolbox_solver(f"{arm}_toolbox"))
        path = _built(program, compiler, flags, f"{source.stem}_{tag}")
        entries.append(_entry(TOOLBOX, arm, path, (TOOLBOX_ROWS, shape[1]), number))
    title = f"C, all solutions of one pose: {compiler} {flags}"
    return Group(
        title=title, arm=arm, kind="ik", inputs=_poses(arm, number)[1], entries=tuple(entries), goals=tuple(goals)
    )


def _line(material: Material, arm: str, compiler: str, function: str) -> Group:
    shape = (1, 16 if function == "fk" else 6 * len(ARMS[arm].rows))
    own = _built(material.bound[arm].line(function), compiler, RECOMMENDED, f"{function}_{compiler}")
    entries = [_entry(KINSYM, arm, own, shape, MANY)]
    source = material.others / f"{arm}_casadi_{function}.c"
    if source.exists():
        adapter = casadi_line(source.stem, len(ARMS[arm].rows))
        program = Program(folder=material.others, sources=(source.name,), adapter=adapter)
        path = _built(program, compiler, RECOMMENDED, f"{source.stem}_{compiler}")
        entries.append(_entry(CASADI, arm, path, shape, MANY))
    return Group(
        title=f"C, {'forward kinematics' if function == 'fk' else 'Jacobian'}: {compiler} {RECOMMENDED}",
        arm=arm,
        kind=function,
        inputs=_poses(arm, MANY)[0],
        entries=tuple(entries),
        goals=(Goal(entry=CASADI, ratio=1.0),),
    )


def _python(material: Material, arm: str) -> Group:
    own = material.free[arm]
    entries = [
        Entry(name=PACKAGE, arm=arm, program=Python(peer="kinsym", folder=own.package(compilers()[0])), number=SOME),
        Entry(name=MODULE, arm=arm, program=Python(peer="kinsym", folder=own.folder), number=FEW),
        Entry(name=EAIK, arm=arm, program=Python(peer="eaik"), number=SOME),
        Entry(name="ssik", arm=arm, program=Python(peer="ssik"), number=FEW),
        Entry(name=TOOLBOX, arm=arm, program=Python(peer="roboticstoolbox"), number=FEW),
        Entry(name="OPW", arm=arm, program=Python(peer="opw"), number=SOME),
        Entry(name="UR", arm=arm, program=Python(peer="ur"), number=SOME),
    ]
    kept = tuple(entry for entry in entries if entry.name not in material.absent)
    return Group(
        title="Python, all solutions of one pose",
        arm=arm,
        kind="ik",
        inputs=_poses(arm, SOME)[1],
        entries=kept,
        goals=(Goal(entry=EAIK, ratio=1.5), Goal(entry=TOOLBOX, ratio=5.0, over=MODULE)),
    )


def _batch(material: Material, arm: str) -> Group:
    own, number = material.free[arm], material.crowd
    entries = [
        Entry(name=MODULE, arm=arm, program=Python(peer="kinsym", many=True, folder=own.folder), number=number),
        Entry(
            name=PACKAGE,
            arm=arm,
            program=Python(peer="kinsym", many=True, folder=own.folder / f"{arm}-solver" / "src"),
            number=number,
        ),
        Entry(name=EAIK, arm=arm, program=Python(peer="eaik", many=True), number=number),
    ]
    return Group(
        title=f"Python, all solutions of {number} poses",
        arm=arm,
        kind="ik",
        inputs=_poses(arm, number)[1],
        entries=tuple(entry for entry in entries if entry.name not in material.absent),
        goals=(Goal(entry=EAIK, ratio=1.0),),
    )


def _entry(name: str, arm: str, path: Path, shape: tuple[int, int], number: int) -> Entry:
    return Entry(name=name, arm=arm, program=Library(path=path, rows=shape[0], width=shape[1]), number=number)


def _built(program: Program, compiler: str, flags: str, name: str) -> Path:
    try:
        return program.build(compiler, flags, name)
    except subprocess.CalledProcessError as error:
        raise RuntimeError(f"{name} does not compile with {compiler}:\n{error.stderr[:2000]}") from error
