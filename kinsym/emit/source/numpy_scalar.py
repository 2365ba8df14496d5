"""The inverse kinematics of one pose in plain Python numbers, beside the arrays of the NumPy module.

A depth is a loop over roots, as in C. Its kernels know the ordinary case alone: a root that would get a mark raises,
and the arrays take the pose over. So the policy at special poses stands in the module once.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import prod
from typing import Any, ClassVar

from kinsym.emit.printer import Printer
from kinsym.emit.schedule import Schedule, StraightLine
from kinsym.emit.source.gate import gate_entries
from kinsym.emit.source.kernels import KERNELS, kernels_used
from kinsym.emit.source.needs import ENTRIES, InverseNeeds, inverse_functions, inverse_needs, line_needs
from kinsym.emit.source.python_text import code, head
from kinsym.emit.source.statements import KernelCall, inverse_views
from kinsym.emit.source.wrapping import WIDTH, cut

#: The kernel that searches for roots: a search in plain numbers takes as long as one in arrays.
_SEARCHING = "quartic"
#: The entries that tell how long a pose's position is.
_LENGTHS = ("p_x", "p_y", "p_z")


class ScalarPrinter(Printer):
    """Expressions over plain numbers."""

    functions: ClassVar = {
        "sqrt": "math.sqrt",
        "sin": "math.sin",
        "cos": "math.cos",
        "abs": "abs",
        "sign": "_scalar_sign",
        "atan2": "_scalar_angle",
        "hypot": "math.hypot",
        "wrap": "_scalar_wrap",
    }
    pi = "math.pi"


def has_scalar_path(schedule: Schedule) -> bool:
    """Whether every step of a robot's solver is an explicit formula."""
    return not schedule.general and _SEARCHING not in kernels_used(inverse_needs(schedule).statements)


def scalar_names(schedule: Schedule, inverse: InverseNeeds, solving: Sequence[str]) -> dict[str, Any]:
    """What the templates of the solver of one pose read; ``solving`` are the parameters that are handed to it."""
    printer = ScalarPrinter()
    gate = gate_entries(schedule.task)
    tested = gate.rotation + gate.position if schedule.gate else ()
    known = {name for name, _, _ in inverse.entries}.union(tested, _LENGTHS if schedule.gate and gate.position else ())
    unpacked = [*(name if name in known else "_" for name in ENTRIES), "defect" if inverse.tau else "_"]
    return {
        "expression": printer,
        "statements": inverse_views(schedule, inverse, printer),
        "functions": inverse_functions(inverse),
        "head": head("_solve_one", ["pose", *schedule.inputs, *solving]),
        "unpacked": code(", ".join(unpacked), "pose"),
        "loop": _loop,
        "call": _call,
        "results": _results,
        "branch": _branch(schedule.widths),
        **(_gate(schedule, tested, printer) if schedule.gate else {}),
    }


def _results(call: KernelCall) -> str:
    """The names of the results for one root."""
    return ", ".join(output.name if output.used else "_" for output in call.outputs)


def _call(call: KernelCall) -> str:
    """The call of a kernel; only a free joint asks for its reference."""
    return f"_scalar_{call.rule}({', '.join(call.arguments[: len(KERNELS[call.rule].inputs)])})"


def _loop(call: KernelCall) -> str:
    """The head of the loop over the roots of a kernel, on as many lines as it takes."""
    indent = " " * 4 * (call.level + 1)
    names = _results(call) + ("," if len(call.outputs) == 1 else "")
    opening, roots = f"{indent}for i{call.branch}, ({names}) in enumerate(", _call(call)
    if len(f"{opening}{roots}):") <= WIDTH:
        return f"{opening}{roots}):"
    return "\n".join([opening, *(f"{indent}    {part}" for part in cut(roots, WIDTH - len(indent) - 4)), f"{indent}):"])


def _branch(widths: Sequence[int]) -> str:
    """The number of a branch, counted as if every step had all its roots."""
    strides = [prod(widths[level + 1 :]) for level in range(len(widths))]
    terms = [f"{stride} * i{level}" if stride > 1 else f"i{level}" for level, stride in enumerate(strides, 1)]
    return " + ".join(terms) or "0"


def _gate(schedule: Schedule, tested: tuple[str, ...], printer: Printer) -> dict[str, Any]:
    """The test that a joint vector reaches the pose, by the forward kinematics of the entries of the task alone."""
    places = [ENTRIES[name] for name in tested]
    outputs = tuple(schedule.forward.outputs[4 * row + column] for row, column in places)
    needs = line_needs(schedule, StraightLine(definitions=schedule.forward.definitions, outputs=outputs))
    position = gate_entries(schedule.task).position
    read = {*tested, *(_LENGTHS if position else ())}
    arguments = [
        *(name for _, name in needs.joints),
        *(name for name in ENTRIES if name in read),
        "tau",
        *(["size"] if position else []),
        *(parameter.name for parameter in needs.parameters),
    ]
    gaps = [
        f"abs({printer(value)} - {name}) <= {'t_length' if name in position else 't'}"
        for name, value in zip(tested, outputs, strict=True)
    ]
    return {
        "forward": needs,
        "gate_head": head("_reaches_pose", arguments),
        "gate_call": f"_reaches_pose({', '.join(arguments)})",
        "gaps": gaps,
    }
