"""Mutants of what all languages are printed from: one tree of a schedule, or one step of its plan, is another."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from fractions import Fraction
from functools import partial
from typing import Any

from kinsym.algebra.tree import Call, Definition, Num, Pow, Prod, Quot, Sum, Sym, Tree
from kinsym.emit.schedule import Assign, Schedule, Solve
from kinsym.emit.text.formula import TextPrinter
from tests.sabotage.mutant import CONSTANT, GUARD, PARAMETER, SIGN, TRIG, Mutant, other, turned

LANGUAGE = "plan"

_WAVES = {"cos": "sin", "sin": "cos"}
_CHANGE = Fraction(1, 10**6)

Change = tuple[str, Tree]


def mutants(schedule: Schedule) -> list[Mutant]:
    """Every mutant of one schedule."""
    return [*_tree_mutants(schedule), *_step_mutants(schedule)]


def _tree_mutants(schedule: Schedule) -> Iterator[Mutant]:
    names = tuple(parameter.name for parameter in schedule.parameters)
    printer = TextPrinter()
    for where, tree, known, put in _slots(schedule):
        for kind, new in _variants(tree, known, names):
            yield _mutant(kind, where, printer(tree), printer(new), partial(put, new))


def _mutant(kind: str, where: str, before: str, after: str, make: Callable[[], Any]) -> Mutant:
    return Mutant(language=LANGUAGE, kind=kind, where=where, before=before, after=after, make=make)


def _slots(schedule: Schedule) -> Iterator[tuple[str, Tree, set[str], Callable[[Tree], Schedule]]]:
    """Every tree of a schedule: its name, itself, the names that are known there, and how another is put there."""
    given = {item.name for item in schedule.parameters}
    known = set(given)
    for place, item in enumerate(schedule.constants):
        yield item.name, item.value, set(known), partial(_with_definition, schedule, "constants", place)
        known.add(item.name)
    for part in ("forward", "jacobian"):
        line, here = getattr(schedule, part), set(known)
        for place, item in enumerate(line.definitions):
            put = partial(_with_line, schedule, part, "definitions", place)
            yield f"{part}, {item.name}", item.value, set(here), put
            here.add(item.name)
        for place, tree in enumerate(line.outputs):
            yield f"{part}, entry {place + 1}", tree, here, partial(_with_line, schedule, part, "outputs", place)
    for place, item in enumerate(schedule.held):
        yield item.name, item.value, set(known), partial(_with_definition, schedule, "held", place)
        known.add(item.name)
    known |= {f"{column}_{axis}" for column in "uvwp" for axis in "xyz"}
    for place, statement in enumerate(schedule.inverse):
        match statement:
            case Assign(name=name, value=tree):
                yield name, tree, set(known), partial(_with_assignment, schedule, place)
                known.add(name)
            case Solve(step=step):
                for name, tree in step.inputs.items():
                    put = partial(_with_input, schedule, place, name)
                    yield f"step {step.number}, {step.unknown}, input {name}", tree, set(known), put
                known |= set(step.outputs)


def _with_definition(schedule: Schedule, part: str, place: int, tree: Tree) -> Schedule:
    items: list[Definition] = list(getattr(schedule, part))
    items[place] = replace(items[place], value=tree)
    return replace(schedule, **{part: tuple(items)})


def _with_line(schedule: Schedule, part: str, kind: str, place: int, tree: Tree) -> Schedule:
    line = getattr(schedule, part)
    items = list(getattr(line, kind))
    items[place] = replace(items[place], value=tree) if kind == "definitions" else tree
    return replace(schedule, **{part: replace(line, **{kind: tuple(items)})})


def _with_assignment(schedule: Schedule, place: int, tree: Tree) -> Schedule:
    return _with_statement(schedule, place, replace(schedule.inverse[place], value=tree))


def _with_input(schedule: Schedule, place: int, name: str, tree: Tree) -> Schedule:
    step = schedule.inverse[place].step
    return _with_step(schedule, place, inputs={**step.inputs, name: tree})


def _with_step(schedule: Schedule, place: int, **changes: Any) -> Schedule:
    statement = schedule.inverse[place]
    return _with_statement(schedule, place, replace(statement, step=replace(statement.step, **changes)))


def _with_statement(schedule: Schedule, place: int, statement: Any) -> Schedule:
    return replace(schedule, inverse=(*schedule.inverse[:place], statement, *schedule.inverse[place + 1 :]))


def _step_mutants(schedule: Schedule) -> Iterator[Mutant]:
    """Outputs of a step swapped, signs of its reference, and what keeps wrong answers and wrong parameters out."""
    for place, statement in enumerate(schedule.inverse):
        if not isinstance(statement, Solve):
            continue
        step = statement.step
        where = f"step {step.number}, {step.unknown}"
        if len(step.outputs) > 1:
            outputs = (*step.outputs[1::-1], *step.outputs[2:])
            make = partial(_with_step, schedule, place, outputs=outputs)
            yield _mutant(TRIG, where, ", ".join(step.outputs), ", ".join(outputs), make)
        for number, (joint, sign) in enumerate(step.reference):
            reference = (*step.reference[:number], (joint, -sign), *step.reference[number + 1 :])
            make = partial(_with_step, schedule, place, reference=reference)
            yield _mutant(SIGN, f"{where}, reference", f"{sign}*{joint}", f"{-sign}*{joint}", make)
    if schedule.gate:
        yield _mutant(GUARD, "gate", "there", "gone", partial(replace, schedule, gate=False))
    printer = TextPrinter()
    for place, item in enumerate(schedule.nonzero):
        kept = (*schedule.nonzero[:place], *schedule.nonzero[place + 1 :])
        make = partial(replace, schedule, nonzero=kept)
        yield _mutant(GUARD, "what must not vanish", printer(item.value), "any value", make)


def _variants(tree: Tree, known: set[str], parameters: tuple[str, ...]) -> Iterator[Change]:
    """All trees that differ from one in a single place."""
    match tree:
        case Num(value):
            yield CONSTANT, Num(value * (1 + _CHANGE) if value else _CHANGE)
        case Sym(name):
            for kind, new in ((TRIG, turned(name)), (PARAMETER, other(name, parameters))):
                if new in known:
                    yield kind, Sym(str(new))
        case Sum(terms):
            for place, term in enumerate(terms):
                yield SIGN, Sum((*terms[:place], Prod((Num(Fraction(-1)), term)), *terms[place + 1 :]))
            yield from _inside(terms, known, parameters, Sum)
        case Prod(factors):
            yield SIGN, Prod((Num(Fraction(-1)), *factors))
            yield from _inside(factors, known, parameters, Prod)
        case Pow(base, exponent):
            yield from ((kind, Pow(new, exponent)) for kind, new in _variants(base, known, parameters))
        case Quot(top, bottom):
            yield from ((kind, Quot(new, bottom)) for kind, new in _variants(top, known, parameters))
            yield from ((kind, Quot(top, new)) for kind, new in _variants(bottom, known, parameters))
        case Call(function, arguments):
            if function in _WAVES:
                yield TRIG, Call(_WAVES[function], arguments)
            yield from _inside(arguments, known, parameters, partial(Call, function))


def _inside(
    parts: tuple[Tree, ...], known: set[str], parameters: tuple[str, ...], make: Callable[[tuple[Tree, ...]], Tree]
) -> Iterator[Change]:
    for place, part in enumerate(parts):
        for kind, new in _variants(part, known, parameters):
            yield kind, make((*parts[:place], new, *parts[place + 1 :]))
