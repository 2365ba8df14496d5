"""The lecture's equations as they are printed, read from ``equations/``.

One file is one system in one part of the lecture. A file says what the lecture's names mean in terms of kinsym's
derivation (``[names]``) and lists the equations; where the lecture prints a mistake, both the printed and the mended
form stand there.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from importlib import resources
from pathlib import Path
from typing import Any

from kinsym.lecture.notation import Binary, Node, NotationError, parse, parse_any

KINDS = {
    "definition": "definition",
    "table": "table",
    "reference_pose": "home pose",
    "statement": "statement",
    "link_transform": "link transform",
    "link_transform_inverse": "inverse of a link transform",
    "product": "product",
    "fk_element": "forward kinematics",
    "loop_closure": "loop closure",
    "screw": "screw",
    "ik_intermediate": "step of an inverse kinematics",
    "ik_solution": "solution of an inverse kinematics",
    "polynomial_reduction": "reduction to a polynomial",
    "pieper": "Pieper's solution",
    "workspace": "workspace",
    "frame_terminology": "frames",
}
"""The kinds of entries, with their names for a reader."""


@dataclass(frozen=True, kw_only=True)
class Form:
    """One way an entry is stated: an equation of two or more members, a sentence, or both.

    ``factors`` are the matrices of a product that is printed factor by factor; their product is the last member.
    ``means`` says in equations what the sentence claims. ``options`` are what the entry's check asks for beside that.
    """

    texts: tuple[str, ...]
    members: tuple[Node, ...]
    factors: tuple[Node, ...]
    claim: str
    means: tuple[tuple[Node, str, Node], ...]
    options: Mapping[str, Any] = field(hash=False)

    @property
    def text(self) -> str:
        """The form as one line."""
        return self.claim or " = ".join(self.texts)


@dataclass(frozen=True, kw_only=True)
class Entry:
    """An equation, table or sentence of the lecture.

    ``number`` is the one printed beside it, if any; ``check`` says how it is decided; ``mended`` is there where the
    printed form is thought to be a mistake, for ``reason``, which may be the scan's if it is ``doubtful``. ``restored``
    says how a line was found that cannot be read. ``instead`` says why kinsym writes it in another form.
    """

    id: str
    number: str
    slide: int
    kind: str
    check: str
    printed: Form
    mended: Form | None
    reason: str
    doubtful: bool
    restored: str
    instead: str


@dataclass(frozen=True, kw_only=True)
class Chapter:
    """One file of equations.

    ``names`` are formulas over kinsym's quantities, ``free`` symbols that may be anything. ``methods`` are those of
    kinsym's methods that the part of the lecture teaches, stated of the arm ``shown_by``, where some of the lecture's
    symbols have other names, ``aliases``.
    """

    file: str
    title: str
    system: str
    robot: str
    frames: tuple[str, ...]
    shorthand: str
    names: Mapping[str, Node] = field(hash=False)
    aliases: Mapping[str, str] = field(hash=False)
    methods: tuple[str, ...]
    shown_by: str
    pose: tuple[str, ...]
    free: Mapping[str, str] = field(hash=False)
    task: Mapping[str, str] = field(hash=False)
    without_dimensions: bool
    entries: tuple[Entry, ...]
    ways: tuple[Mapping[str, Any], ...] = field(hash=False)

    def entry(self, name: str) -> Entry:
        """The entry of a name.

        Raises NotationError if there is none.
        """
        for entry in self.entries:
            if entry.id == name:
                return entry
        raise NotationError(f"{self.file} has no equation {name!r}. Mend the name.")

    @property
    def definitions(self) -> dict[str, Form]:
        """What the lecture's own shorthand stands for, by name."""
        return {entry.printed.texts[0]: entry.printed for entry in self.entries if entry.check == "definition"}


@lru_cache(maxsize=1)
def chapters() -> tuple[Chapter, ...]:
    """All files of equations in the lecture's order.

    >>> sum(len(chapter.entries) for chapter in chapters())
    444
    """
    folder = Path(str(resources.files("kinsym.lecture"))) / "equations"
    return tuple(
        chapter_of(path.name, tomllib.loads(path.read_text("utf-8"))) for path in sorted(folder.glob("*.toml"))
    )


def chapter_of(file: str, content: Mapping[str, Any]) -> Chapter:
    """A chapter from the content of its file.

    Raises NotationError where a formula cannot be read.
    """
    system = str(content["system"])
    return Chapter(
        file=file,
        title=str(content["title"]),
        system=system,
        robot=str(content.get("robot", system)),
        frames=tuple(content.get("frames", ())),
        shorthand=str(content.get("shorthand", "theta")),
        names={name: parse_any(text) for name, text in content.get("names", {}).items()},
        aliases=dict(content.get("aliases", {})),
        methods=tuple(content.get("methods", ())),
        shown_by=str(content.get("shown_by", content.get("robot", system))),
        pose=tuple(content.get("pose", ())),
        free=dict(content.get("free", {})),
        task=dict(content.get("task", {})),
        without_dimensions=bool(content.get("without_dimensions", False)),
        entries=tuple(_entry(file, raw, str(content.get("instead", ""))) for raw in content["equation"]),
        ways=tuple(content.get("way", ())),
    )


_PLAIN = ("id", "number", "slide", "kind", "check", "reason", "doubtful", "restored", "instead", "printed", "corrected")


def _entry(file: str, raw: Mapping[str, Any], instead: str) -> Entry:
    if raw["kind"] not in KINDS:
        raise NotationError(f"{file}, {raw['id']}: no kind of entry is called {raw['kind']!r}.")
    common = {key: value for key, value in raw.items() if key not in _PLAIN}
    mended = _form(common | raw["corrected"]) if "corrected" in raw else None
    return Entry(
        id=raw["id"],
        number=str(raw.get("number", "")),
        slide=int(raw["slide"]),
        kind=raw["kind"],
        check=str(raw.get("check", "identity")),
        printed=_form(common | raw.get("printed", {})),
        mended=mended,
        reason=str(raw.get("reason", "")),
        doubtful=bool(raw.get("doubtful", False)),
        restored=str(raw.get("restored", "")),
        instead=str(raw.get("instead", instead)),
    )


_FORM = ("left", "also", "right", "factors", "claim", "means")


def _form(raw: Mapping[str, Any]) -> Form:
    cells = [raw[key] for key in ("left",) if key in raw] + list(raw.get("also", ()))
    factors = tuple(parse_any(factor) for factor in raw.get("factors", ()))
    last = [raw["right"]] if "right" in raw else []
    members = [parse_any(cell) for cell in cells]
    if factors:
        members.append(_product(factors))
    members += [parse_any(cell) for cell in last]
    texts = [_text(cell) for cell in (*cells, *last)]
    if factors:
        texts.append(" ".join(_text(factor) for factor in raw["factors"]))
    return Form(
        texts=tuple(texts),
        members=tuple(members),
        factors=factors,
        claim=str(raw.get("claim", "")),
        means=tuple(_equation(text) for text in raw.get("means", ())),
        options={key: value for key, value in raw.items() if key not in _FORM},
    )


def _product(factors: tuple[Node, ...]) -> Node:
    total, *rest = factors
    for factor in rest:
        total = Binary("*", total, factor)
    return total


def _equation(text: str) -> tuple[Node, str, Node]:
    for sign in ("!=", "="):
        left, found, right = text.partition(f" {sign} ")
        if found:
            return parse(left), sign, parse(right)
    raise NotationError(f"{text!r} is no equation. Write left = right or left != right.")


def _text(cells: object) -> str:
    if isinstance(cells, str):
        return cells
    if isinstance(cells, list) and all(isinstance(cell, str) for cell in cells):
        return f"({', '.join(cells)})"
    return f"[{'; '.join(', '.join(row) for row in cells)}]" if isinstance(cells, list) else str(cells)
