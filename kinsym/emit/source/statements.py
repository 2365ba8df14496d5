"""The statements of the inverse kinematics with their trees printed, ready for a template.

A language gives its printer; what is left to the template is the form of an assignment, of a call and of a branch.
"""

from __future__ import annotations

from dataclasses import dataclass

from kinsym.emit.printer import Printer
from kinsym.emit.schedule import Assign, Note, Schedule, Statement
from kinsym.emit.source.kernels import KERNELS
from kinsym.emit.source.needs import InverseNeeds


@dataclass(frozen=True, kw_only=True)
class Comment:
    """A note; ``follows`` is "branch" or "comment" if one stands right before it, where a blank line is too much."""

    kind: str = "comment"
    level: int
    text: str
    follows: str


@dataclass(frozen=True, kw_only=True)
class Assignment:
    """``name = value``."""

    kind: str = "assignment"
    level: int
    name: str
    value: str


@dataclass(frozen=True, kw_only=True)
class Output:
    """A result of a kernel: its name, whether it differs between the roots, whether anything reads it."""

    name: str
    rooted: bool
    used: bool


@dataclass(frozen=True, kw_only=True)
class KernelCall:
    """A call of a kernel with at most ``roots`` roots; ``branch`` numbers the level it opens, None for one root.

    ``mark`` is the variable that gets its mark. ``loose`` are the marks of the steps before it that can be free, None
    if the kernel has a root at any input. ``joints`` are the joints in its unknown, by number.
    """

    kind: str = "call"
    level: int
    rule: str
    arguments: tuple[str, ...]
    outputs: tuple[Output, ...]
    roots: int
    branch: int | None
    mark: str
    loose: tuple[str, ...] | None
    joints: tuple[int, ...]


View = Comment | Assignment | KernelCall


def inverse_views(schedule: Schedule, needs: InverseNeeds, printer: Printer) -> tuple[View, ...]:
    """Every statement that counts, in order, printed in one language."""
    joints = {joint.name: number for number, joint in enumerate(schedule.joints)}
    views: list[View] = []
    follows = ""
    loose: list[str] = []
    for statement in needs.statements:
        for view in _views(statement, needs, printer, joints=joints, follows=follows, loose=tuple(loose)):
            views.append(view)
            if isinstance(view, KernelCall):
                loose.append(view.mark)
            branched = isinstance(view, KernelCall) and view.branch is not None
            follows = "comment" if isinstance(view, Comment) else "branch" if branched else ""
    return tuple(views)


def _views(
    statement: Statement,
    needs: InverseNeeds,
    printer: Printer,
    *,
    joints: dict[str, int],
    follows: str,
    loose: tuple[str, ...],
) -> tuple[View, ...]:
    if isinstance(statement, Note):
        return (Comment(level=statement.level, text=statement.text, follows=follows),)
    level = statement.level
    if isinstance(statement, Assign):
        return (Assignment(level=level, name=statement.name, value=printer(statement.value)),)
    step, kernel = statement.step, KERNELS[statement.step.rule]
    inputs = tuple(printer(step.inputs[name]) for name in kernel.inputs)
    if kernel.plain:
        pairs = zip(step.outputs, inputs, strict=True)
        return tuple(Assignment(level=level, name=name, value=value) for name, value in pairs if name in needs.names)
    reference = (_reference(step.reference, joints),) if kernel.free else ()
    return (
        KernelCall(
            level=level,
            rule=step.rule,
            arguments=inputs + reference,
            outputs=tuple(
                Output(name=name, rooted=rooted, used=name in needs.names)
                for name, (_, rooted) in zip(step.outputs, kernel.outputs, strict=True)
            ),
            roots=step.branches,
            branch=level + 1 if step.branches > 1 else None,
            mark=f"mark{step.number}",
            loose=loose if kernel.ends else None,
            joints=tuple(joints[name] for name, _ in step.reference),
        ),
    )


def _reference(joints: tuple[tuple[str, int], ...], numbers: dict[str, int]) -> str:
    """The value of a free unknown: a signed sum of the caller's reference values.

    >>> _reference((("theta2", 1), ("theta3", -1)), {"theta2": 1, "theta3": 2})
    'reference[1] - reference[2]'
    """
    text = ""
    for name, sign in joints:
        mark = ("-" if sign < 0 else "") if not text else (" - " if sign < 0 else " + ")
        text += f"{mark}reference[{numbers[name]}]"
    return text or "0.0"
