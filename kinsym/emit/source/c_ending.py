"""The end of an inverse kinematics in C: pairs are stored in the branches, solutions are put together from angles."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from math import prod
from typing import Any

from kinsym.algebra.tree import Call, Sym, Tree, children, negated, replaced
from kinsym.emit.ending import HEADING, ONE_TURN, Angle, Ending, ending, summands
from kinsym.emit.printer import Printer
from kinsym.emit.schedule import Assign, Schedule
from kinsym.emit.source.kernels import KERNELS
from kinsym.emit.source.needs import InverseNeeds, functions_used
from kinsym.emit.source.statements import Assignment, KernelCall, View

#: Bits of a mark, and how many marks an int has room for.
_BITS, _MOST = 4, 7


@dataclass(frozen=True, kw_only=True)
class PairStore:
    """A pair that is stored at a place of the arrays, under a condition if first roots alone do it."""

    kind: str = "pair"
    level: int
    place: str
    sine: str
    cosine: str
    condition: str


def c_ending(schedule: Schedule, needs: InverseNeeds, statements: tuple[View, ...], printer: Printer) -> dict[str, Any]:
    """What the templates print of branches and of their end."""
    end = ending(schedule, needs.statements)
    statements = tuple(_headed(view, end) for view in statements)
    calls = [view for view in statements if isinstance(view, KernelCall)]
    word = "int" if len(calls) <= _MOST else "long long"
    sums = {item.name: _unwound(item.value, end) for item in end.sums}
    twins = _twins(schedule, end, sums)
    taken = [(angle.name, _taken(schedule, end, angle)) for angle in end.angles]
    made = {"atan2"} if end.angles else set()
    made |= {name for tree in (*sums.values(), *twins) for name in _functions(tree)}
    made |= {name for _, text in taken for name in ("half_turn", "opposite") if f"{name}(" in text}
    return {
        "end": end,
        "kernels": [rule for rule in (*KERNELS, HEADING) if any(call.rule == rule for call in calls)],
        "places": ", ".join(f"{angle.name}_at = {angle.start}" for angle in end.angles),
        "statements": _views(schedule, end, statements, printer),
        "loops": schedule.depth - end.mirrored,
        "arms": schedule.maximum // (2 if end.mirrored else 1),
        "word": word,
        "packed": " | ".join(_shifted(call.mark, place, word) for place, call in enumerate(calls)),
        "unpacked": [(call.mark, _unpacked(place, word)) for place, call in enumerate(calls)],
        "twin_free": next(
            (_shifted("IS_FREE", k, word) for k, c in enumerate(calls) if c.branch == schedule.depth), ""
        ),
        "stored": [item.name for item in end.lengths if min(item.level, schedule.depth - end.mirrored) > 0],
        "branch": _number(schedule, schedule.depth - end.mirrored),
        "digits": _digits(schedule, end, taken),
        "taken": [*taken, *((name, printer(tree)) for name, tree in sums.items())],
        "twins": [printer(tree) for tree in twins],
        "functions": _all_functions(schedule, needs, end, made),
    }


def _headed(view: View, end: Ending) -> View:
    """The statement; a direction that an angle alone reads keeps its length, which saves a root and a division."""
    if isinstance(view, KernelCall) and end.headings.issuperset(output.name for output in view.outputs):
        return replace(view, rule=HEADING)
    return view


def _views(schedule: Schedule, end: Ending, statements: tuple[View, ...], printer: Printer) -> list[View | PairStore]:
    """The statements of the branches: a pair is stored where its angle was, what is made of angles is left out."""
    angles = {angle.name: angle for angle in end.angles}
    views: list[View | PairStore] = []
    for view in statements:
        if not isinstance(view, Assignment) or view.name not in end.names:
            views.append(view)
        elif view.name in angles:
            angle = angles[view.name]
            views.append(
                PairStore(
                    level=view.level,
                    place=_place(schedule, angle),
                    sine=printer(angle.sine),
                    cosine=printer(angle.cosine),
                    condition=" && ".join(f"i{level} == 0" for level, _ in _looped(schedule, end, angle)),
                )
            )
    return views


def _shifted(mark: str, place: int, word: str) -> str:
    """A mark at its place among those of a solution."""
    whole = mark if word == "int" else f"({word}){mark}"
    return f"{whole} << {_BITS * place}" if place else whole


def _unpacked(place: int, word: str) -> str:
    """The mark at a place."""
    text = f"found[k] >> {_BITS * place} & {(1 << _BITS) - 1}" if place else f"found[k] & {(1 << _BITS) - 1}"
    return text if word == "int" else f"(int)({text})"


def _looped(schedule: Schedule, end: Ending, angle: Angle) -> list[tuple[int, str]]:
    """The changes of an angle between roots that are looped over."""
    return [item for item in angle.changes if not (end.mirrored and item[0] == schedule.depth)]


def _place(schedule: Schedule, angle: Angle) -> str:
    """The place of an angle's value among all angles."""
    text = f"{angle.name}_at"
    for place, level in enumerate(angle.levels):
        stride = prod(schedule.widths[later - 1] for later in angle.levels[place + 1 :])
        text += f" + {stride} * i{level}" if stride > 1 else f" + i{level}"
    return text


def _taken(schedule: Schedule, end: Ending, angle: Angle) -> str:
    """The value of an angle in the branch at hand."""
    text = f"angle[{_place(schedule, angle)}]"
    for level, change in _looped(schedule, end, angle):
        called = f"half_turn(opposite({text}))" if change == "supplement" else f"{change}({text})"
        text = f"(i{level} ? {called} : {text})" if text.startswith("(") else f"i{level} ? {called} : {text}"
    return text


def _number(schedule: Schedule, loops: int) -> str:
    """The number of a branch, by its roots."""
    strides = [prod(schedule.widths[level:]) for level in range(1, loops + 1)]
    terms = [f"{stride} * i{level}" if stride > 1 else f"i{level}" for level, stride in enumerate(strides, 1)]
    return f"(unsigned)({' + '.join(terms)})" if terms else "0u"


def _digits(schedule: Schedule, end: Ending, taken: list[tuple[str, str]]) -> list[tuple[str, str]]:
    """The roots that make a branch, by its number."""
    digits = []
    for level in range(1, schedule.depth - end.mirrored + 1):
        stride = prod(schedule.widths[level:])
        text = "branch" if stride == 1 else f"branch / {stride}"
        text += "" if level == 1 else f" % {schedule.widths[level - 1]}"
        if any(re.search(rf"\bi{level}\b", value) for _, value in taken):
            digits.append((f"i{level}", text))
    return digits


def _unwound(tree: Tree, end: Ending) -> Tree:
    """A wrapped sum of few angles is at most one turn away."""
    count = summands(tree, end.names)
    if count is None or count > ONE_TURN:
        return tree
    return Call("unwound", children(tree))


def _twins(schedule: Schedule, end: Ending, sums: Mapping[str, Tree]) -> list[Tree]:
    """The joint values of the mirror image of a solution."""
    if not end.mirrored:
        return []
    images: dict[str, Tree] = {item.name: negated(Sym(item.name)) for item in end.lengths if item.sign == -1}
    for angle in end.angles:
        for level, change in angle.changes:
            if level == schedule.depth:
                image: Tree = Sym(angle.name)
                for function in ("opposite", "half_turn") if change == "supplement" else (change,):
                    image = Call(function, (image,))
                images[angle.name] = image
    for name, tree in sums.items():
        image = replaced(tree, images)
        if image != tree:
            images[name] = image
    return [images.get(name, Sym(name)) for name in schedule.solution]


def _functions(tree: Tree) -> Iterator[str]:
    if isinstance(tree, Call):
        yield tree.function
    for child in children(tree):
        yield from _functions(child)


def _all_functions(schedule: Schedule, needs: InverseNeeds, end: Ending, made: set[str]) -> set[str]:
    """The functions that the source calls; sums are not wrapped where they are printed as something else."""
    other = [item for item in needs.statements if not (isinstance(item, Assign) and item.name in end.names)]
    wrapped = needs.marked or any("wrap" in _functions(item.value) for item in other if isinstance(item, Assign))
    used = set(functions_used(schedule)) | made
    return used if wrapped or "wrap" in made else used - {"wrap"}
