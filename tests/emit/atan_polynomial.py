"""The polynomial of the generated arc tangent (``templates/c/atan2.c.jinja``), by Remez's exchange algorithm.

``python -m tests.emit.atan_polynomial`` prints the coefficients. On |r| <= tan(pi/8) the angle of the tangent r is
r + r z P(z), z = r^2, and P is the polynomial with the least relative error of that angle. E. Ya. Remez, "Sur la
détermination des polynômes d'approximation de degré donnée", Comm. Soc. Math. Kharkov 10 (1934).
"""

from __future__ import annotations

import mpmath as mp

TERMS = 11
_DIGITS = 50
_GRID = 1000


def least_error_polynomial(terms: int = TERMS) -> tuple[list[float], float]:
    """The coefficients of P, constant first, and the largest relative error."""
    with mp.workdps(_DIGITS):
        top = mp.tan(mp.pi / 8) ** 2
        grid = [_chebyshev(top, mp.mpf(place) / _GRID) for place in range(1, _GRID + 1)]
        wanted = {z: (_target(z), _weight(z)) for z in grid}
        nodes = [grid[round(_GRID * (place + 0.5) / (terms + 1))] for place in range(terms + 1)]
        while True:
            coefficients, level = _levelled([(z, *wanted[z]) for z in nodes])
            errors = [
                ((mp.polyval(coefficients[::-1], z) - target) * weight, z) for z, (target, weight) in wanted.items()
            ]
            extrema = _alternating(errors)[-len(nodes) :]
            largest = max(abs(error) for error, _ in extrema)
            if [z for _, z in extrema] == nodes or largest <= (1 + mp.mpf(10) ** -9) * level:
                return [float(value) for value in coefficients], float(largest)
            nodes = [z for _, z in extrema]


def _chebyshev(top: mp.mpf, share: mp.mpf) -> mp.mpf:
    """A point of (0, top], denser at both ends."""
    return top * (1 - mp.cos(mp.pi * share)) / 2


def _target(z: mp.mpf) -> mp.mpf:
    """What P should be: (atan r / r - 1)/z."""
    r = mp.sqrt(z)
    return (mp.atan(r) / r - 1) / z


def _weight(z: mp.mpf) -> mp.mpf:
    """The relative error of the angle by the error of P."""
    r = mp.sqrt(z)
    return z * r / mp.atan(r)


def _levelled(nodes: list[tuple[mp.mpf, mp.mpf, mp.mpf]]) -> tuple[list[mp.mpf], mp.mpf]:
    """The polynomial whose weighted error has one size and changing signs at the nodes, and that size."""
    size = len(nodes)
    matrix, right = mp.matrix(size, size), mp.matrix(size, 1)
    for row, (z, target, weight) in enumerate(nodes):
        for power in range(size - 1):
            matrix[row, power] = z**power * weight
        matrix[row, size - 1] = (-1) ** row
        right[row] = target * weight
    solved = mp.lu_solve(matrix, right)
    return list(solved[: size - 1]), abs(solved[size - 1])


def _alternating(errors: list[tuple[mp.mpf, mp.mpf]]) -> list[tuple[mp.mpf, mp.mpf]]:
    """The largest error of every stretch of one sign."""
    found = [errors[0]]
    for error in errors[1:]:
        if (error[0] > 0) != (found[-1][0] > 0):
            found.append(error)
        elif abs(error[0]) > abs(found[-1][0]):
            found[-1] = error
    return found


if __name__ == "__main__":
    values, worst = least_error_polynomial()
    print(*values, f"relative error {worst:.2g}", sep="\n")
