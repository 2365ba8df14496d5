"""A derivation as source files: which targets there are, and which files each of them writes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kinsym.derivation import Derivation
    from kinsym.emit.schedule import Schedule

SUFFIXES = {"numpy": (".py",), "c": (".c", ".h"), "latex": (".tex",)}


def file_names(name: str, targets: Sequence[str] | None = None) -> list[str]:
    """The files of a robot, in order; all targets if None.

    >>> file_names("ur5", ("c",))
    ['ur5.c', 'ur5.h']
    """
    return [name + suffix for target, ends in SUFFIXES.items() if _wanted(target, targets) for suffix in ends]


def rendered(derivation: Derivation, schedule: Schedule, targets: Sequence[str] | None = None) -> dict[str, str]:
    """The texts by file name, in the order of :func:`file_names`."""
    from kinsym.emit import TARGETS

    texts: dict[str, str] = {}
    for target, source_of in TARGETS.items():
        if _wanted(target, targets):
            texts.update(source_of(schedule))
    if _wanted("latex", targets):
        from kinsym.emit.latex import document

        texts[schedule.name + ".tex"] = document(derivation)
    return {name: texts[name] for name in file_names(schedule.name, targets)}


def _wanted(target: str, targets: Sequence[str] | None) -> bool:
    return not targets or target in targets
