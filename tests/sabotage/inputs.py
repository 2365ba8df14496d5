"""What every function is asked when a mutant is compared with good code: much more, and odder, than the checks ask."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from kinsym.check.answers import MERGED
from kinsym.check.laws import Judge, malformed, outward
from kinsym.check.solvers import Floats, as_float
from kinsym.check.strange import tilted
from kinsym.derivation import Derivation
from kinsym.emit.schedule import Schedule
from tests.stress.measure import PAIR, Stress

#: Poses next to each singular set are a tenth of this.
SPECIAL, RANDOM = 600, 150
#: A general solver takes a thousand times as long for a pose.
GENERAL = 12
SINGLE = 60
ORDINARY, FAR = 12, 8
SLOW_SINGLE, SLOW_ORDINARY = 12, 4
NOISE = (1e-13, 1e-9, 3e-7)
TILTS = (1e-6, 1e-3, 1.0, 2.5)


@dataclass(frozen=True, kw_only=True)
class Inputs:
    """The inputs of one choice of parameters.

    ``T`` (m, 4, 4) are poses, ``q`` (m, n) references for them. ``firm`` (m,) tells where everything is determined;
    elsewhere, if not ``loose`` (m,), it is but for the bands in which roots merge, and where two singularities meet a
    solution must be found. ``noise`` (m,) is how far the entries of a rotation may be off: a pose tells no more than
    that of its solutions.
    ``turned`` (k, n) are joint vectors with many turns. ``limits`` are pairs (n, 2), ``weights`` (n,).
    A ``slow`` solver, one without a closed form, is asked of fewer poses one by one.
    """

    parameters: dict[str, float]
    judge: Judge
    T: Floats
    q: Floats
    firm: np.ndarray
    loose: np.ndarray
    noise: Floats
    turned: Floats
    odd: dict[str, Floats]
    limits: list[Floats]
    weights: list[Floats]
    slow: bool

    @property
    def single(self) -> np.ndarray:
        """The rows that functions for one pose are asked of where each call is slow."""
        rows = np.flatnonzero(~self.loose)
        return rows[np.unique(np.linspace(0, len(rows) - 1, SLOW_SINGLE if self.slow else SINGLE).astype(int))]

    @property
    def ordinary(self) -> np.ndarray:
        """Rows at which rounding decides nothing: the last that are anywhere."""
        return np.arange(len(self.q) - FAR - (SLOW_ORDINARY if self.slow else ORDINARY), len(self.q) - FAR)


def inputs(derivation: Derivation, schedule: Schedule, parameters: Mapping[str, Fraction]) -> Inputs:
    """The inputs of a robot with one choice of its parameters; the same ones each time."""
    stress = Stress(derivation, parameters=parameters)
    rng, n = stress.postures.rng, len(schedule.joints)
    kinds = [] if schedule.general else list(stress.poses(SPECIAL))
    plain = stress.postures.random(GENERAL if schedule.general else RANDOM)
    share = SPECIAL // 10
    poses = [kind.T[:share] for kind in kinds] + [stress.kinematics.forward(plain)]
    vectors = [kind.q[:share] for kind in kinds] + [plain]
    near = [np.where(kind.name == PAIR, -1.0, kind.distance[:share]) for kind in kinds] + [np.full(len(plain), np.inf)]
    noise = np.zeros(sum(map(len, near)) + FAR)
    for size in NOISE:
        noisy = poses[-1][:GENERAL].copy()
        noisy[:, :3, :3] += rng.uniform(-size, size, noisy[:, :3, :3].shape)
        poses.insert(0, noisy)
        vectors.insert(0, plain[: len(noisy)])
        near.insert(0, np.full(len(noisy), np.inf))
        noise = np.concatenate([np.full(len(noisy), size), noise])
    far = outward(poses[-1][:FAR], stress.kinematics.size)
    poses.append(far)
    vectors.append(plain[: len(far)])
    near.append(np.full(len(far), np.inf))
    q = np.concatenate(vectors)
    reach = np.where(stress.postures.revolute, np.pi, stress.postures.reach)
    middle = rng.uniform(-0.5, 0.5, (4, n)) * reach
    width = rng.uniform(0.5, 3.0, (4, n)) * reach
    limits = [np.stack([m - w, m + w], axis=1) for m, w in zip(middle, width, strict=True)]
    limits[1][0] = (-np.inf, np.inf)
    limits[2][-1] = limits[2][-1].mean()
    return Inputs(
        parameters={name: as_float(value) for name, value in parameters.items()},
        judge=stress.judge,
        T=np.concatenate(poses),
        q=q,
        firm=np.concatenate(near) > MERGED,
        loose=np.concatenate(near) < 0.0,
        noise=noise,
        turned=rng.uniform(-1.0, 1.0, (40, n)) * np.logspace(0, 6, 40)[:, None],
        odd=malformed(poses[-2][0])
        | {f"a pose tilted by {angle:g}": tilted(poses[-2][:1], angle)[0] for angle in TILTS},
        limits=limits,
        slow=schedule.general is not None,
        weights=[rng.uniform(0.1, 2.0, n), np.where(np.arange(n) % 2, 0.0, 1.0)],
    )


def broken_parameters(parameters: Mapping[str, float]) -> list[dict[str, float]]:
    """Parameters of which one is no number, infinite or zero."""
    return [{**parameters, name: value} for name in parameters for value in (np.nan, np.inf, 0.0)]


def broken_vectors(good: Floats) -> list[Floats]:
    """References, limits or weights (n, ...) of which one value is no number, infinite or negative."""
    cases = []
    for value in (np.nan, np.inf, -1.0):
        broken: Any = np.array(good, dtype=float)
        broken[-1] = value
        cases.append(broken)
    return cases
