"""The sliders of a page: a joint value each, and a parameter each that has no number in the table."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from markupsafe import Markup

from kinsym.emit.html.mathml import math as in_math
from kinsym.emit.html.tex import mathml
from kinsym.emit.latex.names import Names
from kinsym.page.shown import ANGLE, Shown

#: A length without a value can be set from and up to here; it is next to 1 at first.
_SHORTEST, _LONGEST = 0.05, 2.0


@dataclass(frozen=True, kw_only=True)
class Control:
    """A slider: what it sets, from where to where, in degrees if ``angle``."""

    identity: str
    name: str
    label: Markup
    angle: bool
    low: float
    high: float
    step: float
    value: float
    fixed: bool = False


def joint_controls(shown: Shown, names: Names) -> list[Control]:
    """A slider for each joint; one that is locked at a value cannot be moved."""
    shape, arm = shown.shape, shown.arm
    locked: Mapping[str, float | None] = getattr(arm.module, "LOCKED", {})
    controls = []
    for number, (name, kind, limits) in enumerate(zip(shape.variables, shape.kinds, shape.limits, strict=True)):
        angle = kind == "R"
        low, high = (float(bound) for bound in limits)
        if angle:
            low, high = (math.degrees(low), math.degrees(high)) if math.isfinite(low) else (-180.0, 180.0)
            low, high, step = math.ceil(low - 1e-9), math.floor(high + 1e-9), 1.0
        else:
            low, high = low if math.isfinite(low) else -shape.size, high if math.isfinite(high) else shape.size
            step = float(f"{(high - low) / 200:.1g}")
            low, high = step * math.ceil(low / step - 1e-9), step * math.floor(high / step + 1e-9)
        value = math.degrees(shown.q[number]) if angle else shown.q[number]
        controls.append(
            Control(
                identity=f"joint{number}",
                name=name,
                label=in_math(mathml(names[name])),
                angle=angle,
                low=float(f"{low:.6g}"),
                high=float(f"{high:.6g}"),
                step=step,
                value=float(f"{value:.6g}"),
                fixed=locked.get(name) is not None,
            )
        )
    return controls


def parameter_controls(shown: Shown, names: Names) -> list[Control | None]:
    """A slider for each parameter without a value in the table, None for the others."""
    controls: list[Control | None] = []
    for number, (name, value) in enumerate(shown.arm.robot.parameters.items()):
        if value is not None:
            controls.append(None)
            continue
        given = shown.given[number]
        angle = given == ANGLE
        controls.append(
            Control(
                identity=f"parameter{number}",
                name=name,
                label=in_math(mathml(names[name])),
                angle=angle,
                low=-180.0 if angle else _SHORTEST,
                high=180.0 if angle else _LONGEST,
                step=1.0 if angle else 0.05,
                value=round(math.degrees(given)) if angle else given,
            )
        )
    return controls
