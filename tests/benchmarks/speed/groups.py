"""What is compared with what, and by how much kinsym must be ahead."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from tests.benchmarks.speed.arms import ARMS, Floats
from tests.benchmarks.speed.entries import Entry, Goal, Group, Library, Python, Refusal
from tests.benchmarks.speed.native import PLAIN, RECOMMENDED, Program, casadi_line, compilers, toolbox_solver
from tests.benchmarks.speed.own import Own

KINSYM, RUN_TIME, BATCH = "kinsym", "kinsym, parameters at run time", "kinsym, ik_batch"
PACKAGE, MODULE = "kinsym, package", "kinsym, NumPy module"
TOOLBOX, CASADI, EAIK = "Robotics Toolbox", "casadi", "EAIK"

GENERAL = "jaco"
#: The places for solutions in Robotics Toolbox's C.
TOOLBOX_ROWS = 64
#: Inputs for C, for solvers that search for roots, for Python, for slow Python, for batches.
MANY, SEARCHED, SOME, FEW, CROWD = 1000, 100, 200, 20, 100_000


@dataclass(frozen=True, kw_only=True)
class Material:
    """What was derived and generated: kinsym's files of each arm, lengths bound and free, and the C of others.

    ``refusals`` are by library and arm: not installed, or no solver for the arm.
    """

    bound: Mapping[str, Own]
    free: Mapping[str, Own]
    others: Path
    refusals: Mapping[tuple[str, str], str]
    crowd: int = CROWD


@dataclass(frozen=True, kw_only=True)
class Bench:
    """One arm in C with one compiler and one set of flags; what answers is ``rows`` of ``width`` numbers an input."""

    material: Material
    arm: str
    compiler: str
    flags: str
    number: int

    def own(self, name: str, program: Program, rows: int, width: int) -> Entry:
        """An entry of kinsym's."""
        return self._entry(name, Library(path=self._built(program), rows=rows, width=width))

    def other(self, name: str, source: str, adapter: str, rows: int, width: int) -> Entry:
        """An entry of a library whose C was generated, or the reason why there is none."""
        why = self.material.refusals.get((name, self.arm))
        if why is not None:
            return self._entry(name, Refusal(why=why))
        program = Program(folder=self.material.others, sources=(f"{source}.c",), adapter=adapter)
        return self._entry(name, Library(path=self._built(program), rows=rows, width=width))

    def _entry(self, name: str, program: Library | Refusal) -> Entry:
        return Entry(name=name, arm=self.arm, program=program, number=self.number)

    def _built(self, program: Program) -> Path:
        try:
            return program.build(self.compiler, self.flags)
        except subprocess.CalledProcessError as error:
            raise RuntimeError(f"{program.sources} with {self.compiler}:\n{error.stderr[:2000]}") from error


def groups(material: Material) -> Iterator[Group]:
    """Every comparison; programs are compiled on the way."""
    for arm in material.bound:
        for compiler in compilers():
            for flags in (RECOMMENDED,) if arm == GENERAL else (RECOMMENDED, PLAIN):
                number = SEARCHED if arm == GENERAL else MANY
                bench = Bench(material=material, arm=arm, compiler=compiler, flags=flags, number=number)
                yield _one_pose(bench)
                if flags == RECOMMENDED:
                    yield from (_line(bench, function) for function in ("fk", "jacobian"))
        yield _python(material, arm)
        if arm != GENERAL:
            yield _batch(material, arm)


def _poses(arm: str, number: int) -> Floats:
    return np.ascontiguousarray(ARMS[arm].forward(ARMS[arm].sample(number, seed=1)))


def _one_pose(bench: Bench) -> Group:
    bound, free = bench.material.bound[bench.arm], bench.material.free[bench.arm]
    shape = (bound.schedule.maximum, len(bound.schedule.joints))
    name = f"{bench.arm}_toolbox"
    ahead = 3.0 if bench.arm == GENERAL else 30.0 if bench.flags == RECOMMENDED else 10.0
    entries = [
        bench.own(KINSYM, bound.solver(), *shape),
        bench.own(RUN_TIME, free.solver(), *shape),
        bench.other(TOOLBOX, name, toolbox_solver(name), TOOLBOX_ROWS, shape[1]),
    ]
    goals = [Goal(entry=RUN_TIME, ratio=1.25, most=True), Goal(entry=TOOLBOX, ratio=ahead)]
    if bound.has_batch:
        entries.append(bench.own(BATCH, bound.batch(), *shape))
        if bench.arm != GENERAL and bench.flags == RECOMMENDED:
            goals.append(Goal(entry=BATCH, ratio=1.0, most=True))
    return Group(
        title=f"C, all solutions of one pose: {bench.compiler} {bench.flags}",
        arm=bench.arm,
        kind="ik",
        inputs=_poses(bench.arm, bench.number),
        entries=tuple(entries),
        goals=tuple(goals),
    )


def _line(bench: Bench, function: str) -> Group:
    joints = len(ARMS[bench.arm].rows)
    shape = (1, 16 if function == "fk" else 6 * joints)
    name = f"{bench.arm}_casadi_{function}"
    return Group(
        title=f"C, {'forward kinematics' if function == 'fk' else 'Jacobian'}: {bench.compiler} {bench.flags}",
        arm=bench.arm,
        kind=function,
        inputs=ARMS[bench.arm].sample(bench.number, seed=1),
        entries=(
            bench.own(KINSYM, bench.material.bound[bench.arm].line(function), *shape),
            bench.other(CASADI, name, casadi_line(name, joints), *shape),
        ),
        goals=(Goal(entry=CASADI, ratio=1.0),),
    )


def _python(material: Material, arm: str) -> Group:
    own = material.free[arm]
    goals = [Goal(entry=EAIK, ratio=1.5)]
    if arm != GENERAL:
        goals.append(Goal(entry=TOOLBOX, ratio=5.0, over=MODULE))
    return Group(
        title="Python, all solutions of one pose",
        arm=arm,
        kind="ik",
        inputs=_poses(arm, SOME),
        entries=(
            Entry(name=PACKAGE, arm=arm, program=Python(peer="kinsym", folder=own.package()), number=SOME),
            Entry(name=MODULE, arm=arm, program=Python(peer="kinsym", folder=own.folder), number=FEW),
            _asked(material, EAIK, arm, "eaik", SOME),
            _asked(material, "ssik", arm, "ssik", FEW),
            _asked(material, TOOLBOX, arm, "roboticstoolbox", FEW),
            _asked(material, "OPW", arm, "opw", SOME),
            _asked(material, "UR", arm, "ur", SOME),
        ),
        goals=tuple(goals),
    )


def _batch(material: Material, arm: str) -> Group:
    own, number = material.free[arm], material.crowd
    return Group(
        title=f"Python, all solutions of {number} poses",
        arm=arm,
        kind="ik",
        inputs=_poses(arm, number),
        entries=(
            Entry(name=MODULE, arm=arm, program=Python(peer="kinsym", many=True, folder=own.folder), number=number),
            Entry(name=PACKAGE, arm=arm, program=Python(peer="kinsym", many=True, folder=own.package()), number=number),
            _asked(material, EAIK, arm, "eaik", number, many=True),
        ),
        goals=(Goal(entry=EAIK, ratio=1.0),),
    )


def _asked(material: Material, name: str, arm: str, module: str, number: int, *, many: bool = False) -> Entry:
    why = material.refusals.get((name, arm))
    program = Python(peer=module, many=many) if why is None else Refusal(why=why)
    return Entry(name=name, arm=arm, program=program, number=number)
