"""Robots as their sources print them, to hold the tables of the gallery against.

URDF: one line a joint with the numbers of the file, ``x y z  roll pitch yaw  ax ay az``, or ``fixed`` for the axis.
Tables: ``alpha a d theta kind`` with the offset in the place of the variable, -R for a joint counted backwards. Nothing
is summed or simplified, but right angles that a file rounds to four or five digits are written as they are meant.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

URDF = {
    "kuka_kr6_r900": """
        0 0 0.400      0 0 0  0 0 -1
        0.025 0 0      0 0 0  0 1 0
        0.455 0 0      0 0 0  0 1 0
        0 0 0.035      0 0 0  -1 0 0
        0.420 0 0      0 0 0  0 1 0
        0.080 0 0      0 0 0  -1 0 0
        0 0 0          0 pi/2 0  fixed""",
    "abb_irb120": """
        0 0 0          0 0 0  0 0 1
        0 0 0.29       0 0 0  0 1 0
        0 0 0.27       0 0 0  0 1 0
        0 0 0.07       0 0 0  1 0 0
        0.302 0 0      0 0 0  0 1 0
        0.072 0 0      0 0 0  1 0 0
        0 0 0          0 0 0  fixed
        0 0 0          0 pi/2 0  fixed""",
    "fanuc_lrmate200id": """
        0 0 0.330      0 0 0  0 0 1
        0.050 0 0      0 0 0  0 1 0
        0 0 0.330      0 0 0  0 -1 0
        0 0 0.035      0 0 0  -1 0 0
        0.335 0 0      0 0 0  0 -1 0
        0.080 0 0      0 0 0  -1 0 0
        0 0 0          pi -pi/2 0  fixed""",
    "staubli_tx2_60": """
        0 0 0.375      0 0 0  0 0 1
        0 0 0          0 0 0  0 1 0
        0 0.02 0.29    0 0 0  0 1 0
        0 0 0          0 0 0  0 0 1
        0 0 0.31       0 0 0  0 1 0
        0 0 0.07       0 0 0  0 0 1
        0 0 0          0 -pi/2 0  fixed
        0 0 0          0 pi/2 0  fixed""",
    "yaskawa_gp7": """
        0 0 0.330      0 0 0  0 0 1
        0.040 0 0      0 0 0  0 1 0
        0 0 0.445      0 0 0  0 -1 0
        0.440 0 0.040  0 0 0  -1 0 0
        0 0 0          0 0 0  0 -1 0
        0 0 0          0 0 0  -1 0 0
        0.080 0 0      3.1415926 -1.570796 0  fixed""",
    "mitsubishi_rv4fl": """
        0 0 0.350      0 0 0  0 0 1
        0 0 0          0 0 0  0 1 0
        0 0 0.310      0 0 0  0 1 0
        -0.050 0 0.335 0 0 0  0 0 1
        0 0 0          0 0 0  0 1 0
        0 0 0.125      0 0 0  0 0 1""",
    "kinova_j2s6s300": """
        0 0 0.15675    0 pi 0  0 0 1
        0 0.0016 -0.11875  -pi/2 0 pi  0 0 1
        0 -0.410 0     0 pi 0  0 0 1
        0 0.2073 -0.0114  -pi/2 0 pi  0 0 1
        0 0 -0.10375   pi/2 0 pi  0 0 1
        0 0.10375 0    -pi/2 0 pi  0 0 1
        0 0 -0.1600    pi 0 pi/2  fixed""",
    "techman_tm5_700": """
        0 0 0.1452     0 0 0  0 0 1
        0 0 0          -1.570796 -1.570796 0  0 0 1
        0.329 0 0      0 0 0  0 0 1
        0.3115 0 -0.1223  0 0 1.570796  0 0 1
        0 -0.106 0     1.570796 0 0  0 0 1
        0 -0.11315 0   1.570796 0 0  0 0 1""",
    "viperx_300s": """
        0 0 0.079      0 0 0  0 0 1
        0 0 0.04805    0 0 0  0 1 0
        0.05955 0 0.3  0 0 0  0 1 0
        0.2 0 0        0 0 0  1 0 0
        0.1 0 0        0 0 0  0 1 0
        0.069744 0 0   0 0 0  1 0 0
        0.042825 0 0   0 0 0  fixed""",
    "hans_elfin5": """
        0 0 0.22       0 0 0  0 0 1
        0 0 0          pi/2 0 0  0 0 1
        0 0.38 0       pi 0 pi/2  0 0 1
        0 0 0          pi/2 0 pi/2  0 0 1
        0 0 0.42       -pi/2 0 0  0 0 1
        0 0 0          pi/2 0 0  0 0 1
        0 0 0.1565     0 0 0  fixed""",
    "aubo_i5": """
        0 0 0.122      0 0 pi  0 0 1
        0 0.1215 0     -pi/2 -pi/2 0  0 0 1
        0.408 0 0      -pi 0 0  0 0 1
        0.376 0 0      pi 0 pi/2  0 0 1
        0 0.1025 0     -pi/2 0 0  0 0 1
        0 -0.094 0     pi/2 0 0  0 0 1""",
    "doosan_m1013": """
        0 0 0.1525     0 0 0  0 0 1
        0 0.0345 0     0 -pi/2 -pi/2  0 0 1
        0.62 0 0       0 0 pi/2  0 0 1
        0 -0.559 0     pi/2 0 0  0 0 1
        0 0 0          -pi/2 0 0  0 0 1
        0 -0.121 0     pi/2 0 0  0 0 1""",
    "niryo_one": """
        0 0 0.103      0 0 0  0 0 1
        0 0 0.08       pi/2 -pi/2 0  0 0 1
        0.21004 0 0    0 0 -pi/2  0 0 1
        0.037 0.032 0  0 pi/2 0  0 0 1
        0 0 0.180      0 -pi/2 0  0 0 1
        0.018 0 0      0 pi/2 0  0 0 1
        0 0 0          -pi/2 -pi/2 0  fixed""",
    "widowx_200": """
        0 0 0.072      0 0 0  0 0 1
        0 0 0.03865    0 0 0  0 1 0
        0.05 0 0.2     0 0 0  0 1 0
        0.2 0 0        0 0 0  0 1 0
        0.065 0 0      0 0 0  1 0 0
        0.043 0 0      0 0 0  fixed""",
    "katana_450": """
        0 0 0.2015     0 0 0  0 0 1
        0 0 0          pi/2 0 0  0 0 1
        0.19 0 0       0 0 0  0 0 1
        0.139 0 0      pi 0 0  0 0 1
        0.1473 0 0     pi/2 0 -pi/2  0 0 1
        0.1505 0 0     0 pi/2 0  fixed""",
    "open_manipulator_x": """
        0.012 0 0.017  0 0 0  0 0 1
        0 0 0.0595     0 0 0  0 1 0
        0.024 0 0.128  0 0 0  0 1 0
        0.124 0 0      0 0 0  0 1 0
        0.126 0 0      0 0 0  fixed""",
    "ufactory_xarm6": """
        0 0 0.267      0 0 0  0 0 1
        0 0 0          -pi/2 0 0  0 0 1
        0.0535 -0.2845 0  0 0 0  0 0 1
        0.0775 0.3425 0  -pi/2 0 0  0 0 1
        0 0 0          pi/2 0 0  0 0 1
        0.076 0.097 0  -pi/2 0 0  0 0 1""",
    "fanuc_crx10ial": """
        0 0 0.245      0 0 0  0 0 1
        0 0 0          0 0 0  0 1 0
        0 0 0.710      0 0 0  0 -1 0
        0 0 0          0 0 0  -1 0 0
        0.540 -0.150 0  0 0 0  0 -1 0
        0.160 0 0      0 0 0  -1 0 0
        0 0 0          pi -pi/2 0  fixed""",
}

TABLES = {
    "abb_irb140": """paul
        -pi/2 0.070 0.352 0 R
        0 0.360 0 0 R
        -pi/2 0 0 0 R
        pi/2 0 0.380 0 R
        -pi/2 0 0 0 R
        0 0 0.065 0 R""",
    "ur3": """paul
        pi/2 0 0.1519 0 R
        0 -0.24365 0 0 R
        0 -0.21325 0 0 R
        pi/2 0 0.11235 0 R
        -pi/2 0 0.08535 0 R
        0 0 0.0819 0 R""",
    "ur10e": """paul
        pi/2 0 0.1807 0 R
        0 -0.6127 0 0 R
        0 -0.57155 0 0 R
        pi/2 0 0.17415 0 R
        -pi/2 0 0.11985 0 R
        0 0 0.11655 0 R""",
    "ur5e": """paul
        pi/2 0 0.1625 0 R
        0 -0.42500 0 0 R
        0 -0.39225 0 0 R
        pi/2 0 0.1333 0 R
        -pi/2 0 0.0997 0 R
        0 0 0.0996 0 R""",
    "adept_cobra600": """paul
        0 0.325 0.387 0 R
        pi 0.275 0 0 R
        0 0 0 0 P
        0 0 0 0 R""",
    "brooks_pf400": """paul
        0 0 0 0 P
        0 0.302 0 0 R
        0 0.289 0 0 R
        0 0.162 0 0 R""",
    "kuka_youbot": """paul
        pi/2 0.033 0.147 0 R
        0 0.155 0 pi/2 R
        0 0.135 0 0 R
        -pi/2 0 0 -pi/2 R
        0 0 0.2175 0 R""",
    "abb_irb6620lx": """paul
        0 0.458 0 0 P
        0 0.975 0 0 R
        pi/2 0.2 0 0 R
        pi/2 0 0.887 0 R
        -pi/2 0 0 0 R
        0 0 0.2 pi R""",
    "stanford_arm": """paul
        -pi/2 0 0.412 0 R
        pi/2 0 0.154 0 R
        0 0.0203 0 -pi/2 P
        -pi/2 0 0 0 R
        pi/2 0 0 0 R
        0 0 0 0 R""",
    "dvrk_psm": """craig
        pi/2 0 0 pi/2 R
        -pi/2 0 0 -pi/2 R
        pi/2 0 -0.4318 0 P
        0 0 0.4162 0 R
        -pi/2 0 0 -pi/2 R
        -pi/2 0.0091 0 -pi/2 R""",
    "raven_2": """craig
        0 0 0 0 R
        75*pi/180 0 0 0 R
        pi-52*pi/180 0 0 pi/2 P
        0 0 -0.47 0 R
        pi/2 0 0 0 R
        pi/2 0.013 0 0 R""",
    "kinova_jaco": """paul
        pi/2 0 0.2755 0 -R
        pi 0.410 0 -pi/2 R
        pi/2 0 -0.0098 pi/2 R
        pi/3 0 -0.250197125 0 R
        pi/3 0 -0.08579425 -pi R
        pi 0 -0.211597125 100*pi/180 R""",
    "franka_panda": """craig
        0 0 0.333 0 R
        -pi/2 0 0 0 R
        pi/2 0 0.316 0 R
        pi/2 0.0825 0 0 R
        -pi/2 -0.0825 0.384 0 R
        pi/2 0 0 0 R
        pi/2 0.088 0.107 0 R""",
    "rethink_sawyer": """paul
        -pi/2 0.081 0.317 0 R
        -pi/2 0 0.1925 0 R
        -pi/2 0 0.400 0 R
        -pi/2 0 0.1685 0 R
        -pi/2 0 0.400 0 R
        -pi/2 0 0.1363 0 R
        0 0 0.13375 0 R""",
    "comau_racer3": """craig
        0 0 0.365 0 -R
        -pi/2 0.050 0 -pi/2 R
        0 0.270 0 -pi/2 -R
        -pi/2 0.050 0.30594 0 -R
        pi/2 0 0 0 R
        -pi/2 0 0.080 pi -R""",
}


def urdf_pose(name: str, q: list[float]) -> Floats:
    """The (4, 4) pose of the last link of a URDF model in the first: a joint turns about its axis after its origin."""
    pose, values = np.eye(4), iter(q)
    for line in URDF[name].split("\n")[1:]:
        cells = [_number(cell) for cell in line.split() if cell != "fixed"]
        pose = pose @ _origin(cells[:3], cells[3:6])
        if len(cells) == 9:
            pose = pose @ _about(np.array(cells[6:]), next(values))
    return pose


def table_pose(name: str, q: list[float]) -> Floats:
    """The (4, 4) pose of a Denavit-Hartenberg table: Paul's Rz Tz Tx Rx or Craig's Rx Tx Rz Tz (lecture 3.2)."""
    convention, *rows = TABLES[name].split("\n")
    pose = np.eye(4)
    for row, value in zip(rows, q, strict=True):
        *cells, kind = row.split()
        alpha, a, d, theta = (_number(cell) for cell in cells)
        turned = theta + {"R": value, "-R": -value, "P": 0.0}[kind]
        about_z = _origin([0, 0, d + (value if kind == "P" else 0.0)], [0, 0, turned])
        about_x = _origin([a, 0, 0], [alpha, 0, 0])
        pose = pose @ (about_z @ about_x if convention == "paul" else about_x @ about_z)
    return pose


def _number(cell: str) -> float:
    value = 0.0
    for term in cell.replace("-", "+-").split("+"):
        if term:
            sign, body = (-1.0, term[1:]) if term.startswith("-") else (1.0, term)
            value += sign * _term(body)
    return value


def _term(body: str) -> float:
    product, _, divisor = body.partition("/")
    factors = [np.pi if factor == "pi" else float(factor) for factor in product.split("*")]
    return float(np.prod(factors)) / (float(divisor) if divisor else 1.0)


def _origin(xyz: list[float], rpy: list[float]) -> Floats:
    """A URDF origin: roll about x, then pitch about y, then yaw about z of the parent."""
    pose = _about(np.array([0, 0, 1.0]), rpy[2]) @ _about(np.array([0, 1.0, 0]), rpy[1])
    pose = pose @ _about(np.array([1.0, 0, 0]), rpy[0])
    pose[:3, 3] = xyz
    return pose


def _about(axis: Floats, angle: float) -> Floats:
    """A turn about a unit axis (Rodrigues)."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    pose = np.eye(4)
    pose[:3, :3] += np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    return pose
