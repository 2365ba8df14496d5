// The parts of the page that move: sliders, the picture, the table of solutions, copying, the theme.

const data = JSON.parse(document.getElementById("robot").textContent);
const element = (id) => document.getElementById(id);
const [picture, poseTable, solutionTable] = [element("picture"), element("pose"), element("solutions")];
const closedForm = data.solutions === null;

const state = { q: [...data.q], given: [...data.given], view: { ...data.view }, solutions: [] };
let arm = linkage(tableOf(state.given));
const firstPose = postureOf(arm, state.q).tip;

const minus = (text) => text.replace("-", "−");
const rounded = (value, places) => minus((Number(value.toFixed(places)) + 0).toFixed(places));

/** All solutions at the pose of the arm; those of the first pose where there is no closed form. */
function solutionsNow(tip) {
  if (closedForm) return solutionsAt(arm, tip, candidates(tip, state.q, state.given), data.entries, data.still);
  const off = Math.max(...missBy(arm, tip, firstPose, data.entries).map(Math.abs));
  return off < 1e-6 ? data.solutions : [];
}

function showPicture(posture) {
  const others = state.solutions
    .filter((solution) => !alike(arm, solution.q, state.q, 1e-6))
    .map((solution) => ({ number: solution.branch, path: postureOf(arm, solution.q).path }));
  picture.innerHTML = drawing(arm, posture, element("ghosts").checked ? others : [], state.view);
  picture.classList.toggle("bare", !element("frames").checked);
  element("grid").textContent = String(gridStep(state.view));
}

function showPose(tip) {
  const rows = [...tip, [0, 0, 0, 1]];
  poseTable.querySelectorAll("tbody tr").forEach((row, i) => [...row.cells].forEach((cell, j) => {
    cell.textContent = rounded(rows[i][j], 4);
    cell.dataset.value = rows[i][j];
  }));
}

/** Whether a joint value lies outside the limits, whatever whole turns are added to an angle. */
function isBeyond(i, value) {
  if (data.limits[i] === null) return false;
  const [low, high] = [data.limits[i][0] - 1e-9, data.limits[i][1] + 1e-9];
  const turns = arm.kinds[i] === "R" ? Math.ceil((low - value) / (2 * Math.PI)) : 0;
  const wound = value + 2 * Math.PI * turns;
  return wound < low || wound > high;
}

function showSolutions() {
  let shown = 0;
  for (const row of solutionTable.tBodies[0].rows) {
    const branch = Number(row.dataset.branch);
    const solution = (closedForm ? state.solutions : data.solutions).find((each) => each.branch === branch);
    const current = solution !== undefined && alike(arm, solution.q, state.q, 1e-6);
    if (current) shown = branch + 1;
    row.classList.toggle("current", current);
    const button = row.querySelector("button");
    button.disabled = solution === undefined;
    button.setAttribute("aria-pressed", String(current));
    row.querySelectorAll(".value").forEach((cell, i) => {
      const value = solution?.q[i];
      const angle = arm.kinds[i] === "R";
      cell.classList.toggle("beyond", solution !== undefined && isBeyond(i, value));
      cell.textContent = solution ? (angle ? `${rounded(value * 180 / Math.PI, 2)}°` : rounded(value, 4)) : "";
    });
  }
  const count = state.solutions.length;
  const solutions = `${count} solution${count === 1 ? "" : "s"} at this pose`;
  const nothing = "The arm has left the first pose; a number brings it back.";
  element("status").textContent = !closedForm && count === 0 ? nothing : shown ? `${solutions}; the arm shows number ${shown}.` : `${solutions}.`;
}

function showControls() {
  document.querySelectorAll("[data-joint].slider").forEach((slider) => {
    const i = Number(slider.dataset.joint);
    if (arm.kinds[i] === "P") setControl(slider, state.q[i]);
    else setControl(slider, insideOf(slider.querySelector("input"), state.q[i] * 180 / Math.PI));
  });
}

/** An angle in degrees with the whole turns that bring it into the range of its slider, if any do. */
function insideOf(range, angle) {
  const [low, high] = [Number(range.min), Number(range.max)];
  if (angle >= low && angle <= high) return angle;
  const wound = angle + 360 * Math.ceil((low - angle) / 360);
  return wound <= high ? wound : angle;
}

function setControl(slider, value) {
  const [range, number] = slider.querySelectorAll("input");
  if (document.activeElement !== range) range.value = value;
  if (document.activeElement !== number) number.value = Number(value.toFixed(4));
}

/** Show the state; `moved` tells that more changed than the view. */
function show(moved = true) {
  const posture = postureOf(arm, state.q);
  if (moved) {
    state.solutions = solutionsNow(posture.tip);
    showPose(posture.tip);
    showSolutions();
    showControls();
  }
  showPicture(posture);
}

function setJoint(i, value) {
  state.q[i] = arm.kinds[i] === "R" ? value * Math.PI / 180 : value;
  show();
}

function setParameter(i, value, angle) {
  state.given[i] = angle ? value * Math.PI / 180 : value;
  arm = linkage(tableOf(state.given));
  show();
}

document.querySelectorAll(".slider").forEach((slider) => {
  const [range, number] = slider.querySelectorAll("input");
  const angle = slider.querySelector(".unit").textContent !== "";
  const set = (value) => {
    if (slider.dataset.joint === undefined) setParameter(Number(slider.dataset.parameter), value, angle);
    else setJoint(Number(slider.dataset.joint), value);
  };
  range.addEventListener("input", () => {
    number.value = range.value;
    set(Number(range.value));
  });
  number.addEventListener("input", () => {
    if (number.value === "" || !Number.isFinite(Number(number.value))) return;
    range.value = number.value;
    set(Number(number.value));
  });
  const mark = (lit) => {
    picture.dataset.lit = lit ? slider.dataset.joint ?? "" : "";
    picture.querySelector(`.joint[data-joint="${slider.dataset.joint}"]`)?.classList.toggle("lit", lit);
  };
  slider.addEventListener("pointerenter", () => mark(true));
  slider.addEventListener("pointerleave", () => mark(false));
});

element("reset").closest("form").addEventListener("reset", (event) => {
  event.preventDefault();
  [state.q, state.given, state.view] = [[...data.q], [...data.given], { ...data.view }];
  arm = linkage(tableOf(state.given));
  document.querySelectorAll("[data-parameter].slider input").forEach((input) => { input.value = input.defaultValue; });
  show();
});

/** Take the solution of a branch as the posture. */
function take(branch) {
  const solution = (closedForm ? state.solutions : data.solutions).find((each) => each.branch === branch);
  if (!solution) return;
  state.q = solution.q.map((value, i) => (data.still.includes(i) ? state.q[i] : value));
  show();
}

solutionTable.addEventListener("click", (event) => {
  const row = event.target.closest("tr[data-branch]");
  if (row) take(Number(row.dataset.branch));
});
const light = (event, lit) => {
  const branch = event.target.closest("[data-branch]")?.dataset.branch;
  picture.querySelectorAll(".ghost").forEach((line) => line.classList.toggle("lit", lit && line.dataset.branch === branch));
};
solutionTable.addEventListener("pointerover", (event) => light(event, true));
solutionTable.addEventListener("pointerout", (event) => light(event, false));
solutionTable.addEventListener("focusin", (event) => light(event, true));
solutionTable.addEventListener("focusout", (event) => light(event, false));

/** Turn the view by angles in radians, change its size by a factor. */
function turn(azimuth, elevation, factor = 1) {
  const { view } = state;
  view.azimuth += azimuth;
  view.elevation = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, view.elevation + elevation));
  view.scale = Math.max(data.view.scale / 20, Math.min(data.view.scale * 20, view.scale * factor));
  show(false);
}

/** Put all that is drawn into the picture, as large as there is room. */
function fit() {
  const points = [state.q, ...state.solutions.map((solution) => solution.q)].flatMap((q) => postureOf(arm, q).path);
  const axes = viewAxes(state.view);
  const ends = axes.map((axis) => [Math.min, Math.max].map((end) => end(...points.map((point) => dot(point, axis)))));
  const [wide, high] = ends.map(([low, top]) => top - low);
  const middles = ends.map(([low, top]) => (low + top) / 2);
  state.view.centre = [0, 1, 2].map((i) => middles.reduce((sum, middle, k) => sum + middle * axes[k][i], 0));
  const scale = Math.min(FILLED * WIDTH / wide, FILLED * HEIGHT / high);
  if (Number.isFinite(scale)) state.view.scale = scale;
  show(false);
}

const STEP = Math.PI / 24;
const tools = {
  left: () => turn(-STEP, 0),
  right: () => turn(STEP, 0),
  up: () => turn(0, STEP),
  down: () => turn(0, -STEP),
  larger: () => turn(0, 0, 1.15),
  smaller: () => turn(0, 0, 1 / 1.15),
  fit,
};
const keys = { ArrowLeft: "left", ArrowRight: "right", ArrowUp: "up", ArrowDown: "down", "+": "larger", "=": "larger", "-": "smaller", "0": "fit" };
picture.addEventListener("keydown", (event) => {
  if (!(event.key in keys) || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  tools[keys[event.key]]();
});
document.querySelectorAll("[data-tool]").forEach((button) => button.addEventListener("click", tools[button.dataset.tool]));
element("frames").addEventListener("change", () => show(false));
element("ghosts").addEventListener("change", () => show(false));

// One pointer turns, two change the size; a press that does not move takes the solution under it.
const pointers = new Map();
let travelled = 0;
picture.addEventListener("pointerdown", (event) => {
  pointers.set(event.pointerId, event);
  travelled = 0;
  picture.setPointerCapture(event.pointerId);
});
picture.addEventListener("pointermove", (event) => {
  const before = pointers.get(event.pointerId);
  if (!before) return;
  const apart = (first, second) => Math.hypot(first.clientX - second.clientX, first.clientY - second.clientY);
  const [dx, dy] = [event.clientX - before.clientX, event.clientY - before.clientY];
  travelled += Math.hypot(dx, dy);
  const other = [...pointers.values()].find((pointer) => pointer.pointerId !== event.pointerId);
  pointers.set(event.pointerId, event);
  if (other) turn(0, 0, apart(event, other) / Math.max(1, apart(before, other)));
  else if (travelled > 3) turn(-dx / 120, dy / 120);
});
const released = (event) => {
  pointers.delete(event.pointerId);
  if (travelled > 3 || event.type === "pointercancel") return;
  const branch = document.elementFromPoint(event.clientX, event.clientY)?.dataset.branch;
  if (branch !== undefined) take(Number(branch));
};
picture.addEventListener("pointerup", released);
picture.addEventListener("pointercancel", released);
picture.addEventListener("wheel", (event) => {
  if (!event.ctrlKey && document.activeElement !== picture) return;
  event.preventDefault();
  turn(0, 0, Math.exp(-event.deltaY / 500));
}, { passive: false });

document.querySelectorAll(".copy").forEach((button) => button.addEventListener("click", async () => {
  const label = button.firstChild;
  const text = element(button.dataset.copy);
  try {
    await navigator.clipboard.writeText(text.textContent);
    label.data = "Copied";
  } catch {
    getSelection().selectAllChildren(text);
    label.data = "Selected";
  }
  setTimeout(() => { label.data = "Copy"; }, 2000);
}));

const theme = element("theme");
const dark = matchMedia("(prefers-color-scheme: dark)");
function setTheme(isDark) {
  document.documentElement.style.colorScheme = isDark ? "dark" : "light";
  theme.setAttribute("aria-pressed", String(isDark));
}
theme.setAttribute("aria-pressed", String(dark.matches));
dark.addEventListener("change", (event) => setTheme(event.matches));
theme.addEventListener("click", () => setTheme(theme.getAttribute("aria-pressed") !== "true"));
addEventListener("beforeprint", () => document.querySelectorAll("details").forEach((each) => {
  if (!each.open && !each.closest("#code")) [each.open, each.dataset.opened] = [true, ""];
}));
addEventListener("afterprint", () => document.querySelectorAll("[data-opened]").forEach((each) => {
  each.open = false;
  delete each.dataset.opened;
}));

document.querySelectorAll(".needs-script").forEach((each) => { each.hidden = false; });
show();
