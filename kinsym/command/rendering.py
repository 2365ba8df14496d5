"""A derivation as source files: which targets there are, and which files each of them writes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from kinsym.errors import UsageError
from kinsym.robot.names import shown

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
#: The types of the numbers in the C, and the targets around it that know the first alone.
REALS = ("double", "float")
DOUBLE_ALONE = ("extension", "cpp", "ikfast")


def file_names(name: str, targets: Sequence[str] | None = None) -> list[str]:
    """The files of a robot below the output folder, in order; those of the usual targets if None.

    >>> file_names("ur5", ("c",))
    ['ur5.c', 'ur5.h']
    """
    return [path.format(name) for target, paths in FILES.items() if target in (targets or USUAL) for path in paths]


def check_real(real: str, targets: Sequence[str] | None = None) -> None:
    """Whether these targets can be written with this type of numbers; UsageError if not.

    >>> check_real("float", ("numpy", "c"))
    """
    if real not in REALS:
        raise UsageError(f"there is no type {shown(real)} of numbers. They are {', '.join(REALS)}.")
    if real == "double":
        return
    wanted = targets or USUAL
    fixed = [target for target in wanted if target in DOUBLE_ALONE]
    if fixed:
        raise UsageError(f"{' and '.join(fixed)} have double precision alone. Ask for float with --target c.")
    if "c" not in wanted:
        raise UsageError("float is for the C, and the C is not asked for. Add --target c, or leave --real out.")


def of_real(real: str, schedule: Schedule) -> Schedule:
    """A schedule whose C has numbers of this type; DoesNotApply for an arm that needs double precision."""
    from kinsym.emit.source.single import in_single

    return in_single(schedule) if real == "float" else schedule


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
