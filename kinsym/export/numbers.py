"""Numbers for files that know no symbols: every parameter must have a value, and decimals hold a whole double."""

from __future__ import annotations

from sympy import Expr, N, Rational, pi

from kinsym.errors import RobotError
from kinsym.robot.expressions import symbol
from kinsym.robot.geometry.frames import DIGITS, Number
from kinsym.robot.model import Robot


def require_numbers(robot: Robot) -> None:
    """RobotError with the parameters that have no value."""
    lacking = [name for name, value in robot.parameters.items() if value is None]
    if lacking:
        one = len(lacking) == 1
        raise RobotError(
            f"the parameter{'' if one else 's'} {', '.join(lacking)} ha{'s' if one else 've'} no value",
            where=robot.name,
            remedy=f"Write numbers under [parameters], or give them with --bind {lacking[0]}=0.4.",
        )


def decimal(value: Number) -> str:
    """The shortest decimal of the nearest double; what 40 digits leave of a zero is 0.

    >>> decimal(1e-31), decimal(0.25), decimal(-2)
    ('0', '0.25', '-2')
    """
    number = float(value)
    if abs(number) < 1e-30:
        return "0"
    return repr(number).removesuffix(".0")


def python_number(cell: Expr | None, robot: Robot) -> str:
    """A cell as Python: a rational multiple of pi as it is, everything else as a decimal; joint variables are 0.

    >>> from kinsym.robot import load
    >>> from sympy import Rational, pi
    >>> python_number(-pi / 2, load("ur5")), python_number(Rational(1, 4), load("ur5"))
    ('-pi / 2', '0.25')
    """
    if cell is None:
        return "0"
    values = {
        symbol(name): Rational(v.numerator, v.denominator) for name, v in robot.parameters.items() if v is not None
    }
    number = cell.xreplace({**values, **{symbol(name): Rational(0) for name in robot.variables}})
    share = (number / pi).expand()
    if isinstance(share, Rational) and share != 0:
        factor = {1: "", -1: "-"}.get(int(share.p), f"{share.p} * ")
        return f"{factor}pi{f' / {share.q}' if share.q != 1 else ''}"
    return decimal(N(number, DIGITS))
