"""The derivation of one unknown for a student, step by step: what is known, which equation, which rule, why, what if.

The names and formulas are those of :mod:`kinsym.emit.text.equations`; only the steps that the unknown needs are told.
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from kinsym.algebra.tree import Definition
from kinsym.emit.prose.lessons import LESSONS, comparison
from kinsym.emit.prose.singular import family_conditions, follows, listed
from kinsym.emit.prose.wording import (
    TASKS,
    branch_marks,
    branch_rows,
    branchings,
    counted,
    found_by_sum,
    loops,
    one_line,
    origins,
    rule_title,
)
from kinsym.emit.text.equations import heading, relation, window
from kinsym.emit.text.given import assumed, given, held
from kinsym.emit.text.page import Page
from kinsym.inverse.choices import Choice, choices
from kinsym.inverse.cut import link_letter
from kinsym.inverse.needed import needed
from kinsym.inverse.plan import Plan, Step, Window
from kinsym.inverse.state import span

if TYPE_CHECKING:
    from kinsym.derivation import Derivation

#: So many candidates are listed beside the one that was taken.
_LISTED = 5


def explanation(derivation: Derivation, plan: Plan, unknowns: Sequence[str], page: Page) -> str:
    """The walk through the steps that the unknowns need; every one is of ``solvable(plan)``."""
    parts = [title(derivation, unknowns), _opening(derivation, plan, page)]
    wanted = {id(step) for name in unknowns for step in needed(plan, name) if isinstance(step, Step)}
    parts.append(_way(plan, wanted, page))
    walk = _Walk(derivation, plan, page)
    if len(unknowns) == 1:
        parts += walk.through(needed(plan, unknowns[0]))
    else:
        parts += walk.through(plan.items)
    parts += _sums(plan, unknowns, page)
    return "\n\n".join(parts) + "\n"


def title(derivation: Derivation, unknowns: Sequence[str]) -> str:
    """What is found, and of which robot."""
    robot = derivation.robot
    what = unknowns[0] if len(unknowns) == 1 else "the inverse kinematics"
    return f"{heading(f'How {what} is found', '=')}\n  {one_line(robot.title) or robot.name}"


def _opening(derivation: Derivation, plan: Plan, page: Page) -> str:
    robot = derivation.robot
    letter = link_letter(robot)
    first, last = span(robot, plan.task)
    links = " ".join(f"{letter}{number}" for number in range(first + 1, last + 1))
    lines = [
        page.prose(f"Given: {TASKS[plan.task]}, as entries of the pose T = [u v w p]."),
        *given(robot, page),
        *held(derivation, page),
        *assumed(plan, page),
        "",
        page.prose(
            f"The links carry the end effector to the pose. This is the loop closure T_{first}_{last} = {links}."
        ),
        page.prose(
            f"Links that are moved to the other side ({letter}{first + 1}^-1 T_{first}_{last} = ...) leave equations"
            " with fewer unknowns. Every row and column of every such equation is looked at, and the one that costs"
            " least is solved first: few values, nothing that can vanish, short."
        ),
    ]
    return "\n".join(lines)


def _way(plan: Plan, wanted: set[int], page: Page) -> str:
    steps = [step for step in plan.steps if id(step) in wanted]
    order = ", then ".join(step.unknown for step in steps)
    left = [step.unknown for step in plan.steps if id(step) not in wanted]
    text = f"Way: {order}."
    if left:
        text += f" The other {counted(len(left), 'step')} ({', '.join(left)}) are not needed for it."
    return page.prose(text)


def _sums(plan: Plan, unknowns: Sequence[str], page: Page) -> Iterator[str]:
    values = [value for value in plan.values if value.variable in unknowns and found_by_sum(value)]
    if values:
        lines = (page.equation(value.variable, page.formula(value.value)) for value in values)
        yield "\n".join([heading("At last"), *lines, page.prose("taken into (-pi, pi].")])


class _Walk:
    """The sections of one plan."""

    def __init__(self, derivation: Derivation, plan: Plan, page: Page) -> None:
        self._derivation, self._plan, self._page = derivation, plan, page
        self._windows = loops(plan, derivation.robot)
        self._choices = choices(derivation.solved, plan)
        self._letter = link_letter(derivation.robot)

    def through(self, items: Sequence[Definition | Window | Step]) -> Iterator[str]:
        """A section for each step, with the poses and the names that come before it."""
        waiting: list[str] = []
        before: Step | None = None
        for item in items:
            match item:
                case Window():
                    loop = self._windows[item.left, item.right]
                    waiting.append(window(loop, self._letter, self._page, entries=item.definitions))
                case Step():
                    yield self._section(item, before, waiting)
                    waiting, before = [], item
                case Definition() if not self._said(item):
                    waiting.append(self._page.equation(item.name, item.value, indent=4))

    def _said(self, item: Definition) -> bool:
        """Whether the solution of a step has said it already."""
        return any((item.name, item.value) in step.solution for step in self._plan.steps) or item.name in {
            step.unknown for step in self._plan.steps
        }

    def _section(self, step: Step, before: Step | None, waiting: list[str]) -> str:
        page = self._page
        parts = [f"{heading(f'Step {step.number}: {step.unknown}')}\n{self._known(step)}"]
        if waiting:
            parts.append("\n".join([page.prose("From what is known"), *waiting]))
        parts += [
            "\n".join(self._equations(step, before)),
            "\n".join(self._rule(step)),
            "\n".join(self._solution(step)),
        ]
        parts += ["\n".join(lines) for lines in (list(self._branches(step)), list(self._special(step))) if lines]
        return "\n\n".join(parts)

    def _known(self, step: Step) -> str:
        found = [other.unknown for other in self._plan.steps if other.number < step.number]
        known = listed(["the pose", *found])
        left = [other.unknown for other in self._plan.steps if other.number > step.number]
        text = f"Known: {known}. Wanted: {step.unknown}."
        return self._page.prose(f"{text} Open after it: {listed(left)}." if left else text)

    def _equations(self, step: Step, before: Step | None) -> Iterator[str]:
        yield self._page.prose("Equations" if len(step.equations) > 1 else "Equation")
        for origin in origins(step, before):
            yield self._page.prose(f"{origin.text}{':' if origin.equations else ''}", indent=4)
            for part in origin.equations:
                yield self._page.equation(self._page.formula(part.lhs), part.rhs, indent=6)
        if step.why:
            yield self._page.prose(f"Why this: {step.why}.", indent=4)

    def _rule(self, step: Step) -> Iterator[str]:
        yield self._page.prose(f"Rule: {rule_title(step.rule)}")
        yield self._page.prose(LESSONS[step.rule].how, indent=4)
        found = self._choices.get(step.number)
        if found is None:
            yield self._page.prose("It comes with the step before it and was not chosen by itself.", indent=4)
            return
        yield self._page.prose(f"Why this rule: {comparison(found)}", indent=4)
        if len(found) > 1:
            yield from self._candidates(found)

    def _candidates(self, found: tuple[Choice, ...]) -> Iterator[str]:
        """The table of what could be solved at this moment."""
        taken = next(number for number, choice in enumerate(found) if choice.taken)
        shown = [choice for number, choice in enumerate(found) if number <= max(taken, _LISTED)]
        width = max(len("unknown"), *(len(choice.unknown) for choice in shown))
        yield f"      {'':<5}  cost  {'unknown':<{width}}  values  rule"
        for choice in shown:
            mark = "taken" if choice.taken else ""
            head = f"      {mark:<5}  {choice.cost:>4}  {choice.unknown:<{width}}  {choice.branches:>6}  "
            title = textwrap.wrap(rule_title(choice.rule), self._page.width - len(head))
            yield head + title[0]
            yield from (" " * len(head) + line for line in title[1:])
        if len(found) > len(shown):
            yield self._page.prose(f"and {len(found) - len(shown)} that cost more", indent=13)

    def _solution(self, step: Step) -> Iterator[str]:
        page = self._page
        yield page.prose("Solution")
        for item in step.coefficients:
            yield page.equation(item.name, item.value, indent=4)
        for (name, value), mark in zip(step.solution, branch_marks(step), strict=True):
            yield page.equation(name, value, indent=4) + (f"    (branch {mark})" if mark else "")

    def _branches(self, step: Step) -> Iterator[str]:
        forks = [fork.number for fork in branchings(self._plan)]
        if step.number not in forks:
            return
        place = forks.index(step.number)
        branches = self._derivation.branches
        names = [name.split(", ") for name in branches.names]
        yield self._page.prose(f"Branches: {step.branches}")
        rows = [marks[place] for _, marks in branch_rows(self._plan)]
        for mark in dict.fromkeys(rows):
            own = [words for words, sign in zip(names, rows, strict=True) if sign == mark]
            yield self._page.prose(f"{mark}: {_named(own, place)}", indent=4)
        told = {words[place] for words in names}
        for meaning in branches.meanings:
            if any(meaning.startswith(word) for word in told):
                yield self._page.prose(f"{meaning}.", indent=4)

    def _special(self, step: Step) -> Iterator[str]:
        page = self._page
        families = [one for one in self._derivation.families if one.free == step.unknown]
        families.sort(key=lambda one: one.conditions != (step.degenerate,))
        if step.condition is None and step.degenerate is None and not families:
            return
        yield page.prose("Special cases")
        if step.condition is not None:
            yield page.prose(f"real if {relation(step.condition, page)}", indent=4)
            yield page.prose(
                "Beyond that the pose is out of reach. On the border the two values are one, and the arm is singular.",
                indent=6,
            )
        if step.degenerate is not None:
            yield page.prose(f"free if {relation(step.degenerate, page)}", indent=4)
            yield page.prose(
                f"Every value of {step.unknown} will do there, and the code takes the one of the reference joints.",
                indent=6,
            )
        for family in families:
            if family.conditions != (step.degenerate,):
                yield page.prose(f"{family_conditions(family, page.formula)}:", indent=4)
            yield page.prose(f"{follows(family, page.formula, str)}.", indent=6)


def _named(names: Sequence[Sequence[str]], place: int) -> str:
    """What branches that share a sign are called at one place of their names, with what it depends on.

    >>> _named([["shoulder right", "elbow up"], ["shoulder left", "elbow down"]], 1)
    'elbow up (shoulder right) or elbow down (shoulder left)'
    """
    own = tuple(dict.fromkeys(words[place] for words in names))
    for other in range(place):
        beside = [tuple(dict.fromkeys(words[other] for words in names if words[place] == word)) for word in own]
        if len(own) > 1 and all(len(words) == 1 for words in beside):
            return " or ".join(f"{word} ({words[0]})" for word, words in zip(own, beside, strict=True))
    return " or ".join(own)
