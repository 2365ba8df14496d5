"""A schedule as JavaScript, for the page that draws the arm: its table in numbers and the candidates for a pose.

It is no target of its own: what is special is not settled here. A kernel knows the ordinary case and takes the nearest
real root otherwise; the page moves every candidate onto the pose by Newton's method and drops those that it cannot.
Every name of the derivation gets a ``$`` in front, so that no word of JavaScript is in its way.
"""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING, Any, ClassVar

from kinsym.algebra.convert import tree_of
from kinsym.algebra.tree import ZERO, Sym, Tree, replaced
from kinsym.emit.environment import render
from kinsym.emit.printer import ATOM, Printer, decimal
from kinsym.emit.schedule import Schedule
from kinsym.emit.source.kernels import kernels_used
from kinsym.emit.source.needs import inverse_needs
from kinsym.emit.source.statements import KernelCall, inverse_views
from kinsym.robot.model import Convention

if TYPE_CHECKING:
    from sympy import Expr

    from kinsym.derivation import Derivation


class JavaScriptPrinter(Printer):
    """Expressions over numbers.

    >>> JavaScriptPrinter()(Sym("c1"))
    '$c1'
    """

    functions: ClassVar = {
        "sqrt": "Math.sqrt",
        "sin": "Math.sin",
        "cos": "Math.cos",
        "abs": "Math.abs",
        "sign": "signOf",
        "atan2": "Math.atan2",
        "hypot": "Math.hypot",
        "wrap": "wrapped",
    }
    pi = "Math.PI"

    def _unsigned(self, body: Tree) -> tuple[str, int]:
        return (f"${body.name}", ATOM) if isinstance(body, Sym) else super()._unsigned(body)


def javascript_source(derivation: Derivation, schedule: Schedule) -> str:
    """Two functions: ``tableOf(given)`` of every arm, ``candidates(T, reference, given)`` where there is a closed form.

    ``given`` are the parameters in the schedule's order, ``reference`` is the joint vector whose values locked and free
    joints keep.
    """
    return render(
        "javascript/arm.js.jinja",
        names=[f"${parameter.name}" for parameter in schedule.parameters],
        inverse=None if schedule.general else _inverse(schedule),
        **_table(derivation),
    )


def _table(derivation: Derivation) -> dict[str, Any]:
    """The robot's table at home, cell by cell; joints whose variable enters with a minus sign are reversed."""
    robot, printer = derivation.robot, JavaScriptPrinter()
    home: dict[str, Tree] = dict.fromkeys(robot.variables, ZERO)
    signs = {motion.variable: motion.sign for motion in derivation.chain.joints}

    def cell(value: Expr | None) -> str:
        return printer(ZERO if value is None else replaced(tree_of(value), home))

    def vector(cells: tuple[Expr, Expr, Expr] | None) -> list[str]:
        return [cell(value) for value in cells or (None, None, None)]

    return {
        "convention": robot.convention.value,
        "rows": [
            {
                "kind": joint.kind,
                "reversed": joint.variable is not None and signs[joint.variable] < 0,
                "cells": [cell(value) for value in (joint.alpha, joint.a, joint.d, joint.theta)],
                "s": vector(joint.s),
                "s0": vector(joint.s0),
            }
            for joint in robot.joints
        ],
        "screw": robot.convention is Convention.SCREW,
        "home": None if robot.home is None else [vector(getattr(robot.home, v)) for v in ("u0", "v0", "w0", "q0")],
        "base": None if robot.base is None else [[cell(value) for value in row] for row in robot.base[:3]],
        "tool": None if robot.tool is None else [[cell(value) for value in row] for row in robot.tool[:3]],
    }


def _inverse(schedule: Schedule) -> dict[str, Any]:
    """The closed form as loops over roots."""
    printer, needs = JavaScriptPrinter(), inverse_needs(schedule)
    places = {joint.name: number for number, joint in enumerate(schedule.joints)}
    return {
        "entries": [(f"${name}", row, column) for name, row, column in needs.entries],
        "inputs": [(f"${name}", places[name]) for name in needs.inputs],
        "constants": [(f"${item.name}", printer(item.value)) for item in needs.constants],
        "size": printer(schedule.size) if needs.size else "",
        "tau": decimal(schedule.tau),
        "kernels": kernels_used(needs.statements),
        "statements": inverse_views(schedule, needs, printer),
        "call": _call,
        "branch": _branch(schedule.widths),
        "solution": [f"${name}" for name in schedule.solution],
        "depth": schedule.depth,
    }


def _call(call: KernelCall) -> str:
    return f"{call.rule}({', '.join(call.arguments)})"


def _branch(widths: tuple[int, ...]) -> str:
    """The number of a branch, counted as if every step had all its roots."""
    strides = [prod(widths[level + 1 :]) for level in range(len(widths))]
    terms = [f"{stride} * i{level}" if stride > 1 else f"i{level}" for level, stride in enumerate(strides, 1)]
    return " + ".join(terms) or "0"
