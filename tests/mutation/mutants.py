"""Mutants of the packages that hold the mathematics, made by cosmic-ray and drawn with a seed.

A place is drawn first, then one of the ways to change it: else the eleven operators that may stand for a plus would be
most of every sample. Left out is what cannot change anything that is computed: annotations, which nothing evaluates;
``strict`` of zip and ``kw_only`` of a dataclass, which refuse what no caller does; a comparison with ``==`` where the
same was asked with ``is`` of None or of a member of an enumeration; and a cache taken away.
"""

from __future__ import annotations

import ast
import difflib
import random
import sys
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from operator import itemgetter
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent.parent
PACKAGES = ("algebra", "kinematics", "inverse")
#: The version whose operators the page's figures come from; another one may draw other mutants.
REQUIREMENT = "cosmic-ray>=8.4"

_SAME = ("ReplaceComparisonOperator_Is_Eq", "ReplaceComparisonOperator_IsNot_NotEq")
_CACHES = ("@cache", "@lru_cache")
_REFUSALS = ("strict", "kw_only")


@dataclass(frozen=True, kw_only=True)
class Mutant:
    """One change: the module, its text, the lines that are others, what cosmic-ray calls the change."""

    module: str
    text: str
    line: int
    before: str
    after: str
    operator: str

    @property
    def package(self) -> str:
        """The package below ``kinsym`` that the module belongs to."""
        return self.module.split("/")[1]

    def __str__(self) -> str:
        return f"{self.module}:{self.line}: {self.before} -> {self.after or 'nothing'}"


@dataclass(frozen=True, kw_only=True)
class Place:
    """A part of a module and all the ways in which one kind of change can be made there."""

    module: str
    operators: tuple[tuple[str, int], ...]


def sample(every: Sequence[Place], seed: int, root: Path = ROOT) -> Iterator[Mutant]:
    """A mutant of every place, in the order in which the seed draws them: the first are a smaller sample.

    Every place draws for itself, so that a module that changes leaves the mutants of the others what they are.
    """
    draws = [(random.Random(f"{place} {seed}"), place) for place in every]
    for _, generator, place in sorted(((draw.random(), draw, place) for draw, place in draws), key=itemgetter(0)):
        ways = generator.sample(place.operators, len(place.operators))
        mutants = (_mutant(place.module, *way, root) for way in ways)
        yield from islice((mutant for mutant in mutants if mutant is not None), 1)


def places(package: str, root: Path = ROOT) -> list[Place]:
    """The places of a package, in the order of its files."""
    found = []
    for path in sorted((root / "kinsym" / package).rglob("*.py")):
        module = path.relative_to(root).as_posix()
        ways: dict[tuple[Any, ...], list[tuple[str, int]]] = {}
        for start, end, operator, occurrence in _positions(path.read_text(encoding="utf-8")):
            ways.setdefault((start, end, operator.partition("_")[0]), []).append((operator, occurrence))
        found += [Place(module=module, operators=tuple(ways[key])) for key in sorted(ways)]
    return found


def _positions(text: str) -> Iterator[tuple[tuple[int, int], tuple[int, int], str, int]]:
    """Start, end, operator and its occurrence of every change that can matter."""
    from cosmic_ray.ast import ast_nodes, get_ast
    from cosmic_ray.plugins import get_operator, operator_names

    nodes, idle, lines = list(ast_nodes(get_ast(text))), _idle(text), text.splitlines()
    for name in operator_names():
        operator_class = get_operator(name)
        if operator_class.arguments() or name.endswith(_SAME):
            continue
        operator = operator_class()
        ends = (ends for node in nodes for ends in operator.mutation_positions(node))
        for occurrence, (start, end) in enumerate(ends):
            cached = "RemoveDecorator" in name and lines[start[0] - 1].strip().startswith(_CACHES)
            if not cached and not any(first <= start and end <= last for first, last in idle):
                yield start, end, name, occurrence


def _idle(text: str) -> list[tuple[tuple[int, int], tuple[int, int]]]:
    """Where annotations and arguments that only refuse begin and end."""
    found = []
    for node in ast.walk(ast.parse(text)):
        parts = [getattr(node, "annotation", None), getattr(node, "returns", None)]
        parts += [node.value] if isinstance(node, ast.keyword) and node.arg in _REFUSALS else []
        found += [
            ((part.lineno, part.col_offset), (part.end_lineno or 0, part.end_col_offset or 0))
            for part in parts
            if part is not None
        ]
    return found


def _mutant(module: str, operator: str, occurrence: int, root: Path) -> Mutant | None:
    """The mutant of one change; None if Python refuses it or warns of it, or if it is the same program."""
    from cosmic_ray.mutating import mutate_code
    from cosmic_ray.plugins import get_operator

    old = (root / module).read_text(encoding="utf-8")
    new = mutate_code(old, get_operator(operator)(), occurrence)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            if new is None:
                return None
            compile(new, module, "exec")
    except (SyntaxError, SyntaxWarning):
        return None
    if ast.dump(ast.parse(new)) == ast.dump(ast.parse(old)):
        return None
    return changed(module, old, new, operator.rpartition("/")[2])


def changed(module: str, old: str, new: str, operator: str) -> Mutant:
    """The mutant that a changed text of a module is."""
    first, second = old.splitlines(), new.splitlines()
    matcher = difflib.SequenceMatcher(a=first, b=second, autojunk=False)
    parts = [code for code in matcher.get_opcodes() if code[0] != "equal"]
    before = [line.strip() for _, i, j, _, _ in parts for line in first[i:j]]
    after = [line.strip() for _, _, _, i, j in parts for line in second[i:j]]
    return Mutant(
        module=module,
        text=new,
        line=parts[0][1] + 1,
        before=" ".join(" ".join(before).split()),
        after=" ".join(" ".join(after).split()),
        operator=operator,
    )


def version() -> str:
    """The version of cosmic-ray; ends the program with one line where it is missing."""
    from importlib.metadata import PackageNotFoundError
    from importlib.metadata import version as version_of

    try:
        return version_of("cosmic-ray")
    except PackageNotFoundError:
        sys.exit(f"cosmic-ray makes the mutants and is not installed: pip install '{REQUIREMENT}'")
