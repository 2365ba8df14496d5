// An arm in numbers: its axes and frames at a posture, and joint vectors moved onto a pose.
//
// A rigid transform is three rows of four numbers. The geometry is that of kinsym/skeleton.py: the home position of
// every axis, and displacements about them.

const UNIT = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]];

const compose = (A, B) => A.map((row) => [0, 1, 2, 3].map(
  (j) => row[0] * B[0][j] + row[1] * B[1][j] + row[2] * B[2][j] + (j === 3 ? row[3] : 0),
));
const column = (A, j) => A.map((row) => row[j]);
const withColumns = (u, v, w, p) => [0, 1, 2].map((i) => [u[i], v[i], w[i], p[i]]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const plus = (a, b, factor = 1) => a.map((value, i) => value + factor * b[i]);
const times = (a, factor) => a.map((value) => value * factor);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const norm = (a) => Math.hypot(...a);

const turnX = (angle) => {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return [[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0]];
};
const turnZ = (angle) => {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return [[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0]];
};
const slide = (x, y, z) => [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z]];

function inverse(A) {
  const p = column(A, 3);
  const rows = [0, 1, 2].map((j) => column(A, j));
  return rows.map((row) => [...row, -dot(row, p)]);
}

const wrapped = (angle) => angle - 2 * Math.PI * Math.ceil((angle - Math.PI) / (2 * Math.PI));
const signOf = (x) => (x < 0 ? -1 : 1);

/** A frame at a point whose z axis has a direction. */
function along(direction, point) {
  const z = times(direction, 1 / norm(direction));
  const sizes = z.map(Math.abs);
  const helper = [0, 0, 0];
  helper[sizes.indexOf(Math.min(...sizes))] = 1;
  const across = plus(helper, z, -dot(helper, z));
  const x = times(across, 1 / norm(across));
  return withColumns(x, cross(z, x), z, point);
}

/** The home position of an arm: frames with z along its axes, and the frames of its table with what carries them. */
function linkage(table) {
  let here = table.base ?? UNIT;
  const axes = [];
  const frames = [{ name: "0", carried: 0, home: here }];
  const moving = table.rows.filter((row) => row.kind !== "fixed");
  if (table.convention === "screw") {
    for (const row of table.rows) axes.push(compose(here, along(row.s, row.s0)));
    if (table.home) here = compose(here, withColumns(...table.home));
  } else {
    table.rows.forEach((row, k) => {
      const [alpha, a, d, theta] = row.cells;
      const link = compose(turnX(alpha), slide(a, 0, 0));
      if (table.convention === "craig") here = compose(here, link);
      if (row.kind !== "fixed") axes.push(row.reversed ? compose(here, turnX(Math.PI)) : here);
      here = compose(compose(here, turnZ(theta)), slide(0, 0, d));
      if (table.convention === "paul") here = compose(here, link);
      frames.push({ name: String(k + 1), carried: axes.length, home: here });
    });
  }
  if (table.convention === "screw" || table.tool) {
    frames.push({ name: "tool", carried: axes.length, home: compose(here, table.tool ?? UNIT) });
  }
  const [start, tip] = [frames[0], frames[frames.length - 1]].map((frame) => column(frame.home, 3));
  const points = [start, ...axes.map((axis) => column(axis, 3)), tip];
  const way = points.slice(1).reduce((sum, point, k) => sum + norm(plus(point, points[k], -1)), 0);
  let size = sizeOf(axes, tip);
  if (table.convention === "screw" || (nearlyParallel(axes) && way > 3 * size)) moveToCorners(axes, start);
  else size = Math.max(size, way);
  return { kinds: moving.map((row) => row.kind), axes, frames, size };
}

/** Whether two axes in a row are parallel but for a small angle, as in the table of a calibrated arm. */
const nearlyParallel = (axes) => axes.slice(1).some((axis, k) => {
  const sine = norm(cross(column(axes[k], 2), column(axis, 2)));
  return sine > 1e-9 && sine < 0.1;
});

const nearest = (axis, point) => {
  const [z, origin] = [column(axis, 2), column(axis, 3)];
  return plus(origin, z, dot(plus(point, origin, -1), z));
};

/** The length of a way from the base along the axes to the tip, 1 if it is zero. */
function sizeOf(axes, tip) {
  let [here, total] = [[0, 0, 0], 0];
  for (const axis of axes) {
    const next = nearest(axis, here);
    total += norm(plus(next, here, -1));
    here = next;
  }
  return total + norm(plus(tip, here, -1)) || 1;
}

/** Put every axis' origin where the common normal with the axis before arrives. */
function moveToCorners(axes, start) {
  let [point, before] = [start, null];
  axes.forEach((axis, k) => {
    const v = column(axis, 2);
    const normal = before ? cross(column(before, 2), v) : [0, 0, 0];
    const square = dot(normal, normal);
    if (square < 0.01) {
      point = nearest(axis, point);
    } else {
      const offset = plus(column(axis, 3), column(before, 3), -1);
      point = plus(column(axis, 3), v, dot(cross(offset, column(before, 2)), normal) / square);
    }
    before = axis;
    axes[k] = withColumns(column(axis, 0), column(axis, 1), v, point);
  });
}

/** Corners of the links, joint frames and the table's frames at a joint vector. */
function postureOf(arm, q) {
  const moved = [UNIT];
  arm.axes.forEach((home, i) => {
    const motion = arm.kinds[i] === "R" ? turnZ(q[i]) : slide(0, 0, q[i]);
    moved.push(compose(moved[i], compose(compose(home, motion), inverse(home))));
  });
  const frames = arm.frames.map((frame) => compose(moved[frame.carried], frame.home));
  const tip = frames[frames.length - 1];
  const arrive = arm.axes.map((axis, i) => column(compose(moved[i], axis), 3));
  const path = [column(frames[0], 3)];
  const joints = arm.axes.map((axis, i) => {
    const before = compose(moved[i], axis);
    const z = column(before, 2);
    const onward = i + 1 < arrive.length ? arrive[i + 1] : column(tip, 3);
    const leave = plus(arrive[i], z, dot(plus(onward, arrive[i], -1), z));
    path.push(arrive[i], leave);
    if (arm.kinds[i] === "P") return before;
    const [x, y] = [0, 1].map((j) => column(compose(moved[i + 1], axis), j));
    return withColumns(x, y, z, times(plus(arrive[i], leave), 0.5));
  });
  path.push(column(tip, 3));
  return { path, joints, frames, tip };
}

/** What the pose of a posture is off in the entries of the task, lengths in units of the arm. */
const missBy = (arm, tip, target, entries) => entries.map(
  ([row, j]) => (tip[row][j] - target[row][j]) / (j === 3 ? arm.size : 1),
);

/** How these entries change with every joint that may move, joint by joint. */
function changes(arm, posture, entries, still) {
  return posture.joints.map((joint, i) => {
    const z = column(joint, 2);
    return entries.map(([row, j]) => {
      if (still.includes(i)) return 0;
      if (arm.kinds[i] === "P") return j === 3 ? z[row] / arm.size : 0;
      if (j < 3) return cross(z, column(posture.tip, j))[row];
      return cross(z, plus(column(posture.tip, 3), column(joint, 3), -1))[row] / arm.size;
    });
  });
}

/** The solution of A x = b for a symmetric positive matrix (Gauss). */
function solved(A, b) {
  const rows = A.map((row, i) => [...row, b[i]]);
  const n = rows.length;
  for (let i = 0; i < n; i += 1) {
    for (let k = i + 1; k < n; k += 1) {
      const factor = rows[k][i] / rows[i][i];
      for (let j = i; j <= n; j += 1) rows[k][j] -= factor * rows[i][j];
    }
  }
  for (let i = n - 1; i >= 0; i -= 1) {
    for (let j = i + 1; j < n; j += 1) rows[i][n] -= rows[i][j] * rows[j][n];
    rows[i][n] /= rows[i][i];
  }
  return rows.map((row) => row[n]);
}

/**
 * A joint vector moved onto a pose by least squares, damped by the square of the distance that is left; null where it
 * stays more than 1e-9 off.
 */
function polished(arm, start, target, entries, still) {
  let q = [...start];
  let best = Infinity;
  for (let step = 0; step < 40; step += 1) {
    const posture = postureOf(arm, q);
    const off = missBy(arm, posture.tip, target, entries);
    const distance = Math.max(...off.map(Math.abs));
    if (!Number.isFinite(distance)) return null;
    best = distance;
    if (distance < 1e-14) break;
    const columns = changes(arm, posture, entries, still);
    const scalar = (a, b) => a.reduce((sum, value, i) => sum + value * b[i], 0);
    const damping = Math.min(1e-3, distance * distance) + 1e-24;
    const normal = columns.map((a, i) => columns.map((b, j) => scalar(a, b) + (i === j ? damping : 0)));
    const move = solved(normal, columns.map((a) => -scalar(a, off)));
    const scale = (i) => (arm.kinds[i] === "P" ? arm.size : 1);
    const length = Math.max(...move.map((value, i) => Math.abs(value) / scale(i)));
    if (length < 1e-15) break;
    q = q.map((value, i) => value + move[i] * Math.min(1, 0.3 / length));
  }
  return best <= 1e-9 ? q.map((value, i) => (arm.kinds[i] === "R" ? wrapped(value) : value)) : null;
}

/** Whether two joint vectors are the same posture, whole turns aside. */
const alike = (arm, first, second, width) => first.every((value, i) => {
  const apart = value - second[i];
  return Math.abs(arm.kinds[i] === "R" ? wrapped(apart) : apart / arm.size) <= width;
});

/**
 * All solutions of a pose, in the order of their branches; `found` are joint vectors next to them. Those that are next
 * to the pose already come first, so that a stray one cannot take the place of another's solution.
 */
function solutionsAt(arm, target, found, entries, still) {
  const solutions = [];
  const missed = found.map((each) => {
    const off = missBy(arm, postureOf(arm, each.q).tip, target, entries);
    return { ...each, off: Math.max(...off.map(Math.abs)) };
  });
  missed.sort((first, second) => first.off - second.off);
  for (const { branch, q } of missed) {
    const exact = polished(arm, q, target, entries, still);
    if (exact && !solutions.some((other) => alike(arm, other.q, exact, 1e-6))) {
      solutions.push({ branch, q: exact });
    }
  }
  return solutions.sort((first, second) => first.branch - second.branch);
}
