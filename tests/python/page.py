"""The live page in a real browser, for tests and benches. Needs Debian's `chromium` and `chromium-driver`."""

import time
from collections.abc import Callable
from pathlib import Path

from conftest import PACKAGE
from selenium import webdriver
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.actions import interaction
from selenium.webdriver.common.actions.pointer_input import PointerInput
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.remote.webelement import WebElement
from selenium.webdriver.support.ui import Select, WebDriverWait

SHOTS = PACKAGE / "target" / "live"
LAPTOP = (1366, 768)
PHONE = (390, 844)

# `solver.status` where inputs have no answer.
NOT_SOLVED = 3

# Time that the slowest thing a test waits for may take on a loaded machine without a graphics card, s.
PATIENCE = 180


class Page:
    """The page in a browser."""

    def __init__(self, file: Path, folder: Path, size: tuple[int, int] = LAPTOP, more: str = "") -> None:
        options = webdriver.ChromeOptions()
        options.binary_location = "/usr/bin/chromium"
        # No graphics card, no network: only what is in the file can be shown.
        for flag in (
            "--headless=new",
            "--no-sandbox",
            "--use-angle=swiftshader",
            "--enable-unsafe-swiftshader",
            "--host-resolver-rules=MAP * ~NOTFOUND",
        ):
            options.add_argument(flag)
        if size == PHONE:
            metrics = {"width": size[0], "height": size[1], "pixelRatio": 2.0, "touch": True}
            options.add_experimental_option("mobileEmulation", {"deviceMetrics": metrics})
        else:
            options.add_argument(f"--window-size={size[0]},{size[1]}")
        options.add_experimental_option("prefs", {"download.default_directory": str(folder)})
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        service = webdriver.ChromeService("/usr/bin/chromedriver")
        self.browser = webdriver.Chrome(options=options, service=service)
        self.browser.set_script_timeout(PATIENCE)
        self.downloads = folder
        self.browser.get(file.as_uri() + more)
        self.ready = self.browser.execute_async_script("window.mcm.ready.then(arguments[0])")

    def state(self) -> dict:
        """What the page shows, SI."""
        return self.browser.execute_script("return window.mcm.state()")

    def until(self, what: str, holds: Callable[[dict], bool]) -> dict:
        """Waits until it holds; the state then."""
        end = time.monotonic() + PATIENCE
        while not holds(state := self.state()):
            assert time.monotonic() < end, f"{what}: {shortened(state)}; {self.text('banners')}"
            time.sleep(0.05)
        return state

    def at_rest(self) -> dict:
        """Waits until the model that is asked for has answered the inputs of now, with the margin measured."""

        def rests(state: dict) -> bool:
            last = state["measured"] or state["status"] == NOT_SOLVED
            return state["status"] >= 0 and not state["busy"] and state["final"] and last

        return self.until("at rest", rests)

    def find(self, name: str) -> WebElement:
        """The element with this id."""
        return self.browser.find_element(By.ID, name)

    def text(self, name: str) -> str:
        """What an element shows."""
        return self.find(name).text

    def press(self, name: str) -> None:
        """Presses a button, wherever it is scrolled to, and in whatever part of the panel."""
        open_and_scroll = """
            for (let each = arguments[0]; each !== null; each = each.parentElement) {
                each.toggleAttribute("open", each.tagName === "DETAILS" || each.hasAttribute("open"));
            }
            arguments[0].scrollIntoView({ block: "center" });
        """
        self.browser.execute_script(open_and_scroll, self.find(name))
        self.find(name).click()

    def enter(self, rows: str, row: int, text: str) -> None:
        """Types a number into one of the rows of a part of the panel, wherever it is scrolled to."""
        field = self.find(rows).find_elements(By.CSS_SELECTOR, "input[type=number]")[row]
        self.browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", field)
        field.clear()
        field.send_keys(text, Keys.ENTER)

    def drag(self, moves: int, pointer: str = interaction.POINTER_MOUSE) -> None:
        """Drags the magnet by the middle of its gizmo, by mouse or finger, upwards to the right and back."""
        x, y = self.browser.execute_script("return window.mcm.magnetOnScreen()")
        view = self.find("view")
        device = PointerInput(pointer, "pointer")
        drag = ActionChains(self.browser, duration=30, devices=[device])
        drag.move_to_element_with_offset(
            view, int(x - view.size["width"] / 2), int(y - view.size["height"] / 2)
        )
        drag.click_and_hold()
        for move in range(moves):
            drag.move_by_offset(*((3, -4) if move < 12 else (-3, 4) if move < 24 else (2, 0)))
        drag.release().perform()

    def choose(self, name: str) -> dict:
        """Opens a scene of the menu; its first answer."""
        Select(self.find("preset")).select_by_value(name)
        time.sleep(0.2)
        return self.at_rest()

    def write(self, scene: str) -> None:
        """Puts a text into the editor, as by typing, and applies it."""
        set_text = """
            const text = document.getElementById("scene-text");
            text.value = arguments[0];
            text.dispatchEvent(new Event("input", { bubbles: true }));
        """
        self.browser.execute_script(set_text, scene)
        self.browser.execute_script("document.getElementById('scene-apply').click()")

    def saved(self, button: str, name: str) -> Path:
        """The file that a button gives away."""
        file = self.downloads / name
        file.unlink(missing_ok=True)
        self.press(button)
        WebDriverWait(self.browser, PATIENCE).until(lambda _: file.exists() and file.stat().st_size > 0)
        return file

    def shot(self, name: str) -> None:
        """Leaves a screenshot."""
        SHOTS.mkdir(parents=True, exist_ok=True)
        time.sleep(0.3)
        self.browser.save_screenshot(SHOTS / f"{name}.png")

    def complaints(self) -> list[str]:
        """What the browser's console has been told."""
        driver_notes = ("GPU stall", "swiftshader", "WebGL-0x")
        told = [entry["message"] for entry in self.browser.get_log("browser")]
        return [line for line in told if not any(note in line for note in driver_notes)]


def shortened(state: dict) -> dict:
    """A state without its many numbers."""
    return {key: value for key, value in state.items() if key not in ("inputs", "outputs")}
