"""The numbered inverse derivation as passages of a LaTeX document: what moves, what is named, what each step solves."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from kinsym.algebra.tree import Definition, Tree
from kinsym.emit.latex.formula import LatexPrinter, relation_sign
from kinsym.emit.latex.layout import Block, Relation, aligned
from kinsym.emit.latex.measure import width
from kinsym.emit.latex.names import Names, pose
from kinsym.emit.latex.sentences import Words, capital, escape, prose
from kinsym.emit.prose.vocabulary import all_names
from kinsym.emit.prose.wording import Loop, branch_marks, loops, origins, rule_title, shown_items
from kinsym.inverse.cut import link_letter
from kinsym.inverse.plan import Equation, Step, Window

if TYPE_CHECKING:
    from kinsym.derivation import Derivation

_WIDEST_INLINE = 220.0


@dataclass(frozen=True, kw_only=True)
class Sentence:
    """``left sign right`` inside a sentence if it is short, else set apart."""

    inline: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True, kw_only=True)
class Source:
    """Equations of a step that come from one place."""

    text: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True, kw_only=True)
class Passage:
    """One item of the derivation; ``kind`` is ``"constants"``, ``"window"``, ``"names"`` or ``"step"``."""

    kind: str
    blocks: tuple[Block, ...] = ()
    number: int = 0
    unknown: str = ""
    rule: str = ""
    why: str = ""
    branches: int = 1
    sources: tuple[Source, ...] = ()
    coefficients: tuple[Block, ...] = ()
    solution: tuple[Block, ...] = ()
    condition: Sentence | None = None
    degenerate: Sentence | None = None


class Formulas:
    """Formulas of one derivation over one table of names; ``words`` escapes what stands between them."""

    def __init__(self, derivation: Derivation, words: Words = escape) -> None:
        self.derivation = derivation
        self.words = words
        self.names = Names(all_names(derivation))
        self.formula = LatexPrinter(self.names)

    def relation(self, name: str, value: Tree) -> Relation:
        """A definition."""
        return Relation(left=self.names[name], right=self.formula(value))

    def definitions(self, items: Iterable[Definition]) -> tuple[Block, ...]:
        """Definitions one under the other."""
        return aligned(self.relation(item.name, item.value) for item in items)


class Passages(Formulas):
    """The derivation in order; definitions that follow each other stand together."""

    def _window(self, loop: Loop) -> Passage:
        """What is left of the loop closure when solved joints have moved to its other side."""
        window = loop.window
        relations = [self.relation(item.name, item.value) for item in window.definitions]
        name = pose(window.left, window.right)
        if loop.whole:
            return Passage(kind="constants", unknown=name, blocks=aligned(relations))
        letter = link_letter(self.derivation.robot)
        factors = [f"{letter}_{{{k}}}^{{-1}}" for k in loop.left]
        factors += [pose(*loop.before), *(f"{letter}_{{{k}}}^{{-1}}" for k in loop.right)]
        head = Relation(left=name, right=r" \, ".join(factors))
        return Passage(
            kind="window", unknown=name, number=window.right if loop.right else 0, blocks=aligned([head, *relations])
        )

    def _sentence(self, relation: tuple[Tree, str, Tree] | None) -> Sentence | None:
        """A condition."""
        if relation is None:
            return None
        left, sign, right = relation
        whole = Relation(left=self.formula(left), right=self.formula(right), sign=relation_sign(sign))
        inline = f"{whole.left} {whole.sign} {whole.right}"
        if width(inline) <= _WIDEST_INLINE:
            return Sentence(inline=inline, blocks=())
        return Sentence(inline="", blocks=aligned([whole]))

    def _equations(self, equations: Iterable[Equation]) -> tuple[Block, ...]:
        """Equations of the pool."""
        return aligned(Relation(left=self.formula(part.lhs), right=self.formula(part.rhs)) for part in equations)

    def step(self, step: Step, before: Step | None) -> Passage:
        """One step with all that a reader needs to repeat it."""
        solution = []
        for (name, value), mark in zip(step.solution, branch_marks(step), strict=True):
            relation = self.relation(name, value)
            note = f" \\quad (\\text{{branch }}{mark})" if mark else ""
            solution.append(Relation(left=relation.left, right=relation.right + note))
        return Passage(
            kind="step",
            number=step.number,
            unknown=self.names[step.unknown],
            rule=re.sub(r"a c \+ b s = [0e]", r"$\g<0>$", rule_title(step.rule)),
            why=capital(prose(step.why, self.names, self.words)),
            branches=step.branches,
            sources=tuple(
                Source(text=prose(origin.text, self.names, self.words), blocks=self._equations(origin.equations))
                for origin in origins(step, before)
            ),
            coefficients=self.definitions(step.coefficients),
            solution=aligned(solution),
            condition=self._sentence(step.condition),
            degenerate=self._sentence(step.degenerate),
        )

    def __iter__(self) -> Iterator[Passage]:
        pending: list[Definition] = []
        before: Step | None = None
        plan = self.derivation.plan
        if plan is None:
            return
        windows = loops(plan, self.derivation.robot)
        for item in shown_items(plan):
            if isinstance(item, Definition):
                pending.append(item)
                continue
            if pending:
                yield Passage(kind="names", blocks=self.definitions(pending))
                pending = []
            if isinstance(item, Window):
                yield self._window(windows[item.left, item.right])
            else:
                yield self.step(item, before)
                before = item
        if pending:
            yield Passage(kind="names", blocks=self.definitions(pending))
