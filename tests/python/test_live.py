"""The live page in a real browser: it opens from a file, follows the mouse, and gives the same numbers as the FMU.

Leaves screenshots in `target/live` for looking at.
"""

import csv
import json
import re
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from conftest import PACKAGE, Archive, Device, run
from page import PATIENCE, PHONE, Page
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.actions import interaction
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.remote.webdriver import WebDriver
from selenium.webdriver.support.ui import Select, WebDriverWait
from test_vessel import SCENE, tube

# Largest difference of tip positions between page and FMU on the same path, m: other sines and cosines, same steps.
SAME_TIP = 1e-9


TIP = [f"tip.position[{k}]" for k in (1, 2, 3)]


def table(file: Path) -> dict[str, np.ndarray]:
    """The columns of a table by name."""
    with file.open(newline="") as lines:
        names, *rows = csv.reader(lines)
    return dict(zip(names, np.array(rows, dtype=float).T, strict=True))


def replayed(archive: Archive, path: dict[str, np.ndarray]) -> np.ndarray:
    """Tip positions of the FMU along a path of inputs, m, a row each."""
    inputs = [name for name in path if name != "time"]
    values = [{name: path[name][row] for name in inputs} for row in range(len(path["time"]))]
    device = Device(archive).start(values[0])
    found = [device.get(TIP)]
    for size, now in zip(np.diff(path["time"]), values[1:], strict=True):
        assert size > 0, "times must grow"
        device.step(size, now)
        found.append(device.get(TIP))
    device.slave.freeInstance()
    return np.array(found)


def furthest(got: np.ndarray, expected: np.ndarray) -> float:
    """Largest distance of tips, m."""
    return float(np.linalg.norm(got - expected, axis=1).max())


def tips(columns: dict[str, np.ndarray]) -> np.ndarray:
    """Tip positions, m, a row each."""
    return np.column_stack([columns[name] for name in TIP])


def test_the_page_is_one_small_file_and_ready_at_once(
    live_page: Path, open_page: Callable[..., Page]
) -> None:
    size = live_page.stat().st_size / 1e6
    said = re.search(r"one HTML file of (\S+) MB", (PACKAGE / "fmu" / "page" / "README.md").read_text())
    assert said is not None
    assert abs(float(said[1]) / size - 1.0) < 0.05, f"{size} MB"
    page = open_page()
    first = page.at_rest()
    assert first["status"] == 0
    assert first["level"] == "auto"
    assert page.find("view").find_element(By.TAG_NAME, "canvas").is_displayed()
    loaded = "return performance.getEntriesByType('resource').map((entry) => entry.name)"
    elsewhere = [
        name for name in page.browser.execute_script(loaded) if not name.startswith(("blob:", "data:"))
    ]
    assert elsewhere == []
    page.shot("demo")
    print(f"core ready after {page.ready:.3f} s, {size:.2f} MB")


def test_the_mouse_moves_the_magnet_and_the_fmu_agrees(
    open_page: Callable[..., Page], default: Archive, tmp_path: Path
) -> None:
    page = open_page()
    start = page.at_rest()
    page.drag(12)
    end = page.until("moved", lambda s: s["inputs"] != start["inputs"] and not s["busy"] and s["final"])
    moved = [
        end["inputs"][f"magnet.position[{k}]"] - start["inputs"][f"magnet.position[{k}]"] for k in (1, 2, 3)
    ]
    assert np.linalg.norm(moved) > 5e-3, moved
    assert end["outputs"]["tip.angle"] != start["outputs"]["tip.angle"]
    page.shot("dragged")

    path = table(page.saved("save-path", "mcm_path.csv"))
    results = table(page.saved("save-results", "mcm_results.csv"))
    shown = np.array([[end["outputs"][name] for name in TIP]])
    assert furthest(tips(results)[-1:], shown) == 0.0
    got = replayed(default, path)
    assert furthest(got, tips(results)) < SAME_TIP
    print(f"{len(got)} rows, tips of page and FMU apart by {furthest(got, tips(results)):.1e} m")

    # The same table through the command line.
    done = run(
        "follow",
        PACKAGE / "fmu" / "default.toml",
        "--inputs",
        tmp_path / "mcm_path.csv",
        "--out",
        tmp_path / "f.csv",
    )
    assert done.returncode == 0, done.stderr
    with (tmp_path / "f.csv").open(newline="") as lines:
        rows = [[1e-3 * float(row[f"tip_{axis}_mm"]) for axis in "xyz"] for row in csv.DictReader(lines)]
    assert furthest(np.array(rows), tips(results)) < SAME_TIP


def test_a_snap_is_shown_and_replayed(open_page: Callable[..., Page], pack: Callable[..., Archive]) -> None:
    page = open_page()
    page.choose("hysteresis")
    page.press("play")
    warned = page.until("a warning ahead", lambda _: "snaps within" in page.text("banners"))
    assert warned["snaps"] == 0
    page.shot("before the snap")
    page.until("a snap", lambda s: s["snaps"] >= 1)
    assert "snap" in page.text("banners").lower()
    page.shot("snapped")
    page.until("both snaps and the end", lambda s: s["snaps"] == 2 and "was played" in page.text("banners"))
    path = table(page.saved("save-path", "mcm_path.csv"))
    results = table(page.saved("save-results", "mcm_results.csv"))
    assert results["stability.snaps"].max() == 2
    scene = page.browser.execute_script("return document.getElementById('scene-text').value")
    got = replayed(pack(scene), path)
    assert furthest(got, tips(results)) < SAME_TIP
    page.press("replay")
    page.until("replay", lambda _: "Replay was played" in page.text("banners"))
    apart = page.text("banners").partition("at most ")[2].partition(" mm")[0]
    assert float(apart) < 1e3 * SAME_TIP
    page.shot("replayed")


def test_a_bad_scene_is_told_line_by_line_and_the_device_goes_on(
    open_page: Callable[..., Page], solve: Callable[..., dict]
) -> None:
    page = open_page()
    before = page.at_rest()
    for scene, said in [
        ("[design]\nsegmnts = 3\n[field]\nuniform_mt = [0, 1]\n", ["line 2", "`segments`?", "line 4"]),
        ("[design]\nsegments = 0\n", ["line 2", "from 1 to 64"]),
        ("this is no scene", ["line 1"]),
        ("[vessel]\nmesh_stl = 'aorta.stl'", ["fmu/live --scene"]),
        ("[design]\nsegments = 1\n[design.helix]\nlength_mm = nan\n", ["length_mm", "finite"]),
    ]:
        page.write(scene)
        page.until(
            scene, lambda s, said=said: all(any(word in line for line in s["faults"]) for word in said)
        )
        assert page.state()["outputs"] == before["outputs"]
        shown = page.find("scene-faults").get_property("textContent")
        assert all(word.lower() in shown.lower() for word in said), shown
    page.browser.execute_script("document.getElementById('scene-section').open = true")
    page.browser.execute_script("document.getElementById('scene-faults').scrollIntoView({ block: 'end' })")
    page.shot("bad scene")
    sound = "[design]\nsegments = 1\n[field]\nuniform_mt = [0, 20, 0]\n[model]\ninteraction = 'none'\n"
    page.write(sound)
    page.until("a sound scene", lambda s: not s["faults"] and s["level"] == "none" and not s["busy"])
    assert page.state()["outputs"]["tip.angle"] == pytest.approx(solve(sound)["alpha_rad"], rel=1e-9)


def test_a_scene_is_opened_while_the_magnet_moves(open_page: Callable[..., Page]) -> None:
    page = open_page()
    page.at_rest()
    for preset, place in [("hysteresis", -0.04), ("demo", 0.023), ("hysteresis", -0.04)]:
        page.drag(20)
        state = page.choose(preset)
        assert state["inputs"]["magnet.position[3]"] == pytest.approx(place)
        assert state["snaps"] == 0
    # A point of the path that falls due while another scene is being opened is not a step of that one.
    for preset in ("aorta", "fig-7b"):
        page.choose("hysteresis")
        page.press("play")
        page.until("played", lambda s: s["inputs"]["magnet.position[3]"] > -0.0395)
        opened = page.choose(preset)
        assert opened["status"] == 0
        assert "stopped" in page.text("banners")
    assert opened["outputs"]["tip.angle"] > 1.0


def test_a_pose_without_an_answer_keeps_the_shape_and_is_left_again(open_page: Callable[..., Page]) -> None:
    page = open_page()
    before = page.at_rest()
    field = page.find("magnet-rows").find_elements(By.CSS_SELECTOR, "input[type=number]")[1]
    field.clear()
    field.send_keys("0", Keys.ENTER)
    lost = page.until("no answer", lambda s: s["status"] == 3 and not s["busy"])
    assert lost["outputs"]["tip.position[2]"] == pytest.approx(before["outputs"]["tip.position[2]"], abs=2e-2)
    assert "Load anew" in page.text("banners")
    page.shot("not solved")
    field.clear()
    field.send_keys("-120", Keys.ENTER)
    page.until("back", lambda s: s["status"] == 0 and not s["busy"])
    assert "Load anew" not in page.text("banners")


def settled_address(page: Page) -> str:
    """The address with a state, once it has not changed for much longer than the page waits before it writes it."""

    def settled(browser: WebDriver) -> str | bool:
        address = browser.current_url
        time.sleep(3.0)
        return address if "#" in address and browser.current_url == address else False

    return WebDriverWait(page.browser, PATIENCE).until(settled)


def test_keys_move_the_magnet_and_the_link_brings_the_state_back(open_page: Callable[..., Page]) -> None:
    page = open_page()
    page.at_rest()
    page.find("view").click()
    keys = ActionChains(page.browser)
    keys.send_keys(Keys.ARROW_UP * 3).perform()
    end = page.until(
        "keys", lambda s: abs(s["inputs"]["magnet.position[2]"] + 0.117) < 1e-12 and not s["busy"]
    )
    # The address may still be that of the state before the keys: it follows once nothing has changed for a while.
    link = "#" + settled_address(page).partition("#")[2]
    again = open_page(more=link)
    state = again.at_rest()
    assert state["inputs"] == end["inputs"]
    assert state["outputs"]["tip.angle"] == pytest.approx(end["outputs"]["tip.angle"], abs=1e-4)
    broken = open_page(more="#v1.broken")
    assert broken.at_rest()["status"] == 0
    assert broken.text("banners") != ""


def test_it_fits_a_phone(open_page: Callable[..., Page]) -> None:
    page = open_page(PHONE)
    page.at_rest()
    wide = page.browser.execute_script("return document.documentElement.scrollWidth")
    assert wide <= PHONE[0]
    canvas = page.find("view").size
    assert canvas["height"] > 200
    small = """
        return [...document.querySelectorAll("button, select, input[type=range]")]
            .filter((each) => each.checkVisibility())
            .filter((each) => each.getBoundingClientRect().height < 32)
            .map((each) => each.id || each.textContent);
    """
    assert page.browser.execute_script(small) == []
    page.shot("phone")
    before = page.state()["inputs"]
    page.drag(12, interaction.POINTER_TOUCH)
    page.until("a finger moves it", lambda s: s["inputs"] != before and not s["busy"])


def test_every_control_has_a_name(open_page: Callable[..., Page]) -> None:
    page = open_page()
    page.at_rest()
    nameless = """
        return [...document.querySelectorAll("button, select, input, textarea")]
            .filter((each) => !(each.labels?.length || each.ariaLabel || each.textContent.trim() || each.title
                || each.getAttribute("aria-labelledby") || each.hidden || each.type === "file"))
            .map((each) => each.outerHTML);
    """
    assert page.browser.execute_script(nameless) == []
    page.browser.execute_script("document.getElementById('theme').click()")
    page.shot("other colours")


def test_the_aorta_is_the_program_s(open_page: Callable[..., Page]) -> None:
    printed = run("init", "--vessel", "aorta").stdout
    assert (PACKAGE / "fmu" / "page" / "src" / "panel" / "aorta.toml").read_text() == printed
    page = open_page()
    state = page.choose("aorta")
    assert state["status"] == 0
    assert "feed.length" in state["outputs"]
    page.shot("aorta")


def test_shape_and_picture_can_be_taken_along(open_page: Callable[..., Page]) -> None:
    page = open_page()
    page.at_rest()
    shape = page.saved("save-shape", "mcm.glb").read_bytes()
    assert shape[:4] == b"glTF"
    length = int.from_bytes(shape[12:16], "little")
    assert json.loads(shape[20 : 20 + length])["meshes"]
    picture = page.saved("save-picture", "mcm.png").read_bytes()
    assert picture[:8] == b"\x89PNG\r\n\x1a\n"


def test_a_page_is_built_with_a_scene_and_its_mesh(tmp_path: Path, pack: Callable[..., Archive]) -> None:
    (tmp_path / "tube.stl").write_bytes(tube(2.2, -20.0, 40.0))
    (tmp_path / "mine.toml").write_text(SCENE.format(mesh="tube.stl"))
    built = subprocess.run(
        [PACKAGE / "fmu" / "live", "--scene", tmp_path / "mine.toml", "--out", tmp_path / "mine.html"],
        capture_output=True,
        text=True,
        check=False,
        timeout=900,
    )
    assert built.returncode == 0, built.stderr
    page = Page(tmp_path / "mine.html", tmp_path)
    assert page.at_rest()["status"] == 0
    assert Select(page.find("preset")).first_selected_option.text == "mine.toml"
    field = page.find("field-rows").find_elements(By.CSS_SELECTOR, "input[type=number]")[1]
    field.clear()
    field.send_keys("12", Keys.ENTER)
    pressed = page.until("pressed", lambda s: s["outputs"]["contact.force[2]"] < -1e-3 and not s["busy"])
    page.shot("mesh")
    path = table(page.saved("save-path", "mcm_path.csv"))
    got = replayed(pack(SCENE.format(mesh=(tmp_path / "tube.stl").as_posix())), path)
    assert furthest(got[-1:], np.array([[pressed["outputs"][name] for name in TIP]])) < SAME_TIP
    assert page.complaints() == []
    page.browser.quit()


def test_wrong_use_of_the_builder_is_refused(tmp_path: Path) -> None:
    def refused(*arguments: str) -> str:
        done = subprocess.run(
            [PACKAGE / "fmu" / "live", *arguments], cwd=tmp_path, capture_output=True, text=True, check=False
        )
        assert done.returncode == 1
        return done.stderr

    assert "--scnee is not known" in refused("--scnee", "x")
    assert "there is no scene missing.toml" in refused("--scene", "missing.toml")
    assert "needs a file" in refused("--out")
