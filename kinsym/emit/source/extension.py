"""A schedule as a Python package around its C: a folder that ``pip install`` takes.

The C is that of the target ``c``. A thin module of CPython's limited API gives it arrays, and a Python file gives that
module names, defaults and types, so that the package has the interface of the NumPy module and can take its place.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from kinsym import __version__
from kinsym.emit.environment import render
from kinsym.emit.printer import decimal
from kinsym.emit.real import DOUBLE
from kinsym.emit.schedule import Schedule
from kinsym.emit.source.banner import banner, c_comment, markdown, printable, python_docstring, python_string
from kinsym.emit.source.c_source import c_source
from kinsym.emit.source.control import control_names, python_limits
from kinsym.emit.source.numpy_source import constants
from kinsym.emit.source.python_text import code
from kinsym.emit.source.singular import singular_lines
from kinsym.emit.source.wrapping import WIDTH

#: The files below the folder of the package and their templates; NAME.c and NAME.h come to them. No name begins with _.
_TEMPLATES = {
    "pyproject.toml": "pyproject.toml",
    "setup.py": "setup.py",
    "README.md": "README.md",
    "c/_core.c": "core.c",
    "src/{name}/__init__.py": "package.py",
    "src/{name}/_arguments.py": "arguments.py",
    "src/{name}/_arguments.pyi": "arguments.pyi",
    "src/{name}/_core.pyi": "core.pyi",
}
_FLOATS = "NDArray[np.float64]"
_OPTIONAL = "ArrayLike | None = None"
#: The largest number of joint vectors that ``within`` returns, as in the NumPy module.
_MOST_WINDINGS = 1_000_000


def extension_source(schedule: Schedule) -> dict[str, str]:
    """The files of a package by their path below the output folder."""
    folder, name = f"{schedule.name}-solver", schedule.name
    names = _names(schedule)
    texts = {path.format(name=name): render(f"extension/{t}.jinja", **names) for path, t in _TEMPLATES.items()}
    core = c_source(replace(schedule, real=DOUBLE))
    texts |= {f"src/{name}/py.typed": "\n", **{f"c/{file}": text for file, text in core.items()}}
    return {f"{folder}/{path}": text for path, text in texts.items()}


def _names(schedule: Schedule) -> dict[str, Any]:
    """What the templates read."""
    every = [parameter.name for parameter in schedule.parameters]
    keywords = [
        f"{item.name}: float" if item.value is None else f"{item.name}: float = {decimal(item.value)}"
        for item in schedule.parameters
    ]
    inputs = list(schedule.inputs)

    def signature(name: str, first: list[str], options: list[str], result: str) -> str:
        return _head(name, first, [*options, *keywords], result)

    def call(function: str, *arguments: str | Sequence[str], target: str = "return") -> str:
        listed = [name for item in arguments for name in ([item] if isinstance(item, str) else item)]
        return code(target, f"_core.{function}({', '.join([*listed, *every])})")

    def fields(caller: str, place: int) -> str:
        if not inputs:
            return f"read_parameters(args + {place}, &p)"
        return f'read_fields(module, "{caller}", args + {place}, &p)'

    return {
        **constants(schedule),
        **control_names(schedule),
        "schedule": schedule,
        "name": schedule.name,
        "macro": schedule.name.upper(),
        "title": c_comment(schedule.title or schedule.name),
        "heading": markdown(schedule.title or schedule.name),
        "version": __version__,
        "description": _toml_string(f"Kinematics of {schedule.title or schedule.name}"),
        "banner": [python_docstring(line) for line in banner(schedule, shared=True)],
        "singular": [python_docstring(line) for line in singular_lines(schedule)],
        "joints": len(schedule.joints),
        "solutions": schedule.maximum,
        "most_windings": _MOST_WINDINGS,
        "limits": python_limits(schedule),
        "string": python_string,
        "code": code,
        "signature": signature,
        "call": call,
        "fields": fields,
        "inputs": inputs,
        "locked": [f"{name}={name}" for name in inputs],
        "passed": [f"{name}={name}" for name in every],
        "single": [f"{name}: float" for name in inputs],
        "several": [f"{name}: ArrayLike" for name in inputs],
        **{f"option_{name}": [f"{name}: {_OPTIONAL}"] for name in ("reference", "limits", "weights")},
        "POSE": "T: ArrayLike",
        "FLOATS": _FLOATS,
        "BATCH": f"tuple[{_FLOATS}, NDArray[np.bool_]]",
        "vanishing": _vanishing(schedule),
        **_example(schedule),
    }


def _vanishing(schedule: Schedule) -> str:
    """What is said of parameters with which something vanishes that must not, as a string of C."""
    names = ", ".join(dict.fromkeys(name for item in schedule.nonzero for name in item.parameters))
    return f'"a parameter vanishes that the equations take for granted, one of: {names}"'


def _head(name: str, positional: list[str], keywords: list[str], result: str) -> str:
    """The first line of a typed function, or its lines, one an argument, if it is long.

    >>> _head("fk", ["q: ArrayLike"], ["a2: float = 0.5"], "float")
    'def fk(q: ArrayLike, *, a2: float = 0.5) -> float:'
    """
    arguments = [*positional, *(["*", *keywords] if keywords else [])]
    line = f"def {name}({', '.join(arguments)}) -> {result}:"
    if len(line) <= WIDTH:
        return line
    return "\n".join([f"def {name}(", *(f"    {argument}," for argument in arguments), f") -> {result}:"])


def _example(schedule: Schedule) -> dict[str, Any]:
    """Lines of Python that use the package; parameters without a value get one."""
    given = [f"{item.name}=0.5" for item in schedule.parameters if item.value is None]
    asked = [*(f"{name}=0.3" for name in schedule.inputs), *given]
    joints = ", ".join(f"{0.1 * (number + 1):.1f}" for number in range(len(schedule.joints)))
    fk = ", ".join([f"[{joints}]", *given])
    return {
        "imports": f"from {schedule.name} import fk, ik, solve",
        "example_lines": [
            f"T = fk({fk})  # (4, 4)",
            f"q = ik({', '.join(['T', *asked])})  # (m, {len(schedule.joints)}): all m solutions",
            f"s = solve({', '.join(['T', *asked])})  # s.q, s.branch, s.status, ...",
        ],
    }


def _toml_string(text: str) -> str:
    """Text on one line as a basic string of TOML, whose escapes are those of Python's double quotes."""
    return python_string(printable(text))
