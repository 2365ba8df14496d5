"""From the plan to a schedule: which assignment belongs to which branch depth.

A quantity lives at the depth of the deepest quantity it is made of, so what depends on the pose alone is computed once,
what depends on theta1's branch once for each of its values, and so on.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from kinsym.algebra.convert import tree_of
from kinsym.algebra.tree import ONE, ZERO, Call, Definition, Num, Prod, Quot, Sym, Tree, add, mul, symbols
from kinsym.derivation import Derivation, Nominal
from kinsym.emit.frames import jacobian_by_frames
from kinsym.emit.schedule import Assign, JointName, NominalStarts, Note, Parameter, Schedule, Solve, Statement
from kinsym.emit.singular import singular_poses
from kinsym.emit.straight import forward_line, jacobian_line
from kinsym.emit.text.formula import TextPrinter
from kinsym.inverse.assemble import constant_lengths
from kinsym.inverse.plan import Item, Plan, Step, Window
from kinsym.inverse.rules import TITLES
from kinsym.robot.summary import digest, table_lines

OFF_ZERO = Num(Fraction(1, 10**30))
"""What a link is longer by than it is: too little to change a length, enough to have a direction where it has none."""


def build_schedule(derivation: Derivation) -> Schedule:
    """Everything a generated module computes."""
    robot, chain = derivation.robot, derivation.chain
    plan = derivation.plan or derivation.general
    if plan is None:
        raise ValueError(f"{robot.name} has no inverse kinematics")
    levels = _Levels()
    if isinstance(plan, Plan):
        levels.place_all(plan)
    return Schedule(
        name=robot.name,
        title=robot.title,
        table=table_lines(robot),
        digest=digest(robot),
        joints=tuple(
            JointName(name=joint.variable, kind=joint.kind, limits=row.limits)
            for joint, row in zip(chain.joints, robot.moving, strict=True)
        ),
        parameters=tuple(Parameter(name=name, value=value) for name, value in robot.parameters.items()),
        constants=derivation.constants,
        forward=forward_line(chain),
        jacobian=jacobian_by_frames(chain) if derivation.long else jacobian_line(chain, derivation.jacobian),
        inverse=levels.statements(),
        solution=robot.variables,
        depth=levels.depth,
        maximum=plan.maximum,
        task=plan.task,
        gate=plan.gate,
        size=plan.size,
        tau=plan.tau,
        singular=singular_poses(derivation),
        inputs=tuple(name for name, value in robot.locks.items() if value is None),
        held=derivation.held,
        general=derivation.general,
        branches=derivation.branches.names,
        meanings=derivation.branches.meanings,
        nominal=_nominal(derivation.nominal, robot.variables) if derivation.nominal else None,
        lengths=constant_lengths(chain),
        nonzero=plan.nonzero,
    )


def _nominal(nominal: Nominal, variables: tuple[str, ...]) -> NominalStarts:
    """What the generated code asks of the nominal arm."""
    offsets = nominal.stand_in.offsets
    return NominalStarts(
        schedule=build_schedule(nominal.derivation),
        offsets=tuple(tree_of(offsets[name]) if name in offsets else ZERO for name in variables),
        band=nominal.stand_in.band,
        deviation=nominal.stand_in.deviation,
    )


def _second_link(step: Step) -> str | None:
    """The coefficient of a two-link triangle without which its second link has no length."""
    link = step.inputs["l2"] if step.rule == "triangle" else None
    if not isinstance(link, Sym):
        return None
    value = next((item.value for item in step.coefficients if item.name == link.name), link)
    return next(symbols(value), None) if isinstance(value, Call) else link.name


class _Levels:
    """Statements sorted by branch depth; the notes go with what they announce."""

    def __init__(self) -> None:
        self.depth = 0
        self._level: dict[str, int] = {}
        self._body: list[list[Statement]] = [[]]
        self._openers: list[list[Statement]] = []
        self._text = TextPrinter()
        self._reciprocals: dict[Tree, str] = {}

    def place_all(self, plan: Plan) -> None:
        """Put the items of a plan and the sums of angles that are joint values."""
        for item in plan.items:
            self.place(item)
        for value in plan.values:
            if value.wrapped:
                self.assign(Definition(name=value.variable, value=Call("wrap", (value.value,))))

    def place(self, item: Item) -> None:
        """Put one item of the plan where it belongs."""
        if isinstance(item, Definition):
            self.assign(item)
        elif isinstance(item, Window):
            announced: set[int] = set()
            for definition in item.definitions:
                level = self._needs(definition.value)
                if level not in announced:
                    announced.add(level)
                    self._note(level, f"T_{item.left}_{item.right}: what is known moved to the left side")
                self.assign(definition)
        else:
            self._step(item)

    def assign(self, definition: Definition) -> None:
        """One assignment at the depth of its parts."""
        level = self._needs(definition.value)
        value = self._without_division(definition.value, level)
        self._level[definition.name] = level
        self._body[level].append(Assign(level=level, name=definition.name, value=value))

    def statements(self) -> tuple[Statement, ...]:
        """All statements, level after level."""
        result: list[Statement] = []
        for level, body in enumerate(self._body):
            result += body
            if level < len(self._openers):
                result += self._openers[level]
        return tuple(result)

    def _without_division(self, value: Tree, level: int) -> Tree:
        """A quotient as a product with a reciprocal, where that is known before the branch and serves all of them."""
        match value:
            case Quot(numerator, denominator) if self._needs(denominator) < level:
                return mul(numerator, self._reciprocal(denominator))
            case Prod(factors):
                return mul(*(self._without_division(factor, level) for factor in factors))
            case _:
                return value

    def _reciprocal(self, tree: Tree) -> Tree:
        """The name of a reciprocal, which stands where what it is made of is known."""
        if tree not in self._reciprocals:
            name, level = f"reciprocal{len(self._reciprocals) + 1}", self._needs(tree)
            self._reciprocals[tree], self._level[name] = name, level
            here = Assign(level=level, name=name, value=Quot(ONE, tree))
            opener = self._openers[level]
            if {item.name for item in opener if isinstance(item, Assign)} & set(symbols(tree)):
                opener.insert(len(opener) - 1, here)
            else:
                self._body[level].append(here)
        return Sym(self._reciprocals[tree])

    def _needs(self, *trees: Tree) -> int:
        return max((self._level.get(name, 0) for tree in trees for name in symbols(tree)), default=0)

    def _note(self, level: int, text: str) -> None:
        self._body[level].append(Note(level=level, text=text))

    def _step(self, step: Step) -> None:
        equations = "; ".join(f"{self._text(e.lhs)} = {self._text(e.rhs)}" for e in step.equations)
        text = f"({step.number}) {step.unknown}: {TITLES[step.rule]}: {equations}"
        if step.branches == 1:
            level = self._needs(*step.inputs.values(), *(d.value for d in step.coefficients))
            self._note(level, text)
            for definition in step.coefficients:
                self.assign(definition)
            self._body[level].append(Solve(level=level, step=step))
            for name in step.outputs:
                self._level[name] = level
            return
        level = self.depth
        opener: list[Statement] = [Note(level=level, text=text)]
        link = _second_link(step)
        for definition in step.coefficients:
            value, known = definition.value, self._needs(definition.value)
            if definition.name == link and known:
                value = add(value, OFF_ZERO)
                note = Note(level=known, text=f"{link}: a link that has no length keeps a direction")
                (opener if known == level else self._body[known]).append(note)
            if known < level:
                self.assign(replace(definition, value=value))
                continue
            self._level[definition.name] = level
            opener.append(Assign(level=level, name=definition.name, value=self._without_division(value, level)))
        self._openers.append([*opener, Solve(level=level, step=step)])
        self.depth += 1
        self._body.append([])
        for name in step.outputs:
            self._level[name] = self.depth
