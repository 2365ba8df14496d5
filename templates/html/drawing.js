// The arm as a drawing: the elements that kinsym/page/picture.py wrote, at any posture and from any side.

const [WIDTH, HEIGHT, COLOURS] = [640, 480, 8];
const [TURN_RADIUS, TURN_HALF, BOX, INNER, OUTER] = [9.5, 12, [9, 9, 15], 24, 44];
const [SHORTEST, EDGE_ON, FILLED] = [1e-6, 0.02, 0.74];

/** The directions to the right, up and towards the viewer. */
function viewAxes({ azimuth, elevation }) {
  const [ca, sa] = [Math.cos(azimuth), Math.sin(azimuth)];
  const [ce, se] = [Math.cos(elevation), Math.sin(elevation)];
  return [[-sa, ca, 0], [-se * ca, -se * sa, ce], [ce * ca, ce * sa, se]];
}

/** Functions from points and directions to the drawing: right, down, near. */
function projection(view) {
  const [right, up, towards] = viewAxes(view);
  return {
    seen(point) {
      const offset = plus(point, view.centre, -1);
      return [WIDTH / 2 + view.scale * dot(offset, right), HEIGHT / 2 - view.scale * dot(offset, up), dot(offset, towards)];
    },
    direction: (way) => [dot(way, right), -dot(way, up), dot(way, towards)],
  };
}

const at = (x, y) => `${x.toFixed(1)} ${y.toFixed(1)}`;
const line = (start, end) => `M${at(start[0], start[1])}L${at(end[0], end[1])}`;
const depth = (start, end) => Number(((start[2] + end[2]) / 2).toFixed(6));

/** The distance of two lines of the floor: 1, 2 or 5 times a power of ten. */
function gridStep(view) {
  const least = 90 / view.scale;
  const power = 10 ** Math.floor(Math.log10(least));
  const factor = [1, 2, 5].find((each) => each * power >= least) ?? 10;
  return Number((factor * power).toPrecision(3));
}

/** The elements of the drawing; `others` are the solutions beside it, each its number and its corners. */
function drawing(arm, posture, others, view) {
  const look = projection(view);
  const solid = [...links(arm, posture, look), ...joints(arm, posture, look)];
  solid.sort((first, second) => first[0] - second[0]);
  const ghosts = others.map((other) => ghost(other, look));
  return [...floor(posture, view, look), ...ghosts, ...solid.map((item) => item[1]), ...frameAxes(posture, look)].join("");
}

function floor(posture, view, look) {
  const [step, count, elements] = [gridStep(view), 6, []];
  const base = column(posture.frames[0], 3);
  for (const [from, across] of [view.plane, [...view.plane].reverse()]) {
    for (let k = -count; k <= count; k += 1) {
      const [start, end] = [[...base], [...base]];
      start[across] += k * step;
      end[across] += k * step;
      start[from] -= count * step;
      end[from] += count * step;
      elements.push(`<path class="floor" d="${line(look.seen(start), look.seen(end))}"/>`);
    }
  }
  return elements;
}

function ghost({ number, path }, look) {
  const points = path.map((point) => at(...look.seen(point).slice(0, 2))).join("L");
  return `<path class="ghost c${number % COLOURS}" data-branch="${number}" d="M${points}"/>`;
}

function links(arm, { path }, look) {
  const items = [];
  for (let k = 0; k + 1 < path.length; k += 1) {
    if (norm(plus(path[k + 1], path[k], -1)) <= SHORTEST * arm.size) continue;
    const [start, end] = [look.seen(path[k]), look.seen(path[k + 1])];
    const sliding = k % 2 === 1 && k < path.length - 2 && arm.kinds[(k - 1) / 2] === "P";
    const [way, name] = [line(start, end), sliding ? "rod" : "link"];
    items.push([depth(start, end), `<path class="edge ${name}" d="${way}"/><path class="${name}" d="${way}"/>`]);
  }
  return items;
}

function joints(arm, posture, look) {
  return posture.joints.map((frame, number) => {
    const middle = look.seen(column(frame, 3));
    const body = arm.kinds[number] === "R" ? cylinder(column(frame, 2), middle, look) : box(frame, middle, look);
    return [depth(middle, middle), `<g class="joint" data-joint="${number}">${body}</g>`];
  });
}

function cylinder(axis, middle, look) {
  const [x, y, near] = look.direction(axis);
  const length = Math.hypot(x, y);
  const [way, across] = length > SHORTEST ? [[x / length, y / length], [-y / length, x / length]] : [[1, 0], [0, 1]];
  const [half, wide, flat] = [TURN_HALF * length, TURN_RADIUS, TURN_RADIUS * Math.abs(near)];
  const turned = Math.round(Math.atan2(across[1], across[0]) * 180 / Math.PI);
  const corner = (end, side) => at(
    middle[0] + end * half * way[0] + side * wide * across[0],
    middle[1] + end * half * way[1] + side * wide * across[1],
  );
  const arc = `A${wide.toFixed(1)} ${flat.toFixed(1)} ${turned} 0 0 `;
  const outline = `M${corner(-1, 1)}L${corner(1, 1)}${arc}${corner(1, -1)}L${corner(-1, -1)}${arc}${corner(-1, 1)}Z`;
  const end = near > 0 ? 1 : -1;
  const place = at(middle[0] + end * half * way[0], middle[1] + end * half * way[1]);
  const cap = `<ellipse class="cap" rx="${wide.toFixed(1)}" ry="${flat.toFixed(1)}" transform="translate(${place})rotate(${turned})"/>`;
  return `<path class="turn" d="${outline}"/>${cap}`;
}

function box(frame, middle, look) {
  const ways = [0, 1, 2].map((axis) => look.direction(column(frame, axis)));
  const faces = [];
  for (let axis = 0; axis < 3; axis += 1) {
    if (Math.abs(ways[axis][2]) <= EDGE_ON) continue;
    const sign = ways[axis][2] > 0 ? 1 : -1;
    const [first, second] = [(axis + 1) % 3, (axis + 2) % 3];
    const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) => {
      const shares = [];
      shares[axis] = sign * BOX[axis];
      shares[first] = a * BOX[first];
      shares[second] = b * BOX[second];
      return at(...[0, 1].map((i) => middle[i] + shares.reduce((sum, share, k) => sum + share * ways[k][i], 0)));
    });
    faces.push(`<path class="slide face${axis}" d="M${corners.join("L")}Z"/>`);
  }
  return faces.join("");
}

function frameAxes(posture, look) {
  return posture.frames.flatMap((frame, number) => {
    const outer = number === 0 || number === posture.frames.length - 1;
    const origin = look.seen(column(frame, 3));
    const length = outer ? OUTER : INNER;
    return ["x", "y", "z"].map((letter, axis) => {
      const [x, y] = look.direction(column(frame, axis));
      const end = [origin[0] + length * x, origin[1] + length * y];
      let element = `<path class="axis ${outer ? "" : "inner "}${letter}" d="${line(origin, end)}"/>`;
      if (outer) {
        const [left, top] = [origin[0] + 1.22 * length * x, origin[1] + 1.22 * length * y];
        element += `<text class="letter ${letter}" x="${left.toFixed(1)}" y="${top.toFixed(1)}">${letter}</text>`;
      }
      return element;
    });
  });
}
