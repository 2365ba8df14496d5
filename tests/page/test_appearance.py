"""The page in a headless Chromium: who can read it and use it, on which window, and what it asks for."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.page.browser import Browser
from tests.page.hands import pose


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
