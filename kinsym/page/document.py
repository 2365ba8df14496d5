"""The page: everything that is known of a robot in one HTML file that loads nothing.

Style and script stand in the file; the policy in its head names them by their digests and forbids all else, the network
among it. Words of the user reach the page escaped, by Jinja or inside JSON in which no ``<`` is left.
"""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from markupsafe import Markup

from kinsym.check.report import NOT_RUN
from kinsym.check.task import ENTRIES
from kinsym.emit.environment import environment, template_folder
from kinsym.emit.html import derivation_html
from kinsym.emit.latex.names import Names
from kinsym.emit.operations import Operations
from kinsym.emit.prose.wording import TASKS, one_line
from kinsym.emit.source.javascript import javascript_source
from kinsym.page.controls import joint_controls, parameter_controls
from kinsym.page.picture import HEIGHT, WIDTH, View, drawing, grid_step, view_of
from kinsym.page.shown import Shown
from kinsym.page.slice import workspace_slice
from kinsym.page.solutions import forks, is_current, rows, unbounded

if TYPE_CHECKING:
    from kinsym.check.report import Report
    from kinsym.derivation import Derivation
    from kinsym.emit.schedule import Schedule

_LANGUAGES = {".py": "Python module, needs NumPy alone", ".c": "C99", ".h": "C header"}
_FUNCTIONS = {"forward": "fk", "inverse": "ik", "jacobian": "jacobian"}


def page(derivation: Derivation, schedule: Schedule, sources: Mapping[str, str], report: Report, shown: Shown) -> str:
    """The text of the page; ``sources`` are generated files by name, ``shown`` the arm in numbers.

    The same robot gives the same bytes: nothing that was measured on the machine stands in it.
    """
    robot = derivation.robot
    names = Names([*robot.variables, *robot.parameters])
    others = [
        (solution.branch, shown.shape.at(solution.q).path)
        for solution in shown.solutions
        if not is_current(shown, solution.q)
    ]
    posture = shown.shape.at(shown.q)
    view = view_of(shown.shape, [posture.path, *(path for _, path in others)])
    kinematics, drawn, panel = map(_asset, ("kinematics.js", "drawing.js", "panel.js"))
    script = "\n".join(('"use strict";', kinematics, javascript_source(derivation, schedule), drawn, panel))
    style = _asset("style.css")
    complete = all(value is not None for value in robot.parameters.values())
    context = {
        "title": one_line(robot.title) or robot.name,
        "name": robot.name,
        "version": report.version,
        "policy": f"default-src 'none'; script-src {_digest(script)}; style-src {_digest(style)};"
        " base-uri 'none'; form-action 'none'",
        "style": Markup(style),
        "script": Markup(script),
        "data": Markup(_json(_data(schedule, shown, view))),
        "width": WIDTH,
        "height": HEIGHT,
        "drawing": Markup(drawing(shown.shape, posture, others, view)),
        "grid": f"{grid_step(view):g}",
        "joints": joint_controls(shown, names),
        "parameters": parameter_controls(shown, names),
        "pose": [[f"{value + 0.0:.4f}" for value in row] for row in shown.pose.round(4).tolist()],
        "task": TASKS[schedule.task],
        "closed": schedule.general is None,
        "forks": forks(derivation),
        "rows": rows(derivation, shown),
        "limited": not all(unbounded(*limits) for limits in shown.shape.limits.tolist()),
        "derivation": derivation_html(derivation),
        "slice": workspace_slice(shown) if complete else None,
        "operations": [
            (function, str(Operations(**report.operations[key])) if key in report.operations else None)
            for key, function in _FUNCTIONS.items()
        ],
        "checks": report.checks,
        "checked": report.verdict != NOT_RUN,
        "verdict": report.verdict,
        "figures": report.figures,
        "code": [
            (name, words, text)
            for suffix, words in _LANGUAGES.items()
            for name, text in sources.items()
            if name == robot.name + suffix
        ],
    }
    return environment(autoescape=True).get_template("html/page.html.jinja").render(context)


def _asset(name: str) -> str:
    """A file that becomes a part of the page."""
    return (template_folder() / "html" / name).read_text(encoding="utf-8")


def _digest(text: str) -> str:
    """A script or a style as the policy names it."""
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


def _json(value: Any) -> str:
    """JSON for inside a script element: nothing in it can end the element.

    >>> _json("</script>")
    '"\\\\u003c/script>"'
    """
    text = json.dumps(value, ensure_ascii=True, separators=(",", ":"))
    return text.replace("<", "\\u003c")


def _data(schedule: Schedule, shown: Shown, view: View) -> dict[str, Any]:
    """What the script reads."""
    locked = {*schedule.locked}
    return {
        "q": list(shown.q),
        "given": list(shown.given),
        "view": {
            "azimuth": view.azimuth,
            "elevation": view.elevation,
            "centre": view.centre,
            "scale": view.scale,
            "plane": view.plane,
        },
        "entries": ENTRIES[schedule.task],
        "still": [place for place, joint in enumerate(schedule.joints) if joint.name in locked],
        "limits": [None if unbounded(*limits) else list(limits) for limits in shown.shape.limits.tolist()],
        "solutions": None
        if schedule.general is None
        else [{"branch": solution.branch, "q": list(solution.q)} for solution in shown.solutions],
    }
