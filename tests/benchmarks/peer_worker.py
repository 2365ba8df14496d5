"""Runs one peer library in its own environment: JSON on standard input, JSON on standard output, no kinsym.

In: ``{"peer": ..., "arms": [{"name", "axes", "offsets", "home", "lengths", "poses", "known"}]}``. ``axes`` (n, 3) and
``offsets`` (n + 1, 3) are the joints at zero in the base, ``home`` is the orientation of the end effector there,
``lengths`` are the named parameters of the table, ``known`` is a joint vector of the first pose. Out: for each arm
``{"solutions": [[...], ...]}``, one list a pose, or ``{"refused": why}``.
"""

import json
import sys

import numpy as np

#: OPW's reference pose is upright with all joints about z, y, y, z, y, z: these arms have it as their zero.
UPRIGHT = {
    "staubli_tx2_60": {"b": "d3", "c1": "d1", "c2": "a2", "c3": "d4", "c4": "d6"},
    "mitsubishi_rv4fl": {"a2": "-a3", "c1": "d1", "c2": "a2", "c3": "d4", "c4": "d6"},
    "doosan_m1013": {"b": "d2", "c1": "d1", "c2": "a2", "c3": "d4", "c4": "d6"},
}


class Refused(Exception):
    """The library does not take this arm."""


def eaik(arm):
    from eaik.IK_HP import HPRobot

    robot = HPRobot(np.array(arm["axes"]), np.array(arm["offsets"]))
    if not robot.hasKnownDecomposition():
        raise Refused(robot.getKinematicFamily())
    turn = np.eye(4)
    turn[:3, :3] = np.array(arm["home"]).T

    def solve(pose):
        answer = robot.IK(pose @ turn)
        exact = [q for q, least_squares in zip(answer.Q, answer.is_LS, strict=True) if not least_squares]
        return np.array(exact).reshape(-1, len(arm["axes"])).tolist()

    return solve


def ssik(arm):
    import ssik

    robot = ssik.Manipulator.from_axes(arm["axes"], arm["offsets"])
    turn = np.eye(4)
    turn[:3, :3] = np.array(arm["home"]).T
    return lambda pose: [list(found.q) for found in robot.solve(pose @ turn, respect_limits=False)]


def opw(arm):
    from py_opw_kinematics import KinematicModel, Robot
    from scipy.spatial.transform import RigidTransform

    if arm["name"] not in UPRIGHT:
        raise Refused("not its kind")
    signs = {key: (-1 if name[0] == "-" else 1, name.lstrip("-")) for key, name in UPRIGHT[arm["name"]].items()}
    lengths = {key: sign * arm["lengths"][name] for key, (sign, name) in signs.items()}
    robot = Robot(KinematicModel(**lengths), degrees=False)
    return lambda pose: [list(q) for q in robot.inverse(RigidTransform.from_matrix(pose))]


def ur(arm):
    import ur_analytic_ik

    module = getattr(ur_analytic_ik, arm["name"], None)
    if module is None:
        raise Refused("not its kind")
    if np.abs(module.forward_kinematics(*arm["known"]) - np.array(arm["poses"][0])).max() > 1e-9:
        raise Refused("its lengths differ from the table's")
    return lambda pose: [np.asarray(q).ravel().tolist() for q in module.inverse_kinematics(pose)]


PEERS = {"EAIK": eaik, "ssik": ssik, "OPW": opw, "UR": ur}


def main():
    job = json.load(sys.stdin)
    answers = []
    for arm in job["arms"]:
        try:
            solve = PEERS[job["peer"]](arm)
            answers.append({"solutions": [solve(np.array(pose)) for pose in arm["poses"]]})
        except Refused as why:
            answers.append({"refused": str(why)})
        except Exception as error:  # a library may raise anything
            answers.append({"refused": f"{type(error).__name__}: {error}"})
    json.dump(answers, sys.stdout)


if __name__ == "__main__":
    main()
