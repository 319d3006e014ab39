"""Leads the device of an FMU through an aorta: a magnet beneath it follows the way of navigate_way.csv, found by hand.

The magnet's centre moves in a plane beneath that of the vessels; its field there points along the heading, from +z
towards +x. All forces are predictions.
"""

import argparse
import csv
import itertools
import math
import subprocess
import sys
import tomllib
from pathlib import Path

import navigate_picture
import numpy as np
from fmpy.fmi1 import FMICallException
from tqdm import tqdm

sys.path.append(str(Path(__file__).parent / "examples"))
from component import Component

WAY = Path(__file__).with_name("navigate_way.csv")
SPEED = 8.3  # mm/s: half a metre in a minute
STEP = 2.0  # mm between two communication points
TURN = 0.4  # mm that count as a turn of the magnet by a degree
POINTS = 121  # of the centreline
SHORTEST = STEP / SPEED / 16  # s; a step in which no shape is found is divided down to this

OUTPUTS = [
    *(f"tip.position[{k}]" for k in (1, 2, 3)),
    "feed.length",
    *(f"contact.force[{k}]" for k in (1, 2, 3)),
    "contact.largest_force",
    "contact.largest_indentation",
    *(f"magnet.reaction_force[{k}]" for k in (1, 2, 3)),
    "stability.margin",
]
COUNTS = ["contact.count", "stability.snaps", "solver.status"]


def way(corners: np.ndarray) -> np.ndarray:
    """Communication points from corner to corner."""
    rows = [corners[0]]
    for start, end in itertools.pairwise(corners):
        apart = max(np.linalg.norm((end - start)[[0, 1, 3]]), TURN * abs(end[2] - start[2]))
        count = math.ceil(apart / STEP)
        rows += [start + (end - start) * i / count for i in range(1, count + 1)]
    return np.array(rows)


def magnet(row: np.ndarray) -> dict[str, float]:
    """Inputs of the magnet: its axis points against the heading, so that its field at the vessels points along it."""
    x, z, heading, beneath = row
    half = math.radians(heading + 180) / 2
    position = dict(
        zip((f"magnet.position[{k}]" for k in (1, 2, 3)), (x / 1e3, -beneath / 1e3, z / 1e3), strict=True)
    )
    return {
        **position,
        **dict(
            zip(
                (f"magnet.orientation[{k}]" for k in (1, 2, 3, 4)),
                (math.cos(half), 0, math.sin(half), 0),
                strict=True,
            )
        ),
    }


def scene(program: str, friction: float) -> str:
    """The aorta with a shaft that hangs free."""
    text = subprocess.run(
        [program, "init", "--vessel", "aorta"], check=True, capture_output=True, text=True
    ).stdout
    for old, new in [
        ('mode = "insertion"', 'mode = "force"'),
        ("wall_modulus_mpa = 1.0", f"wall_modulus_mpa = 1.0\nfriction = {friction}"),
    ]:
        if old not in text:
            raise SystemExit(f"the scene of {program} has no line {old}")
        text = text.replace(old, new)
    return text


def step(device: Component, ends: tuple[np.ndarray, np.ndarray], time: float, length: float) -> bool:
    """Moves the magnet from one place to another, in shorter steps where no shape is found; whether there is one."""
    kept = device.slave.getFMUState()
    try:
        for name, value in magnet(ends[1]).items():
            device.set(name, value)
        device.slave.doStep(currentCommunicationPoint=time, communicationStepSize=length)
        found = True
    except FMICallException:
        device.slave.setFMUState(kept)
        middle, half = sum(ends) / 2, length / 2
        found = (
            half >= SHORTEST
            and step(device, (ends[0], middle), time, half)
            and step(device, (middle, ends[1]), time + half, half)
        )
    device.slave.freeFMUState(kept)
    return found


def drive(fmu: Path, rows: np.ndarray, reach: float) -> tuple[list[list[float]], list[np.ndarray]]:
    """Rows of time, magnet and outputs, and shapes, until so much shaft (m) is inside or no shape is found."""
    device = Component("navigated", fmu, magnet(rows[0]))
    points = sum(name.startswith("shape.arc_length") for name in device.references)
    shape_names = [f"shape.position[{i + 1},{k}]" for i in range(points) for k in (1, 2, 3)]
    shape_references = [device.references[name] for name in shape_names]
    count_references = [device.references[name] for name in COUNTS]
    table, shapes, length = [], [], STEP / SPEED
    with tqdm(rows, unit="step") as bar:
        for number, row in enumerate(bar):
            if not step(device, (rows[max(0, number - 1)], row), number * length, length):
                break
            counts = device.slave.getInteger(count_references)
            table.append([(number + 1) * length, *row, *(device.get(name) for name in OUTPUTS), *counts])
            shapes.append(np.array(device.slave.getReal(shape_references)).reshape(-1, 3))
            inside = device.get("feed.length")
            bar.set_postfix_str(f"{1e3 * inside:.0f} mm of shaft inside")
            if inside >= reach:
                break
    device.close()
    return table, shapes


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("mcm", help="the program mcm")
    parser.add_argument(
        "--to", type=float, default=1000.0, metavar="MM", help="end when so much shaft is inside"
    )
    parser.add_argument("--friction", type=float, default=0.0, metavar="MU", help="between device and wall")
    parser.add_argument("--no-animation", action="store_true")
    arguments = parser.parse_args()
    text = scene(arguments.mcm, arguments.friction)
    Path("navigate.toml").write_text(text)
    packed = ["--scene", "navigate.toml", "--shape-points", str(POINTS), "--out", "navigate.fmu"]
    subprocess.run([arguments.mcm, "pack", *packed], check=True)
    rows = way(np.loadtxt(WAY, delimiter=",", skiprows=1))
    table, shapes = drive(Path("navigate.fmu"), rows, arguments.to / 1e3)
    names = ["time", "magnet_x_mm", "magnet_z_mm", "heading_deg", "beneath_mm", *OUTPUTS, *COUNTS]
    with Path("navigate.csv").open("w", newline="") as out:
        csv.writer(out).writerows([names, *table])
    columns = dict(zip(names, np.array(table).T, strict=True))
    vessel = tomllib.loads(text)["vessel"]["branch"]
    navigate_picture.draw(columns, shapes, vessel, Path("navigate.png"))
    if not arguments.no_animation:
        navigate_picture.animate(columns, shapes, vessel, Path("navigate.gif"))
    ended = "the end of the way" if len(table) == len(rows) else f"step {len(table)} of {len(rows)}"
    tip = [columns[f"tip.position[{k}]"][-1] * 1e3 for k in (1, 3)]
    print(
        f"{ended}: {1e3 * columns['feed.length'][-1]:.0f} mm of shaft inside, tip at x = {tip[0]:.1f} mm, "
        f"z = {tip[1]:.1f} mm; {int(columns['stability.snaps'][-1])} snaps"
    )


if __name__ == "__main__":
    main()
