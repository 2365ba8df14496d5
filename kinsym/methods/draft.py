"""A derivation while it is written: whatever is stated is proved at once, and numbered.

A name that the robot's table uses already is not taken for something else: ``fresh`` then adds an underscore.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterable, Sequence

from kinsym.algebra.field import PRIME
from kinsym.algebra.nested import nested
from kinsym.algebra.ring import POSE_ENTRIES, Poly, Vector
from kinsym.algebra.tree import Sym, Tree
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.forward import pose_columns
from kinsym.methods.document import Equation, Matrix, MethodDerivation, Passage, Product, Sentence, Side, Solution
from kinsym.methods.proof import ProofFailed, Witness

POINTS = 2
"""Random points at which everything is proved; a false polynomial identity passes one with probability 1e-17."""

POINTS_FOR_ROOTS = 24
"""More points where a formula has roots: those at which one is not in the field are given up."""


class Draft:
    """Sentences and equations about one chain, in the order in which they are stated."""

    def __init__(self, chain: Chain, *, method: str, title: str, points: int = POINTS) -> None:
        self.chain, self.ring = chain, chain.ring
        self._method, self._title = method, title
        self._passages: list[Passage] = []
        self._solutions: list[Solution] = []
        self._conditions: list[Equation] = []
        self._names: set[str] = set()
        self._taken = {*chain.robot.parameters, *chain.robot.variables, *(g.name for g in chain.ring.generators)}
        generator = random.Random("methods")
        self.witnesses = tuple(_witness(chain, generator) for _ in range(points))

    def done(self) -> MethodDerivation:
        """What has been stated."""
        return MethodDerivation(
            robot=self.chain.robot.name,
            method=self._method,
            title=self._title,
            passages=tuple(self._passages),
            solutions=tuple(self._solutions),
            conditions=tuple(self._conditions),
        )

    @property
    def solutions(self) -> tuple[Solution, ...]:
        """The unknowns solved so far."""
        return tuple(self._solutions)

    def fresh(self, name: str) -> str:
        """A name for a new quantity: the one wanted, or the next that neither table nor derivation uses."""
        while name in self._taken:
            name += "_"
        self._taken.add(name)
        return name

    def has_stated(self, left: Side, right: Side) -> bool:
        """Whether an equation has been printed already."""
        return any(
            isinstance(passage, Equation) and (passage.left, passage.right) == (left, right)
            for passage in self._passages
        )

    def say(self, text: str) -> None:
        """A sentence, which may refer to equations already stated as ``{name}``."""
        self._passages.append(Sentence(text))

    def tree(self, poly: Poly) -> Tree:
        """A polynomial of the chain's ring, nested by joint."""
        return nested(self.ring, poly)

    def column(self, vector: Iterable[Poly]) -> Matrix:
        """A column of polynomials as it is printed."""
        return Matrix(tuple((self.tree(entry),) for entry in vector))

    def state(self, name: str, left: Side, right: Side) -> Equation:
        """An equation that holds for the robot; proved."""
        self.check(name, left, right)
        return self._equation(name, left, right, "=")

    def check(self, name: str, left: Side, right: Side) -> None:
        """Prove an equation without printing it."""
        if not all(witness.holds(left, right) for witness in self.witnesses):
            raise ProofFailed(f"{self.chain.robot.name}, {self._method}: {name} does not hold: {left} = {right}")

    def define(self, symbol: str, value: Tree, *, name: str = "") -> Sym:
        """A new quantity by its formula, roots that it takes being the positive ones.

        The field knows no signs: either root will do, and a point at which there is none is given up.
        """
        kept = []
        for witness in self.witnesses:
            values = witness.values(value)
            if values:
                witness.numbers[symbol] = min(values)
                kept.append(witness)
        if not kept:
            raise ProofFailed(f"{symbol} has no value at any point: {value}")
        self.witnesses = tuple(kept)
        self._equation(name or symbol, Sym(symbol), value, "=")
        return Sym(symbol)

    def choose(self, symbol: str, value: Tree, fits: Callable[[Witness], bool], *, name: str) -> None:
        """A quantity whose formula leaves a sign open: at each point the value that fits the joints."""
        for witness in self.witnesses:
            for candidate in sorted(witness.values(value)):
                witness.numbers[symbol] = candidate
                if fits(witness):
                    break
            else:
                raise ProofFailed(f"no value of {symbol} fits the joints: {value}")
        self._equation(name, Sym(symbol), value, "=")

    def define_angle(self, symbol: str, value: Tree) -> Sym:
        """A new angle by its formula."""
        for witness in self.witnesses:
            directions = witness.directions(value)
            if len(directions) != 1:
                raise ProofFailed(f"{symbol} has {len(directions)} values where one is expected")
            witness.angles[symbol] = next(iter(directions))
        self._equation(symbol, Sym(symbol), value, "=")
        return Sym(symbol)

    def give(self, symbol: str, poly: Poly) -> Sym:
        """A quantity that is measured, such as an entry of the pose, under a name; nothing is printed."""
        for witness in self.witnesses:
            witness.numbers[symbol] = self.ring.evaluate(poly, witness.numbers)
        return Sym(symbol)

    def give_value(self, symbol: str, value: Tree) -> Sym:
        """The same for the value of a formula."""
        for witness in self.witnesses:
            witness.numbers[symbol] = witness.value(value)
        return Sym(symbol)

    def name_matrix(self, symbol: str, side: Matrix | Product) -> None:
        """A matrix under a name; nothing is printed."""
        for witness in self.witnesses:
            witness.matrices[symbol] = witness.rows(side)

    def require(self, name: str, left: Tree, sign: str, right: Tree) -> Equation:
        """A condition: what must hold for a real, or a unique, solution."""
        equation = self._equation(name, left, right, sign)
        self._conditions.append(equation)
        return equation

    def conclude(self, name: str, left: Tree, sign: str, right: Tree) -> Equation:
        """An inequality that is a result, not something that must hold for one."""
        return self._equation(name, left, right, sign)

    def solve(
        self, unknown: str, right: Tree, *, branches: int, conditions: Sequence[Equation] = (), also: Tree | None = None
    ) -> None:
        """An unknown by its formula, and by another if it has two; proved to have the joint's value among its own."""
        equations = [self.state(unknown, Sym(unknown), right)]
        if also is not None:
            equations.append(self.state(f"{unknown}.other", Sym(unknown), also))
        self._solutions.append(
            Solution(unknown=unknown, equations=tuple(equations), branches=branches, conditions=tuple(conditions))
        )

    def _equation(self, name: str, left: Side, right: Side, sign: str) -> Equation:
        if name in self._names:
            raise ValueError(f"two equations are called {name}")
        self._names.add(name)
        equation = Equation(number=len(self._names), name=name, left=left, right=right, sign=sign)
        self._passages.append(equation)
        return equation


def _witness(chain: Chain, generator: random.Random) -> Witness:
    ring = chain.ring
    numbers = chain.sample(generator)
    columns: Sequence[Vector] = pose_columns(chain)
    entries = [ring.evaluate(entry, numbers) for column in columns for entry in column]
    numbers.update(zip(POSE_ENTRIES, entries, strict=True))
    angles = {
        angle.name: (numbers[angle.cosine] % PRIME, numbers[angle.sine] % PRIME) for angle in chain.angles.values()
    }
    return Witness(numbers, angles)
