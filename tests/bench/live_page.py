"""The live page in Chromium: time from opening to ready, times of steps by level beside the FMU, and of frames.

    fmu/live --out target/mcm_live.html
    .venv/bin/python tests/bench/live_page.py target/mcm_live.html --scratch DIR

Both follow the same path: the paper's magnet pair at 120 mm swings by 20 mm along the device in steps of up to 0.5 mm.
Needs `fmu/venv tests/requirements.txt` and Debian's `chromium` and `chromium-driver`.
"""

import argparse
import math
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

PACKAGE = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PACKAGE / "tests" / "python"))

from conftest import Archive, Device, program  # noqa: E402
from page import Page  # noqa: E402

STEPS = 400
TIP = [f"tip.position[{k}]" for k in (1, 2, 3)]

# Runs in the page: a worker of its own follows a path by the model asked for, and gives tips and times of all steps.
FOLLOW = """
const [scene, along, done] = arguments;
const code = new Blob([document.getElementById("worker").textContent], { type: "text/javascript" });
const worker = new Worker(URL.createObjectURL(code));
const found = { cold: 0, costs: [], tips: [] };
let [place, tip] = [0, []];
worker.onmessage = ({ data }) => {
    if (data.kind === "ready") {
        worker.postMessage({ kind: "open", scene, inputs: {} });
    } else if (data.kind === "opened") {
        const at = (of, name) => data.description[of].findIndex((variable) => variable.name === name);
        tip = [1, 2, 3].map((k) => at("outputs", `tip.position[${k}]`));
        place = at("inputs", "magnet.position[3]");
    } else if (data.kind === "answer" && data.answer.first) {
        found.cold = data.answer.cost;
        for (const value of along) {
            const inputs = data.answer.inputs.slice();
            inputs[place] = value;
            worker.postMessage({ kind: "move", inputs, every: true });
        }
    } else if (data.kind === "answer" && data.answer.final && !data.answer.measured) {
        found.costs.push(data.answer.cost);
        found.tips.push(tip.map((each) => data.answer.outputs[each]));
        if (found.costs.length === along.length) {
            worker.terminate();
            done(found);
        }
    }
};
worker.postMessage({ code: document.getElementById("core").textContent.trim(), grid: "" });
"""

# Runs in the page: times of its load event, its first shape and the shape by the model asked for, ms.
OPENING = """
const [done] = arguments;
let first = null;
const look = () => {
    const state = window.mcm?.state();
    first ??= state?.status >= 0 ? performance.now() : null;
    if (first !== null && state.final && !state.busy) {
        done([performance.getEntriesByType("navigation")[0].loadEventEnd, first, performance.now()]);
    } else {
        setTimeout(look, 5);
    }
};
look();
"""

# Runs in the page: times between frames while the magnet is dragged.
FRAMES = """
window.frames_ = [];
let last = performance.now();
const frame = (now) => { window.frames_.push(now - last); last = now; requestAnimationFrame(frame); };
requestAnimationFrame(frame);
"""


def native(scene: str, along: list[float], folder: Path) -> tuple[np.ndarray, np.ndarray]:
    """Times of the FMU's steps, ms, and its tips, m, on the same path."""
    (folder / "scene.toml").write_text(scene)
    packing = [program(), "pack", "--scene", folder / "scene.toml", "--out", folder / "mcm.fmu"]
    subprocess.run(packing, check=True, capture_output=True)
    device = Device(Archive(folder / "mcm.fmu", folder / "unpacked")).start()
    costs, tips = [], []
    for value in along:
        device.set({"magnet.position[3]": value})
        begin = time.perf_counter()
        device.slave.doStep(device.time, 0.01)
        costs.append(1e3 * (time.perf_counter() - begin))
        device.time += 0.01
        tips.append(device.get(TIP))
    device.slave.freeInstance()
    return np.array(costs), np.array(tips)


def row(page: Page, segments: int, level: str, folder: Path) -> str:
    """A row of the table."""
    magnet = "[magnet]\nposition_mm = [0.0, -120.0, 23.0]\norientation_wxyz = [0.0, 1.0, 0.0, 0.0]\n"
    scene = f'[design]\nsegments = {segments}\n{magnet}[model]\ninteraction = "{level}"\n'
    along = [0.023 + 0.02 * math.sin(step / 40) for step in range(1, STEPS + 1)]
    found = page.browser.execute_async_script(FOLLOW, scene, along)
    folder.mkdir()
    costs, tips = native(scene, along, folder)
    own = np.array(found["costs"])
    apart = np.linalg.norm(np.array(found["tips"]) - tips, axis=1).max()
    percentiles = [np.median(own), np.percentile(own, 99), np.median(costs), np.percentile(costs, 99)]
    cells = [f"{value:.2f}" for value in percentiles]
    return f"| {segments} | `{level}` | {found['cold']:.0f} | " + " | ".join(cells) + f" | {apart:.0e} |"


def picture(file: Path, folder: Path) -> None:
    """Leaves the README's picture in `live.png`: the device after its snap."""
    page = Page(file, folder, (1280, 900))
    page.choose("hysteresis")
    page.press("play")
    page.until("a snap", lambda state: state["snaps"] >= 1)
    page.browser.save_screenshot(folder / "live.png")
    page.browser.quit()


def main() -> None:
    """Measures and prints the tables."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("page", type=Path, help="the file that fmu/live has built")
    parser.add_argument("--scratch", type=Path, required=True, help="an empty folder")
    arguments = parser.parse_args()
    file = arguments.page.absolute()
    arguments.scratch.mkdir(parents=True, exist_ok=True)

    page = Page(file, arguments.scratch)
    page.browser.set_script_timeout(300)
    page.at_rest()
    opened = []
    for _ in range(9):  # by a browser that runs already, as a person's does
        page.browser.refresh()
        opened.append(page.browser.execute_async_script(OPENING))
    loaded, first, rest = np.median(np.array(opened), axis=0) / 1e3
    size = file.stat().st_size / 1e6
    print(
        f"{size:.2f} MB: loaded after {loaded:.2f} s, first shape after {first:.2f} s, at rest after {rest:.2f} s\n"
    )

    print(
        "| segments | level | first shape (ms) | step, page (ms): median | 99 % | FMU: median | 99 % | tips apart (m) |"
    )
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for segments in (1, 3, 9):
        for level in ("none", "rings", "full", "auto"):
            print(row(page, segments, level, arguments.scratch / f"{segments}-{level}"), flush=True)

    print()
    for preset in ("demo", "hysteresis", "aorta"):
        page.choose(preset)
        page.browser.execute_script(FRAMES)
        page.drag(60)
        frames = np.array(page.browser.execute_script("return window.frames_.slice(1)"))
        print(
            f"{preset}: frames {np.median(frames):.0f} ms, 99 % {np.percentile(frames, 99):.0f} ms, {len(frames)}"
        )
    page.browser.quit()
    picture(file, arguments.scratch)


if __name__ == "__main__":
    main()
