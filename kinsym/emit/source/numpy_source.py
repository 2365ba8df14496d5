"""A schedule as a Python module that needs NumPy and nothing else.

Poses lie along the last axis and every step that branches adds an axis of its roots in front, so that the code of a
step is written as for one pose and NumPy broadcasts it over poses and branches.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, ClassVar

from kinsym.algebra.tree import ZERO, Tree
from kinsym.emit.environment import render
from kinsym.emit.printer import Printer, decimal
from kinsym.emit.schedule import NominalStarts, Schedule
from kinsym.emit.source.banner import banner, python_comment, python_docstring, python_string
from kinsym.emit.source.control import control_names, python_limits
from kinsym.emit.source.gate import gate_entries
from kinsym.emit.source.kernels import ANGLE, KERNELS, kernels_used
from kinsym.emit.source.marks import numpy_marks
from kinsym.emit.source.needs import ENTRIES, InverseNeeds, functions_used, held_needs, inverse_needs, line_needs
from kinsym.emit.source.nominal import nominal_names
from kinsym.emit.source.singular import singular_lines
from kinsym.emit.source.statements import KernelCall, inverse_views
from kinsym.emit.source.wrapping import WIDTH, cut, fill
from kinsym.general.plan import Cut, GeneralPlan
from kinsym.general.tables import BORDER_COLUMN, BORDER_ROW, CHART, OFFSET, arc_table, chebyshev_points, local_table


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
        "banner": [python_docstring(line) for line in banner(schedule)],
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
    names |= _constants(schedule) | _signatures(schedule, inverse) | _helpers(inverse)
    if schedule.general:
        names |= _general(schedule, schedule.general, inverse, printer)
    if schedule.nominal:
        names |= _nominal(schedule, schedule.nominal, printer)
    return {f"{schedule.name}.py": render("numpy/module.py.jinja", **names)}


def _constants(schedule: Schedule) -> dict[str, Any]:
    """What the module says about the robot."""
    values = [
        f'"{parameter.name}": {"None" if parameter.value is None else decimal(parameter.value)}'
        for parameter in schedule.parameters
    ]
    values_of = {item.name: NumpyPrinter()(item.value) for item in schedule.held}
    return {
        "complete": all(parameter.value is not None for parameter in schedule.parameters),
        "names": _tuple(joint.name for joint in schedule.joints),
        "kinds": _tuple(joint.kind for joint in schedule.joints),
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
        "solve_head": head("_solve", [*arguments, *schedule.inputs, *solving]),
        "solve_call": [
            *(name if name != "reference" else "near[part].T" for name in arguments),
            *(["*(value[part] for value in given)"] if schedule.inputs else []),
            "*parameters",
        ],
    }


#: The parts of the general solver: what opens the loop and follows from a root, what finds roots and polishes.
_LOOP = ("loop", "matrix", "substitution")
_SLIDES = ("slides",)
_SEARCH = ("roots", "isolation", "pivoting", "newton")


def _general(schedule: Schedule, plan: GeneralPlan, inverse: InverseNeeds, printer: Printer) -> dict[str, Any]:
    """What the solver of an arm without a closed form reads."""
    entries = [
        code(f"links[{number}, {row}, {column}]", printer(value))
        for number, link in enumerate(plan.transforms)
        for (row, column), value in link.places
        if value != ZERO
    ]
    held = held_needs(schedule)
    needed, read = ([*(item.name for item in needs.parameters), *needs.inputs] for needs in (inverse, held))
    cuts = plan.cuts or [Cut.before(number) for number in plan.suppressed]
    ways = [(tuple(number - 1 for number in cut.order), cut.backward, cut.shift, cut.bordered) for cut in cuts]
    every = [parameter.name for parameter in schedule.parameters]
    return {
        "parts": ["solve", "closure", *(_SLIDES if plan.suppressed else _LOOP), *_SEARCH],
        "two_slides": bool(plan.suppressed),
        "cuts": ways,
        "attempts": tuple((way, nearby) for nearby in (False, True) for way in range(len(ways))),
        "signs": plan.signs,
        "letters": plan.kinds,
        "virtual": plan.virtual,
        "columns": "2:" if plan.virtual else ":",
        "names_in_order": ", ".join(name for name in schedule.solution if name not in schedule.locked),
        "solved": [place for place, name in enumerate(schedule.solution) if name not in schedule.locked],
        "held": held,
        "whole_head": head("_whole", ["q", *read]),
        "whole_of": lambda q: f"_whole({', '.join([q, *_looked_up(read)])})",
        "own_parameters": "{name: parameters[name] for name in PARAMETERS}" if schedule.inputs else "parameters",
        "link_entries": entries,
        "links_head": head("_links", needed),
        "link_parameters": _tuple(needed),
        "blocks_call": [
            "T",
            "reference",
            f"dict({', '.join(f'{name}={name}' for name in every)})",
            *(f"{name}={name}" for name in schedule.inputs),
        ],
        "offset": OFFSET,
        "chart": CHART,
        "border_column": list(BORDER_COLUMN),
        "border_row": list(BORDER_ROW),
        "arc_table": [_row(row) for row in arc_table()],
        "points": _array(chebyshev_points()),
        "local_table": [_row(row) for row in local_table()],
    }


def _looked_up(names: Sequence[str]) -> list[str]:
    return [f'parameters["{name}"]' for name in names]


def _array(values: Sequence[float]) -> str:
    return f"np.array([{', '.join(map(repr, values))}])"


def _row(values: Sequence[float]) -> str:
    """One row of a table of numbers, on as many lines as it takes."""
    return "\n".join(f"    {part}" for part in cut(f"[{', '.join(map(repr, values))}],", WIDTH - 4))


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
            "call": f"_nominal_starts({', '.join(['M', *_looked_up(inputs)])})",
        },
    }


def _helpers(inverse: InverseNeeds) -> dict[str, Any]:
    """Which helper functions the module holds."""
    rules = kernels_used(inverse.statements)
    return {
        "kernels": rules,
        "branching": any(KERNELS[rule].branches == 2 for rule in rules),
        "freeing": any(KERNELS[rule].free and KERNELS[rule].outputs == ANGLE for rule in rules),
    }


def head(name: str, positional: list[str], keywords: Sequence[str] = ()) -> str:
    """The first line of a function, or its lines if it is long.

    >>> head("fk", ["q"], ["a2=0.5"])
    'def fk(q, *, a2=0.5):'
    """
    arguments = ", ".join([*positional, *(["*", *keywords] if keywords else [])])
    line = f"def {name}({arguments}):"
    if len(line) <= WIDTH:
        return line
    return "\n".join([f"def {name}(", *(f"    {part}" for part in cut(arguments, WIDTH - 4)), "):"])


def code(target: str, value: str, depth: int = 1) -> str:
    """An assignment, or a bare call without a target; a long value goes on lines of its own, inside its brackets."""
    indent = " " * 4 * depth
    target = indent + (f"{target} = " if target and target != "return" else f"{target} ".lstrip())
    line = target + value
    if len(line) <= WIDTH:
        return line
    called, bracket, arguments = value.partition("(")
    if bracket and called.replace(".", "").replace("_", "").isalnum() and _closes_last(arguments):
        opening, body = f"{target}{called}(", arguments[:-1]
    else:
        opening, body = f"{target}(", value
    return "\n".join([opening, *(f"{indent}    {part}" for part in cut(body, WIDTH - len(indent) - 4)), f"{indent})"])


def _closes_last(text: str) -> bool:
    """Whether the bracket that is open before a text is closed by its last letter."""
    depth = 1
    for position, letter in enumerate(text):
        depth += (letter == "(") - (letter == ")")
        if depth == 0:
            return position == len(text) - 1
    return False


def comment(text: str, depth: int = 1) -> str:
    """A comment at a depth of blocks."""
    indent = " " * 4 * depth
    return "\n".join(f"{indent}# {line}" for line in fill(python_comment(text), WIDTH - len(indent) - 2))


def results(call: KernelCall) -> str:
    """The names that a kernel's results get; what nothing reads is called _."""
    names = [*(output.name if output.used else "_" for output in call.outputs), call.mark]
    return ", ".join([*names, f"real{call.branch}"] if call.branch else names)


def kernel_call(call: KernelCall) -> str:
    """The call of a kernel; one with several roots is told how many axes its results will have behind the new one."""
    axes = [f"axes={call.level + 1}"] if call.branch else []
    loose = [] if call.loose is None else [" | ".join(call.loose) or "0"]
    return f"_{call.rule}({', '.join([*call.arguments, *loose, *axes])})"


def _tuple(names: Iterable[str]) -> str:
    items = [f'"{name}"' for name in names]
    return f"({', '.join(items)}{',' if len(items) == 1 else ''})"


def _entries(array: str, values: tuple[Tree, ...], columns: int, printer: Printer) -> list[str]:
    """Assignments to the entries of a matrix that was filled with zeros."""
    places = ((divmod(number, columns), value) for number, value in enumerate(values) if value != ZERO)
    return [code(f"{array}[..., {row}, {column}]", printer(value)) for (row, column), value in places]
