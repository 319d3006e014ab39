"""Leads the tip round a circle by moving the magnet, at 1 kHz, while the device differs from its model.

    .venv/bin/python fmu/examples/steer_closed_loop.py mcm.fmu --out loop.csv --picture loop.png

The FMU serves twice: as the model, with its own parameters, and as the device, whose helices are harder by `HARDER`
and whose tip is seen with noise. The model is steered onto the circle by its directional derivatives (feedforward).
Feedback adds to the magnet's position what the error that is seen asks for, filtered.
"""

import argparse
import csv
from pathlib import Path

import matplotlib as mpl
import numpy as np
from component import Component

STEP = 1e-3  # s
STOP = 2.0  # s
PERIOD = 1.0  # s, of a turn
RADIUS = 1e-3  # m
HARDER = 1.0  # Shore A
NOISE = 20e-6  # m, standard deviation of the position that is seen
GAIN = 60.0  # share of the error that feedback takes away per second, 1/s
EVERY = 10  # steps between Jacobians
SETTLED = 0.5  # s: errors are told from here on

TIP = [f"tip.position[{axis}]" for axis in (1, 2)]
MAGNET = [f"magnet.position[{axis}]" for axis in (1, 2, 3)]
COLUMNS = ["time", *(f"wanted[{axis}]" for axis in (1, 2)), *TIP, *MAGNET]


def instance(name: str, fmu: Path, *, harder: float) -> Component:
    """The device or its model, at rest beside the magnet of the FMU."""
    component = Component(name, fmu, {})
    hardness = component.get("design.helix.shore_a") + harder
    component.close()
    return Component(name, fmu, {"design.helix.shore_a": hardness})


def tip(component: Component) -> np.ndarray:
    """Where the tip is, across the axis (m)."""
    return np.array([component.get(name) for name in TIP])


def place(component: Component, position: np.ndarray) -> None:
    """Moves the magnet."""
    for name, value in zip(MAGNET, position.tolist(), strict=True):
        component.set(name, value)


def jacobian(component: Component) -> np.ndarray:
    """Derivatives of the tip's position by the magnet's."""
    return np.array([[component.derivative(output, name) for name in MAGNET] for output in TIP])


def run(fmu: Path, *, feedback: bool) -> np.ndarray:
    """The rows of the table."""
    random = np.random.default_rng(1)
    model, device = instance("model", fmu, harder=0.0), instance("device", fmu, harder=HARDER)
    try:
        start = tip(model)
        planned = np.array([model.get(name) for name in MAGNET])
        added = np.zeros(len(MAGNET))
        rows = []
        for index in range(round(STOP / STEP)):
            time = index * STEP
            angle = 2 * np.pi * time / PERIOD
            wanted = start + RADIUS * np.array([np.sin(angle), np.cos(angle) - 1.0])
            if index % EVERY == 0:
                inverse = np.linalg.pinv(jacobian(model))
            planned = planned + inverse @ (wanted - tip(model))
            place(model, planned)
            place(device, planned + added)
            reached = tip(device)
            rows.append([time, *wanted, *reached, *(planned + added)])
            if feedback:
                seen = reached + random.normal(0.0, NOISE, 2)
                added = added + GAIN * STEP * inverse @ (wanted - seen)
    finally:
        model.close()
        device.close()
    return np.array(rows)


def error(rows: np.ndarray) -> float:
    """Root mean square of the distance from the circle once the start is forgotten, m."""
    late = rows[rows[:, 0] >= SETTLED]
    return float(np.sqrt(np.mean(np.sum((late[:, 1:3] - late[:, 3:5]) ** 2, axis=1))))


def draw(picture: Path, forward: np.ndarray, closed: np.ndarray) -> None:
    """Draws the circle and both ways of the tip, and their errors."""
    mpl.use("Agg")
    import matplotlib.pyplot as plt  # noqa: PLC0415 - after the choice of how to draw

    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4.2), layout="constrained")
    left.plot(*(1e3 * closed[:, 1:3].T), color="grey", lw=4, alpha=0.4, label="wanted")
    for rows, name in [(forward, "feedforward"), (closed, "with feedback")]:
        left.plot(*(1e3 * rows[:, 3:5].T), lw=1, label=name)
        off = np.linalg.norm(rows[:, 1:3] - rows[:, 3:5], axis=1)
        right.semilogy(rows[:, 0], 1e3 * off, lw=1, label=name)
    left.set(xlabel="tip x (mm)", ylabel="tip y (mm)", aspect="equal")
    left.legend()
    right.set(xlabel="time (s)", ylabel="distance from where it should be (mm)")
    figure.savefig(picture, dpi=110)
    print(f"wrote {picture}")


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("fmu", type=Path, help="the FMU, as `mcm pack` writes it")
    parser.add_argument("--out", type=Path, required=True, help="the table to write (CSV), with feedback")
    parser.add_argument("--picture", type=Path, help="the picture to write (PNG)")
    arguments = parser.parse_args()
    forward, closed = run(arguments.fmu, feedback=False), run(arguments.fmu, feedback=True)
    with arguments.out.open("w", newline="") as file:
        csv.writer(file).writerows([COLUMNS, *closed.tolist()])
    print(f"wrote {arguments.out}")
    print(f"root mean square of the error: feedforward {1e3 * error(forward):.4f} mm")
    print(f"root mean square of the error: with feedback {1e3 * error(closed):.4f} mm")
    if arguments.picture:
        draw(arguments.picture, forward, closed)


if __name__ == "__main__":
    main()
