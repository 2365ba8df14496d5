"""A derivation as source files: which targets there are, and which files each of them writes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kinsym.derivation import Derivation
    from kinsym.emit.schedule import Schedule

FILES = {
    "numpy": ("{0}.py",),
    "c": ("{0}.c", "{0}.h"),
    "latex": ("{0}.tex",),
    "extension": tuple(
        "{0}-solver/" + path
        for path in """pyproject.toml setup.py README.md c/_core.c c/{0}.c c/{0}.h src/{0}/__init__.py
        src/{0}/_arguments.py src/{0}/_arguments.pyi
        src/{0}/_core.pyi src/{0}/py.typed""".split()
    ),
    "cpp": ("{0}.hpp",),
    "ikfast": ("{0}_ikfast.cpp",),
}
#: What is written where nobody asks for a language.
USUAL = ("numpy", "c", "latex")


def file_names(name: str, targets: Sequence[str] | None = None) -> list[str]:
    """The files of a robot below the output folder, in order; those of the usual targets if None.

    >>> file_names("ur5", ("c",))
    ['ur5.c', 'ur5.h']
    """
    return [path.format(name) for target, paths in FILES.items() if target in (targets or USUAL) for path in paths]


def rendered(derivation: Derivation, schedule: Schedule, targets: Sequence[str] | None = None) -> dict[str, str]:
    """The texts by file name, in the order of :func:`file_names`."""
    from kinsym.emit import TARGETS

    texts: dict[str, str] = {}
    for target, source_of in TARGETS.items():
        if target in (targets or USUAL):
            texts.update(source_of(schedule))
    if "latex" in (targets or USUAL):
        from kinsym.emit.latex import document

        texts[schedule.name + ".tex"] = document(derivation)
    return {name: texts[name] for name in file_names(schedule.name, targets)}
