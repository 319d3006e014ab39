"""Shows an FMU in a browser: whoever drags the magnet there sees the manipulator bend.

    fmu/venv fmu/examples/requirements.txt
    .venv/bin/python fmu/examples/view_viser.py mcm.fmu

After a step that is not solved the FMU goes back to its state before: shape and magnet stay, and a line says why.
Ctrl-C ends it. `--drive 40` moves the magnet 40 mm along z by itself, a millimetre a step, and ends.
"""

import argparse
import itertools
import time
from contextlib import suppress
from pathlib import Path

import numpy as np
from component import Component
from coupling import INSTALL
from fmpy.fmi1 import FMICallException

try:
    from viser import ViserServer
except ModuleNotFoundError as error:
    raise SystemExit(f"{error}: {INSTALL}") from error

STEP = 0.05  # communication step, s
FEED = 5.0  # the shaft moves no further in a step, mm
INPUTS = ("magnet.position", "magnet.orientation", "field.uniform", "feed.insertion")
STATUS = ["solved", "solved, close to a fold", "solved, snapped in this step"]
OUTCOME = ["", "", "the branch ends", "bodies touch", "out of budget", "wedged by friction"]


def rows(device: Component, array: str | tuple[str, ...], member: str = "", size: int = 3) -> np.ndarray:
    """Values of an array in rows, times 1000: mm of m, mT of T."""
    names = [name for name in device.references if name.startswith(array) and member in name]
    return 1e3 * np.reshape([device.get(name) for name in names], (-1, size))


def view(device: Component, server: ViserServer, drive: int | None) -> None:
    """Steps whenever the browser asks for other inputs."""
    slave, scene, gui, sliders, text = device.slave, server.scene, server.gui, [], server.gui.add_markdown("")
    status, outcome = ([device.references[name]] for name in ("solver.status", "solver.outcome"))
    inputs = {name: device.references[name] for name in device.references if name.startswith(INPUTS)}
    start = good = rows(device, INPUTS, size=1)[:, 0]
    moment, tried = 0.0, []
    for name, value in zip([*inputs][7:], start[7:], strict=True):
        unit, low, high = ("mm", 0.0, 1e3) if name == INPUTS[3] else ("mT", -100.0, 100.0)
        sliders.append(gui.add_slider(f"{name} ({unit})", min(low, value), max(high, value), 0.1, value))
    gizmo = scene.add_transform_controls("/gizmo", 70.0, position=start[:3], wxyz=start[3:7] / 1e3)
    gizmo.depth_test = False  # not hidden in the magnet
    magnet = scene.add_frame("/magnet", show_axes=False)
    for k, (radius, _, length, offset, _) in enumerate(rows(device, "magnet.design", size=5)):
        scene.add_cylinder(f"/magnet/{k}", radius, length, (60, 90, 190), position=(0.0, 0.0, offset))
    length, radius = (rows(device, f"design.{of}", size=1).sum() for of in ("ring.length", "helix.radius"))
    for moved in itertools.count() if drive is None else range(drive + 1):
        if drive is not None:
            gizmo.position = start[:3] + np.array([0.0, 0.0, moved])
        wanted = [*gizmo.position, *(1e3 * gizmo.wxyz), *(slider.value for slider in sliders)]
        wanted[10:] = np.clip(wanted[10:], good[10:] - FEED, good[10:] + FEED)
        if wanted != tried:
            tried, state = wanted, slave.getFMUstate()
            slave.setReal([*inputs.values()], [value / 1e3 for value in wanted])
            try:
                slave.doStep(moment, STEP)
                said, moment, good = STATUS[slave.getInteger(status)[0]], moment + STEP, np.array(wanted)
                magnet.position, magnet.wxyz = wanted[:3], np.array(wanted[3:7]) / 1e3
            except FMICallException:
                said = f"not solved: {OUTCOME[slave.getInteger(outcome)[0]]}"
                slave.setFMUstate(state)
            slave.freeFMUstate(state)
            angle, margin = np.degrees(device.get("tip.angle")), device.get("stability.margin")
            text.content = f"tip angle {angle:.2f} deg, margin {margin:.3f}, {said}"
            print(f"{moment:.2f} s: tip angle {angle:.12f} deg, margin {margin:.6f}, {said}", flush=True)
            scene.add_spline_catmull_rom("/line", rows(device, "shape.position"), thickness=1.5)
            middle, axis = (rows(device, "ring[", f"].{name}[") for name in ("position", "axis"))
            ends = np.stack([middle - axis * length / 2e3, middle + axis * length / 2e3], axis=1)
            scene.add_arrows("/rings", ends, (90, 90, 100), shaft_radius=radius, head_radius=radius)
        time.sleep(STEP)


def main() -> None:
    """Reads the command line."""
    made = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    made.add_argument("fmu", type=Path, nargs="?", default="mcm.fmu", help="as `mcm pack` writes it")
    made.add_argument("--port", type=int, default=8080, help="where the browser finds it (default 8080)")
    made.add_argument("--drive", type=int, metavar="MM", help="moves the magnet so far, and ends")
    arguments = made.parse_args()
    if not arguments.fmu.exists():
        raise SystemExit(f"no {arguments.fmu}: target/release/mcm pack --out {arguments.fmu} makes it")
    device, server = Component("viewed", arguments.fmu, {}), ViserServer("127.0.0.1", arguments.port)
    server.scene.set_up_direction("+y")
    server.initial_camera.position, server.initial_camera.look_at = (-200.0, 0.0, 30.0), (0.0, -60.0, 30.0)
    with suppress(KeyboardInterrupt):
        view(device, server, arguments.drive)
    device.close()


if __name__ == "__main__":
    main()
