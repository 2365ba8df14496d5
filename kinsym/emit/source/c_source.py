"""A schedule as C99: NAME.h and NAME.c.

Constants are locals, branches are nested loops over the roots that a kernel returned, and nothing is allocated or
kept between calls. The source compiles as C99 and as C++17 with every warning turned on. The templates are written for
``double``; what another type asks for is in :mod:`kinsym.emit.real`.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any, ClassVar

from kinsym.algebra.tree import ONE, ZERO, Tree
from kinsym.emit.environment import render
from kinsym.emit.printer import Printer, decimal
from kinsym.emit.real import DOUBLE
from kinsym.emit.schedule import NominalStarts, Schedule
from kinsym.emit.source.banner import banner, c_comment
from kinsym.emit.source.c_batch import LANES, batch_of, waves
from kinsym.emit.source.c_ending import c_ending
from kinsym.emit.source.c_general import general_names
from kinsym.emit.source.control import c_limits, control_names
from kinsym.emit.source.core import FILES, Core
from kinsym.emit.source.gate import gate_entries
from kinsym.emit.source.marks import c_marks
from kinsym.emit.source.needs import ENTRIES, InverseNeeds, functions_used, inverse_needs, line_needs
from kinsym.emit.source.nominal import nominal_names
from kinsym.emit.source.regular import regular_names
from kinsym.emit.source.single import single
from kinsym.emit.source.singular import singular_lines
from kinsym.emit.source.statements import KernelCall, inverse_views
from kinsym.emit.source.wrapping import WIDTH, cut, fill


class CPrinter(Printer):
    """Expressions of C99; what is not in its library is a helper of the generated source."""

    functions: ClassVar = {
        "sqrt": "sqrt",
        "sin": "sin",
        "cos": "cos",
        "abs": "fabs",
        "sign": "sign_of",
        "atan2": "angle_of",
        "hypot": "hypot",
        "wrap": "wrap",
        "unwound": "unwound",
        "half_turn": "half_turn",
        "opposite": "opposite",
    }
    pi = "3.141592653589793"


class LanePrinter(CPrinter):
    """The same in a loop over many poses, where sines and cosines must not be calls."""

    functions: ClassVar = {**CPrinter.functions, "sin": "lane_sin", "cos": "lane_cos"}


def c_source(schedule: Schedule) -> dict[str, str]:
    """The header and the source of a robot, by file name."""
    names = c_names(schedule)
    texts = {
        f"{schedule.name}.h": render("c/header.h.jinja", **names),
        f"{schedule.name}.c": render("c/source.c.jinja", **names),
    }
    return {name: single(text) for name, text in texts.items()} if schedule.real.single else texts


def c_names(schedule: Schedule, core: Core = FILES) -> dict[str, Any]:
    """What the templates of header and source read."""
    real = DOUBLE if core.embedded else schedule.real
    if real.single:
        schedule = replace(schedule, tau=real.tau)
    inverse, gate = inverse_needs(schedule), gate_entries(schedule.task)
    printer = CPrinter()
    statements = inverse_views(schedule, inverse, printer)
    marking = c_marks(schedule, statements)
    ending = c_ending(schedule, inverse, statements, printer)
    batch = batch_of(schedule, inverse, printer)
    names: dict[str, Any] = {
        **marking,
        **control_names(schedule),
        "lower_limits": c_limits(schedule, 0),
        "upper_limits": c_limits(schedule, 1),
        "core": core,
        "name": schedule.name,
        "macro": schedule.name.upper(),
        "schedule": schedule,
        "complete": all(parameter.value is not None for parameter in schedule.parameters),
        "fields": [*(parameter.name for parameter in schedule.parameters), *schedule.inputs],
        "heads": _heads(schedule, core, marking, inverse.marked, ending["word"]),
        "usable": _usable(schedule),
        "banner": [c_comment(line) for line in banner(schedule, shared=True)],
        **regular_names(schedule, printer),
        "singular": [c_comment(line) for line in singular_lines(schedule)],
        "inverse": inverse,
        "entries": _entries(inverse),
        **ending,
        "angles": "atan2" in ending["functions"],
        "gate": gate,
        "functions": ending["functions"] | (batch.functions if batch and core.whole else frozenset()),
        "batch": batch,
        "lanes": LANES,
        "waves": waves(schedule),
        "lane_expression": LanePrinter(),
        "index": {name: 4 * row + column for name, (row, column) in ENTRIES.items()},
        "fk": line_needs(schedule, schedule.forward),
        "jacobian": line_needs(schedule, schedule.jacobian),
        "poses": _outputs("T", (*schedule.forward.outputs, ZERO, ZERO, ZERO, ONE), printer),
        "jacobians": _outputs("J", schedule.jacobian.outputs, printer),
        "number": decimal,
        "expression": printer,
        "roots_call": roots_call,
        "real": real,
        "code": (lambda text, depth: code(single(text), depth)) if real.single else code,
        "comment": comment,
        "comment_lines": lambda text: "\n".join(f" * {line}" for line in fill(c_comment(text), WIDTH - 6)),
    }
    if schedule.general:
        names |= {
            "general": general_names(schedule, schedule.general, printer),
            "functions": names["functions"] | {"wrap"},
        }
    if schedule.nominal:
        names |= _nominal(schedule, core, schedule.nominal, printer)
    return names


def _nominal(schedule: Schedule, core: Core, nominal: NominalStarts, printer: Printer) -> dict[str, Any]:
    """The closed form that is asked first, and the helpers that it calls."""
    starts = nominal_names(schedule, nominal, printer)
    pose = f"const double M[12], const {schedule.name}_params *p"
    return {
        "kernels": starts["kernels"],
        "virtual": schedule.general is not None and schedule.general.virtual,
        "functions": functions_used(schedule) | functions_used(nominal.schedule) | {"wrap"},
        "starts": {
            **starts,
            "entries": _entries(starts["inverse"]),
            "head": f"{core.local} int nominal_starts({pose}, double q[][6], int *doubt)",
            "corrected_head": f"{core.local} int corrected({pose}, const arm *a, solutions *all)",
        },
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
    loose = [] if call.loose is None else [_loose(call.loose)]
    results = [f"{item.name}_roots" if many else f"&{item.name}" for item, many in pairs]
    marks = [] if call.branch is None else [f"{call.mark}_roots"]
    return RootsCall(
        results=", ".join(f"{item.name}_roots[{call.roots}]" if many else item.name for item, many in pairs),
        text=f"solve_{call.rule}({', '.join([*call.arguments, *loose, *results, *marks])})",
        roots=", ".join(
            f"{item.name} = {item.name}_roots[i{call.branch}]" for item, many in pairs if many and item.used
        ),
    )


def _loose(marks: tuple[str, ...]) -> str:
    """Whether a step before was special.

    >>> _loose(("mark1", "mark2")), _loose(())
    ('mark1 | mark2', '0')
    """
    return " | ".join(marks) or "0"


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


def _heads(schedule: Schedule, core: Core, marking: dict[str, Any], marked: bool, word: str) -> dict[str, Any]:
    """The functions as they are declared."""
    public, local = core.public, core.local
    name, joints = schedule.name, f"{schedule.name.upper()}_JOINTS"
    vector, parameters, solutions = f"const double q[{joints}]", f"const {name}_params *p", f"double q[][{joints}]"
    ending = "double alike[], " if marking["several"] else ""
    ending = f"{name}_mark marks[], {ending}unsigned twin, " if marking["ending"] else ending
    size = ", double size" if gate_entries(schedule.task).position else ""
    pose, slopes = f"{parameters}, const double M[12], double size", f"D[ENTRIES][{joints}]"
    sliding = ", double size" if any(joint.kind == "P" for joint in schedule.joints) else ""
    special = f"const {word} found[], int count" if marked else "int count"
    if marked or schedule.gate:
        special += f", const {name}_params *p, const double M[12], double tau"
        special += ", double size" if marked or size else ""
    called = f"const double T[16], {parameters}, const double reference[{joints}]"
    limits = f"const double lower[{joints}], const double upper[{joints}]"
    columns = "".join(f"const double {joint}_values[], " for joint in schedule.inputs)
    return {
        "solve": f"{public} {name}_status {name}_solve({called}, {name}_solutions *out)",
        "within": f"{public} int {name}_within({called}, {limits}, int capacity, {solutions}, {name}_mark marks[])",
        "nearest": f"{public} {name}_status {name}_nearest({called}, const double weights[{joints}], {limits}, "
        f"double q[{joints}])",
        "family": f"{public} unsigned {name}_family(unsigned free)",
        "fk": f"{public} void {name}_fk({vector}, {parameters}, double T[16])",
        "jacobian": f"{public} void {name}_jacobian({vector}, {parameters}, double J[6 * {joints}])",
        "ik": f"{public} int {name}_ik(const double T[16], {parameters}, {solutions})",
        "ik_near": f"{public} int {name}_ik_near({called}, {solutions})",
        "sweep": {
            joint: f"{public} int {name}_ik_sweep_{joint}({called}, const double values[], int steps, {solutions}, "
            "int counts[])"
            for joint in schedule.inputs
        },
        "fk_batch": f"{public} void {name}_fk_batch(const double q[], int n, {parameters}, double T[])",
        "ik_batch": f"{public} int {name}_ik_batch(const double T[], int n, {parameters}, "
        f"const double reference[{joints}], {columns}{solutions}, int counts[])",
        "ik_marked": f"{public} int {name}_ik_marked({called}, {solutions}, {name}_mark marks[])",
        "distance": f"{local} double distance({vector}, {pose}, double e[ENTRIES])",
        "slopes": f"{local} void slopes({vector}, {parameters}, double size, double {slopes})",
        "step": f"{local} void step(double {slopes}, const double e[ENTRIES], double damping, double g[{joints}])",
        "polish": f"{local} double polish(double q[{joints}], {pose})",
        "settle": f"{local} int settle({solutions}, {ending}int mark, unsigned free, {parameters}, "
        "const double M[12], double tau, double size)",
        "rounding": f"{local} double rounding(const double q[{joints}], double size)",
        "settled": f"{local} int settled({solutions}, {name}_mark marks[], {special})",
        "tidied": f"{local} int tidied({solutions}, {name}_mark marks[], const double alike[], int count{sliding})",
        "hold": f"{local} void hold(const {name}_params *p, double q[{joints}])",
        "constant_motions": f"{local} void constant_motions(const {name}_params *p, rigid_motion out[7])",
        "reaches": f"{local} int reaches({vector}, {parameters}, const double M[12], double tau{size})",
    }


def _usable(schedule: Schedule) -> str:
    """The condition under which the parameters can be used."""
    complete = all(parameter.value is not None for parameter in schedule.parameters)
    names = [*(parameter.name for parameter in schedule.parameters), *schedule.inputs]
    tests = [f"isfinite(p->{name})" for name in names]
    tests += ["regular(p)"] if schedule.nonzero else []
    return " && ".join(tests if complete else ["p != NULL", *tests])


def _outputs(array: str, values: Iterable[Tree], printer: Printer) -> list[str]:
    return [f"{array}[{number}] = {printer(value)};" for number, value in enumerate(values)]


def _entries(needs: InverseNeeds) -> list[str]:
    """The declarations of the pose's entries, a row of the matrix in a line."""
    rows: dict[int, list[str]] = {}
    for name, row, column in needs.entries:
        rows.setdefault(row, []).append(f"{name} = M[{4 * row + column}]")
    return [f"const double {', '.join(entries)};" for entries in rows.values()]
