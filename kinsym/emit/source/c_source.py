"""A schedule as C99: NAME.h and NAME.c.

Constants are locals, branches are nested loops over the roots that a kernel returned, and nothing is allocated or
kept between calls. The source compiles as C99 and as C++17 with every warning turned on; ``double`` throughout, since
the tolerances that decide between one root and two are those of double precision.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, ClassVar

from kinsym.algebra.tree import ONE, ZERO, Tree
from kinsym.emit.environment import render
from kinsym.emit.printer import Printer, decimal
from kinsym.emit.schedule import Schedule
from kinsym.emit.source.banner import banner, c_comment
from kinsym.emit.source.c_general import general_names
from kinsym.emit.source.gate import gate_entries
from kinsym.emit.source.kernels import kernels_used
from kinsym.emit.source.needs import ENTRIES, InverseNeeds, functions_used, inverse_needs, line_needs
from kinsym.emit.source.statements import KernelCall, inverse_views
from kinsym.emit.source.wrapping import WIDTH, cut, fill


class CPrinter(Printer):
    """Expressions of C99; ``angle_of``, ``wrap`` and ``sign_of`` are helpers of the generated source."""

    functions: ClassVar = {
        "sqrt": "sqrt",
        "sin": "sin",
        "cos": "cos",
        "abs": "fabs",
        "sign": "sign_of",
        "atan2": "angle_of",
        "hypot": "hypot",
        "wrap": "wrap",
    }
    pi = "3.141592653589793"


def c_source(schedule: Schedule) -> dict[str, str]:
    """The header and the source of a robot, by file name."""
    inverse = inverse_needs(schedule)
    printer = CPrinter()
    names: dict[str, Any] = {
        "name": schedule.name,
        "macro": schedule.name.upper(),
        "schedule": schedule,
        "complete": all(parameter.value is not None for parameter in schedule.parameters),
        "heads": _heads(schedule),
        "usable": _usable(schedule),
        "banner": [c_comment(line) for line in banner(schedule)],
        "inverse": inverse,
        "statements": inverse_views(schedule, inverse, printer),
        "entries": _entries(inverse),
        "kernels": kernels_used(inverse.statements),
        "functions": functions_used(schedule),
        "gate": gate_entries(schedule.task),
        "index": {name: 4 * row + column for name, (row, column) in ENTRIES.items()},
        "fk": line_needs(schedule, schedule.forward),
        "jacobian": line_needs(schedule, schedule.jacobian),
        "poses": _outputs("T", (*schedule.forward.outputs, ZERO, ZERO, ZERO, ONE), printer),
        "jacobians": _outputs("J", schedule.jacobian.outputs, printer),
        "number": decimal,
        "expression": printer,
        "roots_call": roots_call,
        "code": code,
        "comment": comment,
    }
    if schedule.general:
        names |= {"general": general_names(schedule.general, printer), "functions": names["functions"] | {"wrap"}}
    return {
        f"{schedule.name}.h": render("c/header.h.jinja", **names),
        f"{schedule.name}.c": render("c/source.c.jinja", **names),
    }


@dataclass(frozen=True, kw_only=True)
class RootsCall:
    """A call of a kernel: the variables it fills, the call, and what a branch takes from them."""

    results: str
    text: str
    roots: str


def roots_call(call: KernelCall) -> RootsCall:
    """The C form of a call. Results that differ between the roots are arrays of them, the others pointers."""
    pairs = [(output, output.rooted and call.branch is not None) for output in call.outputs]
    arguments = [*call.arguments, *(f"{item.name}_roots" if many else f"&{item.name}" for item, many in pairs)]
    return RootsCall(
        results=", ".join(f"{item.name}_roots[{call.roots}]" if many else item.name for item, many in pairs),
        text=f"solve_{call.rule}({', '.join(arguments)})",
        roots=", ".join(
            f"{item.name} = {item.name}_roots[i{call.branch}]" for item, many in pairs if many and item.used
        ),
    )


def code(text: str, depth: int) -> str:
    """A statement at a depth of blocks, cut into lines that fit; continuation lines move right by one step."""
    indent = " " * 4 * depth
    first, *others = cut(text, WIDTH - len(indent), WIDTH - len(indent) - 4)
    return "\n".join([indent + first, *(f"{indent}    {line}" for line in others)])


def comment(text: str, depth: int) -> str:
    """A comment at a depth of blocks."""
    indent = " " * 4 * depth
    first, *others = fill(c_comment(text), WIDTH - len(indent) - 6)
    return "\n".join([f"{indent}/* {first}", *(f"{indent} * {line}" for line in others)]) + " */"


def _heads(schedule: Schedule) -> dict[str, str]:
    """The functions as they are declared."""
    name, joints = schedule.name, f"{schedule.name.upper()}_JOINTS"
    vector, parameters, solutions = f"const double q[{joints}]", f"const {name}_params *p", f"double q[][{joints}]"
    size = ", double size" if gate_entries(schedule.task).position else ""
    returned = "double" if schedule.gate and size else "void"
    return {
        "fk": f"void {name}_fk({vector}, {parameters}, double T[16])",
        "jacobian": f"void {name}_jacobian({vector}, {parameters}, double J[6 * {joints}])",
        "ik": f"int {name}_ik(const double T[16], {parameters}, {solutions})",
        "ik_near": f"int {name}_ik_near(const double T[16], {parameters}, "
        f"const double reference[{joints}], {solutions})",
        "constant_motions": f"static {returned} constant_motions(const {name}_params *p, rigid_motion out[7])",
        "reaches": f"static int reaches({vector}, {parameters}, const double M[12], double tau{size})",
    }


def _usable(schedule: Schedule) -> str:
    """The condition under which the parameters can be used."""
    complete = all(parameter.value is not None for parameter in schedule.parameters)
    tests = [f"isfinite(p->{parameter.name})" for parameter in schedule.parameters]
    return " && ".join(tests if complete else ["p != NULL", *tests])


def _outputs(array: str, values: Iterable[Tree], printer: Printer) -> list[str]:
    return [f"{array}[{number}] = {printer(value)};" for number, value in enumerate(values)]


def _entries(needs: InverseNeeds) -> list[str]:
    """The declarations of the pose's entries, a row of the matrix in a line."""
    rows: dict[int, list[str]] = {}
    for name, row, column in needs.entries:
        rows.setdefault(row, []).append(f"{name} = M[{4 * row + column}]")
    return [f"const double {', '.join(entries)};" for entries in rows.values()]
