"""The page in a headless Chromium: what moves, what is solved there, who can use it."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kinsym.emit.source.kernels import KERNELS, kernels_used
from kinsym.emit.source.needs import inverse_needs
from kinsym.page.picture import drawing, view_of
from tests.page.browser import Browser
from tests.page.pages import Made, Outline, made

#: Arms that use every kernel: slides, screws, reversed joints, an input, a gate, four roots of one polynomial.
SOLVED = (
    "reversed_axes",
    "planar_rpr",
    "stanford_screw",
    "scorbot_5r",
    "skew_wrist",
    "kuka_iiwa",
    "five_joints",
    "general_3r",
    "slides_between",
)
ENTRIES = [[row, column] for row in range(3) for column in range(4)]


@pytest.fixture
def opened(browser: Browser, tmp_path: Path) -> Any:
    """A function that opens the page of an arm."""

    def open_page(name: str, **options: Any) -> Made:
        page = made(name)
        file = tmp_path / f"{name}.html"
        file.write_text(page.text, encoding="utf-8")
        browser.open(file, **options)
        return page

    return open_page


def pose(browser: Browser) -> np.ndarray:
    """T as it stands on the page, (4, 4), all digits."""
    cells = browser.run('[...document.querySelectorAll("#pose td")].map((cell) => Number(cell.dataset.value))')
    return np.array(cells).reshape(4, 4)


def set_slider(browser: Browser, joint: int, value: float) -> None:
    browser.run(
        f"(() => {{ const range = document.getElementById('joint{joint}'); range.value = {value};"
        " range.dispatchEvent(new Event('input', { bubbles: true })); })()"
    )


def centre(browser: Browser, selector: str) -> tuple[float, float]:
    x, y = browser.run(
        f"(() => {{ const box = document.querySelector({json.dumps(selector)}).getBoundingClientRect();"
        " return [box.x + box.width / 2, box.y + box.height / 2]; })()"
    )
    return x, y


def test_the_arms_of_these_tests_use_every_kernel() -> None:
    used = {rule for name in SOLVED for rule in kernels_used(inverse_needs(made(name).schedule).statements)}
    assert used == {rule for rule, kernel in KERNELS.items() if not kernel.plain}


@pytest.mark.parametrize("name", SOLVED)
def test_the_page_finds_the_solutions_that_numpy_finds(name: str, browser: Browser, opened: Any) -> None:
    page = opened(name)
    arm, shape = page.shown.arm, page.shown.shape
    turning = np.array([kind == "R" for kind in shape.kinds])
    rng = np.random.default_rng(7)
    for _ in range(6):
        q = rng.uniform(-1, 1, len(turning)) * np.where(turning, math.pi, shape.size)
        for place, joint in enumerate(page.schedule.joints):
            if joint.name in page.schedule.locked:
                q[place] = page.shown.q[place]
        found = browser.run(
            f"(() => {{ const q = {json.dumps(q.tolist())}; const {{ tip }} = postureOf(arm, q);"
            " return { tip, all: solutionsAt(arm, tip, candidates(tip, q, state.given), data.entries, data.still) };"
            " })()"
        )
        target = arm.fk(q)
        np.testing.assert_allclose(found["tip"], target[:3], atol=1e-13 * max(1.0, shape.size))
        known = arm.module.solve(target, reference=q, **arm.values, **arm.inputs)
        assert [solution["branch"] for solution in found["all"]] == known.branch.tolist()
        apart = np.array([solution["q"] for solution in found["all"]]) - known.q
        apart[:, turning] -= 2 * math.pi * np.round(apart[:, turning] / (2 * math.pi))
        assert np.abs(apart).max() < 1e-7


@pytest.mark.parametrize("name", ["planar_rr", "kuka_iiwa", "stanford_screw", "skew_screws"])
def test_the_script_draws_what_stands_in_the_page(name: str, browser: Browser, opened: Any) -> None:
    """The picture without JavaScript, and one of another posture, number by number."""
    page = opened(name)
    shape = page.shown.shape
    first = page.text.partition('id="picture"')[2].partition(">")[2].partition("</svg>")[0]
    script = browser.run(
        "drawing(arm, postureOf(arm, data.q), state.solutions.filter((each) => !alike(arm, each.q, data.q, 1e-6))"
        ".map((each) => ({ number: each.branch, path: postureOf(arm, each.q).path })), data.view)"
    )
    assert_same_drawing(script, first)
    q = [0.3 + 0.4 * place for place in range(len(shape.kinds))]
    view = view_of(shape, [shape.at(q).path])
    turned = {"azimuth": 0.7, "elevation": 0.3}
    expected = drawing(shape, shape.at(q), [], type(view)(**{**view.__dict__, **turned}))
    given = json.dumps({**view.__dict__, **turned})
    assert_same_drawing(browser.run(f"drawing(arm, postureOf(arm, {q}), [], {given})"), expected)


def assert_same_drawing(text: str, other: str) -> None:
    number = r"-?\d+(?:\.\d+)?"
    assert re.sub(number, "#", text) == re.sub(number, "#", other)
    values = [np.array(list(map(float, re.findall(number, each)))) for each in (text, other)]
    assert np.abs(values[0] - values[1]).max() <= 1.0 + 1e-9  # turns of ellipses are whole degrees
    assert (np.abs(values[0] - values[1]) > 0.11).sum() <= 2


def test_sliders_move_the_arm(browser: Browser, opened: Any) -> None:
    page = opened("stanford_screw")
    before = browser.run('document.getElementById("picture").innerHTML')
    q = list(page.shown.q)
    np.testing.assert_allclose(pose(browser), page.shown.pose, atol=1e-12)
    set_slider(browser, 0, 20.0)
    q[0] = math.radians(20.0)
    np.testing.assert_allclose(pose(browser), page.shown.arm.fk(np.array(q)), atol=1e-12)
    assert browser.run('document.getElementById("picture").innerHTML') != before
    set_slider(browser, 2, 0.5)
    q[2] = browser.run("state.q[2]")
    np.testing.assert_allclose(pose(browser), page.shown.arm.fk(np.array(q)), atol=1e-12)
    browser.run('document.querySelector("[data-joint=\\"1\\"] [type=number]").focus()')
    browser.run(
        '(() => { const number = document.activeElement; number.value = "33.5";'
        ' number.dispatchEvent(new Event("input", { bubbles: true })); })()'
    )
    q[1] = math.radians(33.5)
    np.testing.assert_allclose(pose(browser), page.shown.arm.fk(np.array(q)), atol=1e-12)
    browser.run('document.getElementById("reset").click()')
    np.testing.assert_allclose(pose(browser), page.shown.pose, atol=1e-12)
    assert browser.complaints() == []


def test_parameters_change_the_arm_and_its_solutions(browser: Browser, opened: Any) -> None:
    page = opened("planar_rr")
    browser.run(
        "(() => { const range = document.getElementById('parameter1'); range.value = 0.35;"
        " range.dispatchEvent(new Event('input', { bubbles: true })); })()"
    )
    values = {**page.shown.arm.values, "l2": 0.35}
    target = page.shown.arm.module.fk(np.array(page.shown.q), **values)
    np.testing.assert_allclose(pose(browser), target, atol=1e-12)
    known = page.shown.arm.module.ik(target, **values)
    np.testing.assert_allclose(browser.run("state.solutions.map((each) => each.q)"), known, atol=1e-9)


@pytest.mark.parametrize("name", ["scorbot_5r", "kuka_iiwa"])
def test_every_branch_shows_the_same_pose(name: str, browser: Browser, opened: Any) -> None:
    page = opened(name)
    first = pose(browser)
    postures = set()
    for solution in page.shown.solutions:
        browser.run(f"document.querySelector('#solutions tr[data-branch=\"{solution.branch}\"] button').click()")
        np.testing.assert_allclose(pose(browser), first, atol=1e-9)
        pressed = browser.run(
            '[...document.querySelectorAll("#solutions [aria-pressed=true]")].map((each) => each.textContent)'
        )
        assert pressed == [str(solution.branch + 1)]
        postures.add(tuple(np.round(browser.run("state.q"), 6)))
    assert len(postures) == len(page.shown.solutions) > 1


def test_values_beyond_the_limits_are_marked(browser: Browser, opened: Any) -> None:
    """As the module's own ``within`` sifts them, before the script runs and after it."""
    page = opened("puma560_limited")
    arm = page.shown.arm
    limits = arm.limits
    for posture in (list(page.shown.q), [0.2, 2.4, 0.4, 0.5, 0.6, 0.7]):
        browser.run(f"(() => {{ state.q = {posture}; show(); }})()")
        inside = arm.module.within(arm.fk(np.array(posture)), reference=np.array(posture), limits=limits).branch
        rows = browser.run(
            "[...document.querySelectorAll('#solutions tbody tr')].filter((row) => row.cells[0].firstChild.disabled ==="
            " false && !row.querySelector('.beyond')).map((row) => Number(row.dataset.branch))"
        )
        assert rows == sorted({int(branch) for branch in inside})
    static = re.findall(r'<tr data-branch="(\d+)"(?:(?!</tr>).)*class="value beyond"', page.text, re.DOTALL)
    first = arm.module.within(page.shown.pose, reference=np.array(page.shown.q), limits=limits).branch
    assert {int(branch) for branch in static} == set(range(8)) - {int(branch) for branch in first}


def test_a_click_on_a_solution_in_the_picture_takes_it(browser: Browser, opened: Any) -> None:
    opened("planar_rr")
    first = pose(browser)
    x, y = browser.run(
        "(() => { const line = document.querySelector('.ghost');"
        " const point = line.getPointAtLength(line.getTotalLength() * 0.25).matrixTransform(line.getScreenCTM());"
        " return [point.x, point.y]; })()"
    )
    branch = browser.run("Number(document.querySelector('.ghost').dataset.branch)")
    browser.drag((x, y), (x, y))
    assert browser.run("document.querySelector('#solutions .current').dataset.branch") == str(branch)
    np.testing.assert_allclose(pose(browser)[:3, 3], first[:3, 3], atol=1e-12)


def test_the_picture_turns_under_the_mouse_and_the_keys(browser: Browser, opened: Any) -> None:
    opened("stanford_screw")
    before = browser.run("({ ...state.view })")
    x, y = centre(browser, "#picture")
    browser.drag((x, y), (x + 60, y + 24))
    after = browser.run("({ ...state.view })")
    assert (after["azimuth"], after["elevation"]) == pytest.approx((before["azimuth"] - 0.5, before["elevation"] + 0.2))
    browser.run('document.getElementById("picture").focus()')
    for key in ("ArrowLeft", "ArrowUp", "+"):
        browser.press(key)
    last = browser.run("({ ...state.view })")
    assert last["azimuth"] < after["azimuth"]
    assert last["elevation"] > after["elevation"]
    assert last["scale"] > after["scale"]
    browser.press("0")
    shown = browser.run("""
        [...document.querySelectorAll(".link")].every((each) => {
          const [a, b] = [each.getBoundingClientRect(), picture.getBoundingClientRect()];
          return a.left > b.left && a.right < b.right && a.top > b.top && a.bottom < b.bottom;
        })
    """)
    assert shown


def test_an_arm_without_a_closed_form_keeps_the_solutions_of_its_first_pose(browser: Browser, opened: Any) -> None:
    page = opened("kinova_jaco")
    assert "polynomialofdegree16" in Outline(page.text).plain()
    assert "function candidates" not in page.text
    assert browser.run("document.querySelectorAll('#solutions tbody tr').length") == len(page.shown.solutions) > 1
    set_slider(browser, 0, 77.0)
    assert browser.run("document.querySelectorAll('.ghost').length") == 0
    assert "left the first pose" in browser.run('document.getElementById("status").textContent')
    last = len(page.shown.solutions) - 1
    browser.run(f"document.querySelector('#solutions tr[data-branch=\"{last}\"] button').click()")
    np.testing.assert_allclose(pose(browser), page.shown.pose, atol=1e-9)
    assert browser.run("document.querySelectorAll('.ghost').length") == last
    assert browser.complaints() == []


@pytest.mark.parametrize("width", [320, 380, 760, 1400])
def test_no_page_is_wider_than_the_window(width: int, browser: Browser, opened: Any) -> None:
    for name in ("kuka_iiwa", "planar_rr"):
        opened(name, width=width)
        browser.run("document.querySelectorAll('details').forEach((each) => { each.open = true; })")
        assert browser.run("document.documentElement.scrollWidth") <= width


def test_the_keyboard_reaches_everything(browser: Browser, opened: Any) -> None:
    opened("planar_rr")
    wanted = set(
        browser.run(
            "[...document.querySelectorAll('a, button, input, summary, #picture')].filter((each) => !each.disabled &&"
            " each.checkVisibility()).map((each, number) => { each.dataset.stop = number; return String(number); })"
        )
    )
    reached: dict[str, bool] = {}
    for _ in range(len(wanted) + 8):
        browser.press("Tab")
        stop, outline = browser.run(
            "[document.activeElement.dataset.stop ?? '', getComputedStyle(document.activeElement).outlineStyle]"
        )
        reached[stop] = outline != "none"
    reached.pop("", None)
    assert set(reached) == wanted
    assert all(reached.values())  # what has the focus is seen to have it
    browser.run('document.getElementById("joint1").focus()')
    before = pose(browser)
    browser.press("ArrowRight")
    assert np.abs(pose(browser) - before).max() > 1e-3
    browser.run("document.querySelector('#solutions button:enabled[aria-pressed=false]').focus()")
    browser.press("Enter")
    assert browser.run("document.activeElement.getAttribute('aria-pressed')") == "true"


def test_every_control_has_a_name(browser: Browser, opened: Any) -> None:
    opened("kuka_iiwa")
    nameless = browser.run(
        "[...document.querySelectorAll('button, input, svg, a')].filter((each) => !(each.getAttribute('aria-label') ||"
        " each.textContent.trim() || [...(each.labels ?? [])].some((label) => label.textContent.trim())))"
        ".map((each) => each.outerHTML)"
    )
    assert nameless == []


@pytest.mark.parametrize("dark", [False, True])
def test_words_stand_out_from_the_paper(dark: bool, browser: Browser, opened: Any) -> None:
    """A contrast of 4.5 or more (WCAG 2.2, criterion 1.4.3)."""
    opened("planar_rr", dark=dark)
    ratios = browser.run("""
        (() => {
          const canvas = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
          const shade = (colour) => {
            canvas.fillStyle = colour;
            canvas.fillRect(0, 0, 1, 1);
            const [r, g, b] = [...canvas.getImageData(0, 0, 1, 1).data].map((each) => each / 255)
              .map((each) => (each <= 0.04045 ? each / 12.92 : ((each + 0.055) / 1.055) ** 2.4));
            return 0.2126 * r + 0.7152 * g + 0.0722 * b;
          };
          const behind = (each) => {
            const own = getComputedStyle(each).backgroundColor;
            return own === "rgba(0, 0, 0, 0)" ? behind(each.parentElement) : own;
          };
          return [...document.querySelectorAll("h1, p, a, td, th, button:enabled, figcaption, label, pre, math, .note")]
            .filter((each) => each.checkVisibility() && !each.closest(".skip")).map((each) => {
              const [one, two] = [shade(getComputedStyle(each).color), shade(behind(each))].sort((a, b) => b - a);
              return [(one + 0.05) / (two + 0.05), each.outerHTML.slice(0, 80)];
            });
        })()
    """)
    assert len(ratios) > 50
    assert [ratio for ratio in ratios if ratio[0] < 4.5] == []


def test_the_theme_can_be_changed(browser: Browser, opened: Any) -> None:
    opened("planar_rr")
    colour = "getComputedStyle(document.body).backgroundColor"
    light = browser.run(colour)
    browser.run('document.getElementById("theme").click()')
    dark = browser.run(colour)
    assert dark != light
    opened("planar_rr", dark=True)
    assert browser.run(colour) == dark
    browser.run('document.getElementById("theme").click()')
    assert browser.run(colour) == light


def test_code_is_copied_or_marked_for_copying(browser: Browser, opened: Any) -> None:
    opened("planar_rr")
    browser.run("document.querySelector('#code summary').click()")
    browser.run(
        "(async () => { const button = document.querySelector('.copy'); button.click();"
        " while (button.textContent.startsWith('Copy ')) await new Promise((done) => setTimeout(done, 10)); })()"
    )
    label = browser.run("document.querySelector('.copy').firstChild.data")
    if label == "Selected":  # where the browser gives no page the clipboard
        assert "print(1 < 2)" in browser.run("getSelection().toString()")
    else:
        assert label == "Copied"


def test_the_page_asks_for_nothing(browser: Browser, opened: Any, tmp_path: Path) -> None:
    opened("scorbot_5r")
    assert browser.complaints() == []
    assert browser.requests() == [(tmp_path / "scorbot_5r.html").resolve().as_uri()]
    refused = browser.run("fetch('https://example.org/').then(() => 'sent', (error) => error.name)")
    assert refused == "TypeError"
    assert any("Content Security Policy" in said for said in browser.complaints())


def test_without_javascript_the_derivation_is_there(browser: Browser, opened: Any) -> None:
    page = opened("stanford_screw", script=False)
    text = browser.run("document.querySelector('main').innerText")
    assert page.derivation.plan is not None
    assert text.count("Solution:") == len(page.derivation.plan.steps)
    assert "Without JavaScript" in text
    assert "Back to the first posture" not in text
    current = "[...document.querySelectorAll('#solutions .current .value')].map((each) => each.textContent)"
    angles = [f"{math.degrees(value):.2f}°".replace("-", "−") for value in page.shown.q[:2]]
    assert browser.run(current)[:2] == angles
    assert browser.run("document.querySelectorAll('#picture .turn').length") == page.shown.shape.kinds.count("R")


def test_the_whole_page_is_for_paper(browser: Browser, opened: Any, tmp_path: Path) -> None:
    opened("planar_rr")
    browser.pdf(tmp_path / "page.pdf")
    assert (tmp_path / "page.pdf").read_bytes().startswith(b"%PDF")
    assert not browser.run("document.querySelector('#forward details').open")  # opened for paper alone
