"""The exact answer against what the table means: a product of transforms and its derivative, with 50 digits."""

from __future__ import annotations

import numpy as np

from kinsym.check.exact_solver import ExactSolver
from kinsym.check.ledger import Ledger
from kinsym.check.solvers import Floats
from kinsym.check.table import TableKinematics

TABLE = "forward kinematics equal the table's product of transforms, with 50 digits"
DERIVATIVE = "Jacobian equals the derivative of the table's transforms, with 50 digits"
TABLE_LIMIT = 1e-30
SLOPE_LIMIT = 1e-8


def hold_definition(ledger: Ledger, exact: ExactSolver, table: TableKinematics, *, q: Floats, slopes: Floats) -> None:
    """Forward kinematics at the joint vectors ``q`` (m, n), Jacobians at ``slopes`` (k, n)."""
    errors = []
    for joints in q.tolist():
        direct, derived = table.forward(joints), exact.walk.forward(joints)
        far = max(exact.walk.size, 1, *(abs(row[3]) for row in direct[:3]))
        gap = max(abs(direct[i][j] - derived[i][j]) for i in range(3) for j in range(4))
        errors.append(float(gap / far))
    ledger.judge(TABLE, "", np.array(errors), TABLE_LIMIT)
    jacobian = exact.jacobian(slopes)
    wanted = np.array([_differences(table, joints) for joints in slopes.tolist()])
    scale = np.maximum(np.abs(wanted).max(axis=(1, 2)), 1.0)
    ledger.judge(DERIVATIVE, "", np.abs(jacobian - wanted).max(axis=(1, 2)) / scale, SLOPE_LIMIT)


def _differences(table: TableKinematics, q: list[float]) -> Floats:
    """The (6, n) Jacobian by central differences: with 50 digits a step of 1e-17 errs by about 1e-33."""
    ctx = table.ctx
    step = ctx.mpf(10) ** -17
    columns = []
    here = table.forward(q)
    for joint in range(len(q)):
        plus, minus = [ctx.mpf(x) for x in q], [ctx.mpf(x) for x in q]
        plus[joint] += step
        minus[joint] -= step
        after, before = table.forward(plus), table.forward(minus)
        slope = [[(after[i][j] - before[i][j]) / (2 * step) for j in range(4)] for i in range(3)]
        spin = [[sum(slope[i][k] * here[j][k] for k in range(3)) for j in range(3)] for i in range(3)]
        columns.append([slope[0][3], slope[1][3], slope[2][3], spin[2][1], spin[0][2], spin[1][0]])
    return np.array(columns, dtype=np.float64).T
