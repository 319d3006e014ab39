"""What a link and a saved scene of the live page keep: the inputs, and the branch by the way to it."""

from collections.abc import Callable

import numpy as np
import pytest
from page import Page

TIP = [f"tip.position[{k}]" for k in (1, 2, 3)]


def place_magnet(page: Page, z: float) -> dict:
    """Types a place of the magnet along the device, mm; the answer there."""
    page.enter("magnet-rows", 2, str(z))
    return page.until(
        f"at {z} mm",
        lambda s: abs(s["inputs"]["magnet.position[3]"] - 1e-3 * z) < 1e-9 and s["final"] and not s["busy"],
    )


def tip(state: dict) -> np.ndarray:
    """The tip, m."""
    return np.array([state["outputs"][name] for name in TIP])


def copied(page: Page) -> str:
    """The link that the button makes, as the part of the address behind the file."""
    page.press("copy-link")
    page.until("a link", lambda _: "link is" in page.text("banners"))
    return "#" + page.browser.current_url.partition("#")[2]


def test_link_and_scene_lead_to_the_same_branch(
    open_page: Callable[..., Page], solve: Callable[..., dict]
) -> None:
    page = open_page()
    page.choose("hysteresis")
    scene = page.browser.execute_script("return document.getElementById('scene-text').value")
    page.write(f"{scene}time_budget_s = 20.0\n")
    page.until("patience", lambda s: not s["busy"] and s["final"] and not s["faults"])
    before = place_magnet(page, -20.5)
    assert before["snaps"] == 0
    assert place_magnet(page, 10)["snaps"] == 1
    here = place_magnet(page, -20.5)
    assert here["snaps"] == 1, "it snaps back at -23 mm only"
    # The same inputs, and two shapes far from each other.
    assert np.linalg.norm(tip(here) - tip(before)) > 0.01
    link = copied(page)
    assert "leads" not in page.text("banners")

    again = open_page(more=link)
    opened = again.at_rest()
    assert opened["inputs"] == pytest.approx(here["inputs"], abs=1e-12)
    assert np.linalg.norm(tip(opened) - tip(here)) < 2e-4
    again.shot("opened by a link")

    text = page.saved("save-scene", "scene.toml").read_text()
    assert "[[start.way]]" in text
    solved = solve(text)
    assert np.linalg.norm(np.array(solved["tip_position_m"]) - tip(here)) < 2e-4
    assert solved["snaps"] == 0
    without = solve("".join(part for part in text.partition("[[start.way]]")[:1]))
    assert np.linalg.norm(np.array(without["tip_position_m"]) - tip(before)) < 2e-4
    # The saved scene opens in the page too, and has nothing more to carry.
    page.write(text)
    page.until(
        "the saved scene", lambda s: not s["faults"] and s["final"] and not s["busy"] and s["snaps"] == 0
    )
    assert np.linalg.norm(tip(page.at_rest()) - tip(here)) < 2e-4


def test_where_the_branch_does_not_care_no_way_is_kept(
    open_page: Callable[..., Page], solve: Callable[..., dict]
) -> None:
    page = open_page()
    page.choose("fig-7a")
    for value in ("12", "18", "15"):
        page.enter("field-rows", 1, value)
        page.until(
            value, lambda s, v=value: s["inputs"]["field.uniform[2]"] == float(v) / 1e3 and not s["busy"]
        )
    end = page.at_rest()
    text = page.saved("save-scene", "scene.toml").read_text()
    assert "start.way" not in text
    assert solve(text)["alpha_rad"] == pytest.approx(end["outputs"]["tip.angle"], abs=1e-3)


def test_a_state_that_cannot_be_kept_is_reported(open_page: Callable[..., Page]) -> None:
    page = open_page()
    page.at_rest()
    page.enter("magnet-rows", 1, "0")
    page.until("no answer", lambda s: s["status"] == 3 and not s["busy"])
    copied(page)
    assert "may lead to another one" in page.text("banners")
