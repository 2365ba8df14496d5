"""casadi (Andersson et al.): symbolic expressions to C. Forward kinematics and Jacobian by the product of the matrices.

``python -m tests.benchmarks.speed.peers.casadi ARM FOLDER`` writes ``ARM_casadi_fk.c`` and ``ARM_casadi_jacobian.c``.
Zeros and ones of the table drop out of the products, and common subexpressions are shared.
"""

from __future__ import annotations

import os
import sys
from math import cos, sin
from pathlib import Path
from typing import Any

import casadi

from tests.benchmarks.speed.arms import ARMS, Arm, Row


def _step(row: Row, value: Any) -> Any:
    theta = row.theta + value if row.kind == "R" else row.theta
    d = row.d if row.kind == "R" else row.d + value
    c, s = casadi.cos(theta), casadi.sin(theta)
    # A twist of a quarter turn has the exact cosine 0.
    ca, sa = (round(x) if abs(x - round(x)) < 1e-15 else x for x in (cos(row.alpha), sin(row.alpha)))
    entries = [[c, -s * ca, s * sa, row.a * c], [s, c * ca, -c * sa, row.a * s], [0, sa, ca, d], [0, 0, 0, 1]]
    return casadi.sparsify(casadi.vertcat(*(casadi.horzcat(*line) for line in entries)))


def generate(arm: Arm, folder: Path) -> None:
    """Write both functions; results are row-major."""
    q = casadi.SX.sym("q", len(arm.rows))
    frames = [casadi.SX.eye(4)]
    for number, row in enumerate(arm.rows):
        frames.append(frames[-1] @ _step(row, q[number]))
    columns = []
    for row, frame in zip(arm.rows, frames, strict=False):
        axis, lever = frame[:3, 2], frames[-1][:3, 3] - frame[:3, 3]
        columns.append(
            casadi.vertcat(casadi.cross(axis, lever), axis) if row.kind == "R" else casadi.vertcat(axis, 0, 0, 0)
        )
    results = {"fk": frames[-1], "jacobian": casadi.horzcat(*columns)}
    os.chdir(folder)
    for function, matrix in results.items():
        name = f"{arm.name}_casadi_{function}"
        # The transpose, for casadi stores columns.
        casadi.Function(name, [q], [casadi.densify(matrix.T)], {"cse": True}).generate(
            f"{name}.c", {"with_header": False}
        )


if __name__ == "__main__":
    generate(ARMS[sys.argv[1]], Path(sys.argv[2]))
