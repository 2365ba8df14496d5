"""The page in a headless Chromium: what moves and what is solved there."""

from __future__ import annotations

import json
import math
import re
from typing import Any

import numpy as np
import pytest

from kinsym.emit.source.kernels import KERNELS, kernels_used
from kinsym.emit.source.needs import inverse_needs
from kinsym.page.picture import drawing, view_of
from tests.page.browser import Browser
from tests.page.hands import centre, pose, set_slider
from tests.page.pages import Outline, made

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
