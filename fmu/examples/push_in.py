"""Pushes the device of an FMU with a shaft into its vessel, with the magnet ahead of the tip.

    target/release/mcm init --vessel aorta --out aorta.toml
    target/release/mcm pack --scene aorta.toml --out aorta.fmu
    .venv/bin/python fmu/examples/push_in.py aorta.fmu --to 120 --out pushed.csv --picture pushed.png

The magnet moves beneath the vessel along the port's axis, 20 mm ahead of the unstretched tip. Forces are predictions.
"""

import argparse
import csv
from pathlib import Path

import numpy as np
from component import Component
from matplotlib.figure import Figure

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
    figure = Figure(figsize=(8, 7), layout="constrained")
    side, forces = figure.subplots(2, 1)
    for shape in shapes:
        side.plot(1e3 * shape[:, 2], 1e3 * shape[:, 1], lw=2)
    side.set(xlabel="z, along the port (mm)", ylabel="y (mm); the magnet is below")
    side.set_title("Shapes while the shaft is pushed in")
    wall = np.linalg.norm([table[f"contact.force[{k}]"] for k in (1, 2, 3)], axis=0)
    for label, values in [
        ("total force of the wall", wall),
        ("largest contact", table["contact.largest_force"]),
        ("push at the port", table["feed.reaction_force"]),
    ]:
        forces.plot(1e3 * table["insertion"], 1e3 * values, label=label)
    forces.set(xlabel="inserted length (mm)", ylabel="force (mN)")
    forces.legend()
    figure.savefig(picture, dpi=150)


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
