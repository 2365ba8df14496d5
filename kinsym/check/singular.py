"""Joint vectors at which a motion of the task is lost, found by searching along single joints."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Volume = Callable[[Floats], Floats]

GRID = 96
VANISHES = 1e-9
STEPS = 76


def volume_of(jacobian: Floats) -> Floats:
    """The product of the singular values of (..., m, n) Jacobians: it vanishes where a motion of the task is lost."""
    # The diagonal of the triangular factor has the same product, at a quarter of the time.
    tall = jacobian if jacobian.shape[-2] >= jacobian.shape[-1] else np.swapaxes(jacobian, -1, -2)
    diagonal = np.diagonal(np.linalg.qr(tall, mode="r"), axis1=-2, axis2=-1)
    return np.asarray(np.abs(np.prod(diagonal, axis=-1)), dtype=np.float64)


def zeros(
    base: Floats, revolute: NDArray[np.bool_], reach: float, volume: Volume
) -> tuple[Floats, NDArray[np.intp], NDArray[np.intp]]:
    """Zeros of ``volume`` on lines through ``base`` along single joints: the joint vectors (m, n), the joint
    that was moved for each and its row of ``base``.

    The volume has the shape of |x| at a zero, so a golden-section search reaches it to the last digit.
    """
    n, starts = len(revolute), len(base)
    ends = np.where(revolute, np.pi, reach)
    rows, joints, low, high, tall = [], [], [], [], []
    for joint in range(n):
        grid = np.linspace(-ends[joint], ends[joint], GRID + 1)
        lines = np.repeat(base[:, None, :], GRID + 1, axis=1)
        lines[:, :, joint] = grid
        height = volume(lines.reshape(-1, n)).reshape(starts, GRID + 1)
        inner = (height[:, 1:-1] <= height[:, :-2]) & (height[:, 1:-1] < height[:, 2:])
        for row, column in zip(*np.nonzero(inner), strict=True):
            rows.append(row)
            joints.append(joint)
            low.append(grid[column])
            high.append(grid[column + 2])
            tall.append(height[row].max())
    if not rows:
        return np.empty((0, n)), np.empty(0, dtype=np.intp), np.empty(0, dtype=np.intp)
    start, moved = np.array(rows), np.array(joints)
    line = base[start].copy()
    line[np.arange(len(line)), moved] = _golden(line, moved, np.array(low), np.array(high), volume)
    zero = volume(line) < VANISHES * np.array(tall)
    return line[zero], moved[zero], start[zero]


def _golden(line: Floats, moved: NDArray[np.intp], low: Floats, high: Floats, volume: Volume) -> Floats:
    ratio = (np.sqrt(5.0) - 1) / 2
    rows = np.arange(len(line))

    def height(x: Floats) -> Floats:
        trial = line.copy()
        trial[rows, moved] = x
        return volume(trial)

    # Of the two inner points of an interval one is an inner point of the next.
    left, right = high - ratio * (high - low), low + ratio * (high - low)
    at_left, at_right = height(left), height(right)
    for _ in range(STEPS):
        smaller = at_left < at_right
        low, high = np.where(smaller, low, left), np.where(smaller, right, high)
        new = np.where(smaller, high - ratio * (high - low), low + ratio * (high - low))
        at_new = height(new)
        left, right = np.where(smaller, new, right), np.where(smaller, left, new)
        at_left, at_right = np.where(smaller, at_new, at_right), np.where(smaller, at_left, at_new)
    middle = (low + high) / 2
    quarter = np.round(middle * 2 / np.pi) * np.pi / 2
    return np.where(height(quarter) <= np.maximum(height(middle), 1e-15), quarter, middle)
