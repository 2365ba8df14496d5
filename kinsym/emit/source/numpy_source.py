"""A schedule as a Python module that needs NumPy and nothing else.

Poses lie along the last axis and every step that branches adds an axis of its roots in front, so that the code of a
step is written as for one pose and NumPy broadcasts it over poses and branches.
"""

from __future__ import annotations

import textwrap
from typing import Any, ClassVar

from kinsym.algebra.tree import ZERO, Tree
from kinsym.emit.environment import render
from kinsym.emit.printer import Printer, decimal
from kinsym.emit.schedule import NominalStarts, Schedule
from kinsym.emit.source.banner import banner, python_docstring, python_string
from kinsym.emit.source.control import control_names, python_limits
from kinsym.emit.source.gate import gate_entries
from kinsym.emit.source.kernels import ANGLE, KERNELS, kernels_used
from kinsym.emit.source.marks import numpy_marks
from kinsym.emit.source.needs import ENTRIES, InverseNeeds, functions_used, inverse_needs, line_needs
from kinsym.emit.source.nominal import nominal_names
from kinsym.emit.source.numpy_general import general_names, looked_up
from kinsym.emit.source.numpy_scalar import has_scalar_path, scalar_names
from kinsym.emit.source.python_text import code, comment, head, names_tuple
from kinsym.emit.source.regular import Vanishing, regular_names
from kinsym.emit.source.singular import singular_lines
from kinsym.emit.source.statements import KernelCall, inverse_views
from kinsym.emit.source.wrapping import WIDTH, cut


class NumpyPrinter(Printer):
    """Expressions over arrays; names with an underscore are helpers of the generated module."""

    functions: ClassVar = {
        "sqrt": "np.sqrt",
        "sin": "np.sin",
        "cos": "np.cos",
        "abs": "np.abs",
        "sign": "_sign",
        "atan2": "_angle",
        "hypot": "np.hypot",
        "wrap": "_wrap",
    }
    pi = "np.pi"


def numpy_source(schedule: Schedule) -> dict[str, str]:
    """The module of a robot, by file name."""
    inverse = inverse_needs(schedule)
    printer = NumpyPrinter()
    statements = inverse_views(schedule, inverse, printer)
    names = {
        **numpy_marks(schedule, statements),
        **control_names(schedule),
        "limits": python_limits(schedule),
        "schedule": schedule,
        "joints": len(schedule.joints),
        "solutions": schedule.maximum,
        "banner": [python_docstring(line) for line in banner(schedule, shared=False)],
        "singular": [python_docstring(line) for line in singular_lines(schedule)],
        "fk": line_needs(schedule, schedule.forward),
        "jacobian": line_needs(schedule, schedule.jacobian),
        "poses": _entries("T", schedule.forward.outputs, 4, printer),
        "jacobians": _entries("J", schedule.jacobian.outputs, len(schedule.joints), printer),
        "inverse": inverse,
        "statements": statements,
        "functions": functions_used(schedule),
        "gate": gate_entries(schedule.task),
        "place": ENTRIES,
        "tuple": tuple,
        "shape": "".join(f"{width}, " for width in reversed(schedule.widths)),
        "paired": set(schedule.widths) <= {2},
        "axes": list(range(schedule.depth, -1, -1)),
        "reals": [f"real{branch}" for branch in range(1, schedule.depth + 1)],
        "results": results,
        "kernel_call": kernel_call,
        "number": decimal,
        "string": python_string,
        "expression": printer,
        "code": code,
        "comment": comment,
    }
    names |= constants(schedule) | _signatures(schedule, inverse) | _helpers(inverse) | _regular(schedule, printer)
    names["scalar"] = scalar_names(schedule, inverse, names["solving"]) if has_scalar_path(schedule) else None
    if schedule.general:
        names |= general_names(schedule, schedule.general, inverse, printer)
    if schedule.nominal:
        names |= _nominal(schedule, schedule.nominal, printer)
    return {f"{schedule.name}.py": render("numpy/module.py.jinja", **names)}


def constants(schedule: Schedule) -> dict[str, Any]:
    """What the module says about the robot."""
    values = [
        f'"{parameter.name}": {"None" if parameter.value is None else decimal(parameter.value)}'
        for parameter in schedule.parameters
    ]
    values_of = {item.name: NumpyPrinter()(item.value) for item in schedule.held}
    return {
        "complete": all(parameter.value is not None for parameter in schedule.parameters),
        "names": names_tuple(joint.name for joint in schedule.joints),
        "kinds": names_tuple(joint.kind for joint in schedule.joints),
        "values": "{" + ", ".join(values) + "}",
        "locks": "{" + ", ".join(f'"{name}": {values_of.get(name, "None")}' for name in schedule.locked) + "}",
    }


def _signatures(schedule: Schedule, inverse: InverseNeeds) -> dict[str, Any]:
    """The heads of functions, and how parameters are handed on."""
    every = [parameter.name for parameter in schedule.parameters]
    keywords = [
        parameter.name if parameter.value is None else f"{parameter.name}={decimal(parameter.value)}"
        for parameter in schedule.parameters
    ]
    solving = every if schedule.gate or inverse.marked else [parameter.name for parameter in inverse.parameters]
    arguments = ["M", *(["defect"] if inverse.tau else []), *(["reference"] if inverse.reference else [])]
    passed, locked = ([f"{name}={name}" for name in names] for names in (every, schedule.inputs))
    return {
        "solving": solving,
        "passed": passed,
        "locked": locked,
        "given": "".join(f", {name}=..." for name in schedule.inputs),
        "handed": ", given" if every else "",
        "handed_here": f", dict({', '.join(passed)})" if every else "",
        "keywords": ", **given" if every else "",
        "check": code("", f"_check_parameters({', '.join(passed)})"),
        "public": lambda name, first, *options: head(name, [first], [*options, *keywords]),
        "public_control": lambda name, first, options: head(name, first, [*schedule.inputs, *options, *keywords]),
        "public_ik": lambda name, first: head(name, [first], [*schedule.inputs, "reference=None", *keywords]),
        "blocks_call": ["T", "reference", f"({', '.join(solving)}{',' if len(solving) == 1 else ''})", *locked],
        "solve_head": head("_solve", ["q", "valid", *arguments, *schedule.inputs, *solving]),
        "solve_call": [
            *(name if name != "reference" else "near[part].T" for name in arguments),
            *(["*(value[part] for value in given)"] if schedule.inputs else []),
            "*parameters",
        ],
    }


def _regular(schedule: Schedule, printer: Printer) -> dict[str, Any]:
    """The test that nothing vanishes that the equations take for granted."""
    names = regular_names(schedule, printer)
    given = [parameter.name for parameter in names["regular"].parameters]
    return names | {
        "nonzero": [_not_zero(item) for item in names["vanishing"]],
        "nonzero_head": head("_check_nonzero", given),
        "check_nonzero": code("", f"_check_nonzero({', '.join(given)})"),
    }


def _nominal(schedule: Schedule, nominal: NominalStarts, printer: Printer) -> dict[str, Any]:
    """The closed form that is asked first, and the helpers that it calls."""
    starts = nominal_names(schedule, nominal, printer)
    inputs = starts["inverse"].inputs
    return {
        **_helpers(starts["inverse"]),
        "functions": functions_used(schedule) | functions_used(nominal.schedule),
        "starts": {
            **starts,
            "head": head("_nominal_starts", ["M", *inputs]),
            "call": f"_nominal_starts({', '.join(['M', *looked_up(inputs)])})",
        },
    }


def _not_zero(item: Vanishing) -> str:
    """The test of one value; a long one has a line for each argument, and a string is not cut within a word."""
    call = f'_not_zero({item.value}, {item.least}, "{item.name}", "{item.remedy}")'
    if len(call) <= WIDTH - 4:
        return code("", call)
    lines = [*cut(f"{item.value},", WIDTH - 8), f"{item.least},"]
    for text in (item.name, item.remedy):
        *pieces, last = textwrap.wrap(text, WIDTH - 12, drop_whitespace=False)
        lines += [*(f'"{piece}"' for piece in pieces), f'"{last}",']
    return "\n".join(["    _not_zero(", *(f"        {line}" for line in lines), "    )"])


def _helpers(inverse: InverseNeeds) -> dict[str, Any]:
    """Which helper functions the module holds."""
    rules = kernels_used(inverse.statements)
    return {
        "kernels": rules,
        "branching": any(KERNELS[rule].branches == 2 for rule in rules),
        "freeing": any(KERNELS[rule].free and KERNELS[rule].outputs == ANGLE for rule in rules),
    }


def results(call: KernelCall) -> str:
    """The names that a kernel's results get; what nothing reads is called _."""
    names = [*(output.name if output.used else "_" for output in call.outputs), call.mark]
    return ", ".join([*names, f"real{call.branch}"] if call.branch else names)


def kernel_call(call: KernelCall) -> str:
    """The call of a kernel; one with several roots is told how many axes its results will have behind the new one."""
    axes = [f"axes={call.level + 1}"] if call.branch else []
    loose = [] if call.loose is None else [" | ".join(call.loose) or "0"]
    return f"_{call.rule}({', '.join([*call.arguments, *loose, *axes])})"


def _entries(array: str, values: tuple[Tree, ...], columns: int, printer: Printer) -> list[str]:
    """Assignments to the entries of a matrix that was filled with zeros."""
    places = ((divmod(number, columns), value) for number, value in enumerate(values) if value != ZERO)
    return [code(f"{array}[..., {row}, {column}]", printer(value)) for (row, column), value in places]
