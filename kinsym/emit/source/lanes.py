"""The statements of the inverse kinematics as loops over lanes.

A name is a constant before all loops, a local of one loop, or, where a deeper loop reads it, an array with a place for
every lane. The last loop computes both roots of the last step that branches: what symmetry tells of the second is
not computed again.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from kinsym.algebra.tree import Call, Sym, Tree, children, negated, replaced, symbols
from kinsym.emit.ending import CHANGES, ONE_TURN, summands
from kinsym.emit.printer import Printer
from kinsym.emit.schedule import Assign, Note, Schedule, Solve, Statement
from kinsym.emit.source.kernels import KERNELS
from kinsym.emit.source.needs import ENTRIES, InverseNeeds
from kinsym.emit.symmetry import Sign, sign, signs
from kinsym.inverse.plan import Definition, Step

#: Functions whose values are angles in (-pi, pi].
_IN_A_TURN = frozenset({"atan2", "half_turn", "opposite", "unwound", "wrap"})


@dataclass(frozen=True, kw_only=True)
class Line:
    """A line of C, or of a comment."""

    text: str
    comment: bool = False


@dataclass(frozen=True, kw_only=True)
class Constants:
    """What is computed before a loop: parameters that are read, by name, and definitions."""

    parameters: tuple[str, ...]
    definitions: tuple[Definition, ...]


@dataclass(kw_only=True)
class Loop:
    """One loop over the lanes.

    loads     what it reads from arrays, as declarations: ``"c1 = c1_lanes[i1][k]"``.
    body      its lines, in order.
    arrays    the arrays that it fills: ``"c3_lanes[2][LANES]"``.
    stores    the assignments that fill them.
    marks     what it adds to the mark of the pose: ``"real1 * mark3"``.
    """

    loads: list[str] = field(default_factory=list)
    body: list[Line] = field(default_factory=list)
    arrays: list[str] = field(default_factory=list)
    stores: list[str] = field(default_factory=list)
    marks: list[str] = field(default_factory=list)


def constants_of(schedule: Schedule, definitions: Iterable[Definition], names: Iterable[str]) -> Constants:
    """The definitions, and the parameters, that ``names`` depend on."""
    wanted, kept = set(names), []
    for item in reversed(list(definitions)):
        if item.name in wanted:
            wanted.update(symbols(item.value))
            kept.append(item)
    return Constants(
        parameters=tuple(parameter.name for parameter in schedule.parameters if parameter.name in wanted),
        definitions=tuple(reversed(kept)),
    )


def _functions(tree: Tree) -> Iterator[str]:
    if isinstance(tree, Call):
        yield tree.function
    for child in children(tree):
        yield from _functions(child)


def arrays_of_poses(given: tuple[Definition, ...]) -> dict[str, str]:
    """Where a lane finds what is given with its pose."""
    arrays = {name: f"block->M[{4 * row + column}][k]" for name, (row, column) in ENTRIES.items()}
    arrays |= {item.name: f"block->given[{place}][k]" for place, item in enumerate(given)}
    return arrays | {"tau": "block->tau[k]"}


def _values(statement: Statement) -> tuple[Tree, ...]:
    """What a statement reads."""
    match statement:
        case Assign(value=value):
            return (value,)
        case Solve(step=step):
            return tuple(step.inputs.values())
    return ()


def _change(value: Tree, known: Mapping[str, Sign]) -> str | None:
    """What becomes of an angle at the second root; None if that is not known, or ``value`` is no angle."""
    if not isinstance(value, Call) or value.function != "atan2":
        return None
    sine, cosine = (sign(part, known) for part in value.arguments)
    return CHANGES.get((sine, cosine))


class Loops:
    """Fills the loops, the outermost first."""

    def __init__(
        self, schedule: Schedule, needs: InverseNeeds, printer: Printer, given: tuple[Definition, ...]
    ) -> None:
        self.loops = tuple(Loop() for _ in range(max(schedule.depth, 1)))
        self.functions: set[str] = set()
        self._schedule, self._needs, self._printer = schedule, needs, printer
        self._fixed = [item for item in needs.constants if item not in given]
        self._constant = {*(item.name for item in schedule.parameters), *(item.name for item in self._fixed)}
        self._read: set[str] = set()
        self._local: list[set[str]] = [set() for _ in self.loops]
        self._homes: dict[str, int] = {}
        self._arrays = arrays_of_poses(given)
        self._signs = signs(needs.statements, schedule.depth) if schedule.depth else {}
        self._others: dict[str, Tree] = {}
        self._angles: set[str] = set()

    def fill(self) -> None:
        """Every statement in its loop."""
        for number, loop in enumerate(self.loops):
            array = "block->real[k]" if number == 0 else f"real{number}_lanes[k]"
            loop.loads.append(f"real{number} = {array}")
        statements = [plain for statement in self._needs.statements for plain in self._plain(statement)]
        if any("size" in symbols(value) for statement in statements for value in _values(statement)):
            self._put(Assign(level=0, name="size", value=self._schedule.size))
        for statement in statements:
            self._put(statement)

    def rows(self) -> tuple[tuple[str, ...], ...]:
        """The joint values of every root of the last step that branches."""
        names = self._schedule.solution
        self._use(map(Sym, names), len(self.loops) - 1)
        if self._schedule.depth == 0:
            return (names,)
        return (names, tuple(self._printer(self._others.get(name, Sym(name))) for name in names))

    def constants(self) -> Constants:
        """What the loops read of what depends on parameters alone."""
        return constants_of(self._schedule, self._fixed, self._read)

    def _plain(self, statement: Statement) -> Iterator[Statement]:
        """A statement without a kernel that does nothing but assign."""
        if not isinstance(statement, Solve) or not KERNELS[statement.step.rule].plain:
            yield statement
            return
        step = statement.step
        for name, given in zip(step.outputs, KERNELS[step.rule].inputs, strict=True):
            if name in self._needs.names:
                yield Assign(level=statement.level, name=name, value=step.inputs[given])

    def _put(self, statement: Statement) -> None:
        number = min(statement.level, len(self.loops) - 1)
        if isinstance(statement, Note):
            self.loops[number].body.append(Line(text=statement.text, comment=True))
        elif isinstance(statement, Assign):
            if self._constant.issuperset(symbols(statement.value)):
                self._fixed.append(Definition(name=statement.name, value=statement.value))
                self._constant.add(statement.name)
                return
            self._assign(statement, number)
        elif statement.step.branches > 1:
            self._fork(statement.step, number)
        else:
            self._solve(statement.step, statement.level, number)

    def _assign(self, statement: Assign, number: int) -> None:
        self._define(statement.name, statement.value, number)
        if self._is_last(statement.level):
            self._assign_other(statement.name, statement.value, number)

    def _define(self, name: str, value: Tree, number: int) -> None:
        count = summands(value, self._angles)
        if count is not None and count <= ONE_TURN:
            value = Call("unwound", children(value))
        functions = set(_functions(value))
        self.functions |= functions
        if functions & _IN_A_TURN:
            self._angles.add(name)
        self._use([value], number)
        self._code(number, f"const double {name} = {self._printer(value)};")
        self._own(name, number)

    def _assign_other(self, name: str, value: Tree, number: int) -> None:
        """The value at the second root, computed only where symmetry does not tell it."""
        change = _change(value, self._signs)
        if self._signs[name] is None and change:
            other: Tree = Sym(name)
            for function in ("opposite", "half_turn") if change == "supplement" else (change,):
                other = Call(function, (other,))
            self._define(f"{name}_other", other, number)
        elif self._signs[name] is None:
            self._define(f"{name}_other", replaced(value, self._others), number)
        self._tell_other(name)

    def _tell_other(self, name: str) -> None:
        """What a name stands for at the second root."""
        if self._signs[name] is None:
            self._others[name] = Sym(f"{name}_other")
        elif self._signs[name] == -1:
            self._others[name] = negated(Sym(name))

    def _solve(self, step: Step, level: int, number: int) -> None:
        """A kernel with one root."""
        self._call(step, step.inputs, "", level, number)
        if self._is_last(level):
            if None in (self._signs[name] for name in step.outputs):
                changed = {name: replaced(value, self._others) for name, value in step.inputs.items()}
                self._call(step, changed, "_other", level, number)
            for name in step.outputs:
                self._tell_other(name)

    def _call(self, step: Step, inputs: dict[str, Tree], suffix: str, level: int, number: int) -> None:
        names = [f"{name}{suffix}" for name in step.outputs]
        mark = f"mark{step.number}{suffix}"
        arguments = [*self._printed(step, inputs, number), *(f"&{name}" for name in (*names, mark))]
        self._code(number, f"double {', '.join([*names, mark])};")
        self._code(number, f"lane_{step.rule}({', '.join(arguments)});")
        self.loops[number].marks.append(f"real{level} * {mark}")
        for name in names:
            self._own(name, number)

    def _fork(self, step: Step, number: int) -> None:
        """A kernel with two roots: arrays of both for the next loop, or both at once in the last one."""
        kernel, mark, real = KERNELS[step.rule], f"mark{step.number}", f"real{number + 1}"
        pairs = [(name, rooted) for name, (_, rooted) in zip(step.outputs, kernel.outputs, strict=True)]
        results = [f"{name}_roots[2]" if rooted else name for name, rooted in pairs]
        filled = [f"{name}_roots" if rooted else f"&{name}" for name, rooted in pairs]
        arguments = [*self._printed(step, step.inputs, number), *filled, f"&{mark}"]
        self._code(number, f"double {', '.join([*results, mark])};")
        self._code(number, f"const double {real} = real{number} * lane_{step.rule}({', '.join(arguments)});")
        self.loops[number].marks.append(f"real{number} * {mark}")
        used = [(name, rooted) for name, rooted in pairs if name in self._needs.names]
        if number + 1 < self._schedule.depth:
            self._keep(real, number)
            for name, rooted in used:
                self._own(name, number)
                if rooted:
                    self._keep_roots(name, number)
            return
        for name, rooted in used:
            self._own(name, number)
            if rooted:
                self._code(number, f"const double {name} = {name}_roots[0];")
            if self._signs[name] is None:
                self._code(number, f"const double {name}_other = {name}_roots[1];")
                self._own(f"{name}_other", number)
            self._tell_other(name)

    def _printed(self, step: Step, inputs: dict[str, Tree], number: int) -> list[str]:
        self._use(inputs.values(), number)
        return [self._printer(inputs[name]) for name in KERNELS[step.rule].inputs]

    def _is_last(self, level: int) -> bool:
        """Whether a statement stands behind the last step that branches."""
        return 0 < level == self._schedule.depth

    def _code(self, number: int, text: str) -> None:
        self.loops[number].body.append(Line(text=text))

    def _own(self, name: str, number: int) -> None:
        self._local[number].add(name)
        self._homes[name] = number

    def _keep(self, name: str, number: int) -> None:
        """An array of a local for deeper loops."""
        self.loops[number].arrays.append(f"{name}_lanes[LANES]")
        self.loops[number].stores.append(f"{name}_lanes[k] = {name};")
        self._arrays[name] = f"{name}_lanes[k]"

    def _keep_roots(self, name: str, number: int) -> None:
        """Arrays of both roots, of which a deeper loop reads one."""
        self.loops[number].arrays.append(f"{name}_lanes[2][LANES]")
        self.loops[number].stores += [f"{name}_lanes[{root}][k] = {name}_roots[{root}];" for root in (0, 1)]
        self._arrays[name] = f"{name}_lanes[i{number + 1}][k]"

    def _use(self, values: Iterable[Tree], number: int) -> None:
        """Makes sure that a loop has the names that values are made of."""
        for name in (name for value in values for name in symbols(value)):
            if name in self._constant:
                self._read.add(name)
            elif name not in self._local[number]:
                if name not in self._arrays:
                    self._keep(name, self._homes[name])
                self.loops[number].loads.append(f"{name} = {self._arrays[name]}")
                self._local[number].add(name)
