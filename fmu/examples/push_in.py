"""Pushes the device of an FMU with a shaft into its vessel, with the magnet ahead of the tip.

    target/release/mcm init --vessel aorta --out aorta.toml
    target/release/mcm pack --scene aorta.toml --out aorta.fmu
    .venv/bin/python fmu/examples/push_in.py aorta.fmu --to 120 --out pushed.csv --picture pushed.png

The magnet moves beneath the vessel along the port's axis, 20 mm ahead of the unstretched tip. Forces are predictions.
"""

import argparse
import csv
import sys
from pathlib import Path

import numpy as np
from component import Component

sys.path.append(str(Path(__file__).resolve().parents[1]))
import look
from matplotlib.pyplot import subplots

FASTEST = 8.3e-3  # m/s: half a metre in a minute
STEP = 0.5e-3  # m
AHEAD = 0.02  # m
DEVICE = 0.046  # m: length of the device at the end of the shaft

OUTPUTS = [
    *(f"tip.position[{k}]" for k in (1, 2, 3)),
    *(f"contact.force[{k}]" for k in (1, 2, 3)),
    "contact.largest_force",
    "contact.largest_indentation",
    "feed.reaction_force",
    "stability.margin",
]


def drive(fmu: Path, reach: float, beneath: float) -> tuple[list[list[float]], list[np.ndarray]]:
    """Rows of time, insertion and outputs, and some shapes, up to a reach (m)."""
    device = Component("pushed", fmu, {"magnet.position[2]": -beneath})
    if "feed.insertion" not in device.references or "contact.count" not in device.references:
        raise SystemExit(f"{fmu} has no shaft in a vessel: pack one from `mcm init --vessel aorta`")
    points = sum(name.startswith("shape.arc_length") for name in device.references)
    rows, shapes, time = [], [], 0.0
    for insertion in np.arange(0.0, reach + STEP / 2, STEP):
        device.set("feed.insertion", float(insertion))
        device.set("magnet.position[3]", float(insertion) + DEVICE + AHEAD)
        rows.append([time, float(insertion), *(device.get(name) for name in OUTPUTS)])
        if len(rows) % 60 == 1:
            shape = [[device.get(f"shape.position[{i + 1},{k}]") for k in (1, 2, 3)] for i in range(points)]
            shapes.append(np.array(shape))
        device.slave.doStep(currentCommunicationPoint=time, communicationStepSize=STEP / FASTEST)
        time += STEP / FASTEST
    device.close()
    return rows, shapes


def draw(rows: list[list[float]], shapes: list[np.ndarray], picture: Path) -> None:
    """Shapes from the side above, forces over the insertion below."""
    table = dict(zip(["time", "insertion", *OUTPUTS], np.array(rows).T, strict=True))
    figure, (side, forces) = subplots(2, 1, figsize=(8.5, 6))
    for shape, colour in zip(shapes, reversed(look.shades(look.BLUE, len(shapes))), strict=True):
        side.plot(1e3 * shape[:, 2], 1e3 * shape[:, 1], lw=2, color=colour)
    side.set(
        xlabel="z, along the port (mm)", ylabel="y (mm)", title="Shapes from the side; the magnet is below"
    )
    inserted = 1e3 * table["insertion"]
    wall = np.linalg.norm([table[f"contact.force[{k}]"] for k in (1, 2, 3)], axis=0)
    labels = []
    for words, values, colour in [
        ("force of the wall", wall, look.WALL),
        ("largest contact", table["contact.largest_force"], look.INK),
        ("push at the port", table["feed.reaction_force"], look.BLUE),
    ]:
        forces.plot(inserted, 1e3 * values, color=colour)
        labels.append((inserted[-1], 1e3 * values[-1], words, colour))
    forces.axhline(0, color=look.GREY, lw=0.8)
    forces.set(xlabel="inserted length (mm)", ylabel="force (mN)", title="Forces, predicted")
    forces.set_xlim(0, inserted[-1])
    look.title(
        figure,
        "The magnet bends the tip against the wall while the shaft is pushed in",
        f"Abdominal aorta; dark: {inserted[-1]:.0f} mm of shaft inside; the magnet is {1e3 * AHEAD:.0f} mm ahead.",
    )
    look.ends(forces, labels)
    figure.savefig(picture)


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("fmu", type=Path)
    parser.add_argument("--to", type=float, default=120.0, metavar="MM", help="inserted length at the end")
    parser.add_argument(
        "--beneath", type=float, default=120.0, metavar="MM", help="distance of the magnet's axis"
    )
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--picture", type=Path)
    arguments = parser.parse_args()
    rows, shapes = drive(arguments.fmu, 1e-3 * arguments.to, 1e-3 * arguments.beneath)
    with arguments.out.open("w", newline="") as out:
        csv.writer(out).writerows([["time", "insertion", *OUTPUTS], *rows])
    if arguments.picture:
        draw(rows, shapes, arguments.picture)


if __name__ == "__main__":
    main()
