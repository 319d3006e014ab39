"""Controls the tip angle by moving the magnet, with the FMU's directional derivatives as the Jacobian.

    .venv/bin/python fmu/examples/fmpy_tip_angle.py mcm.fmu --out controlled.csv --picture controlled.png

In every step the magnet moves in its plane by the damped least-squares solution of `J u = rate * step * error`, where
`J` holds the derivatives of the tip angle by the magnet's position, no faster than a robot arm may. `--differences`
takes `J` from central differences instead, to check the derivatives.
"""

import argparse
import csv
import math
from collections.abc import Iterator
from pathlib import Path

import matplotlib as mpl
import numpy as np
from component import Component

STEP = 0.05  # s
TARGETS = [(0.0, 20.0), (3.0, 60.0), (7.0, 35.0)]  # from when on (s), tip angle (deg)
STOP = 10.0  # s
RATE = 4.0  # share of the error that is taken away per second, 1/s
DAMPING = 2.0  # rad/m: keeps the step short where the magnet has little effect
FASTEST = 0.05  # m/s
DIFFERENCE = 1e-5  # m: the error of central differences is of the order of (1e-5 m / 0.1 m)^2

ANGLE = "tip.angle"
POSITION = ["magnet.position[2]", "magnet.position[3]"]
COLUMNS = ["time", "target", ANGLE, *POSITION, *(f"d({ANGLE})/d({name})" for name in POSITION)]


def target(time: float) -> float:
    """Tip angle that is asked for, rad."""
    return math.radians(next(angle for start, angle in reversed(TARGETS) if time >= start))


class Device:
    """The manipulator in its first communication point, with the magnet where it starts."""

    def __init__(self, fmu: Path, *, differences: bool) -> None:
        self.component = Component("controlled", fmu, {})
        self.position = np.array([self.component.get(name) for name in POSITION])
        self.differences = differences
        if not differences and not self.component.description.coSimulation.providesDirectionalDerivative:
            raise SystemExit(f"{fmu} provides no directional derivatives: see --differences")

    def angle(self, position: np.ndarray) -> float:
        """Tip angle with the magnet here, rad."""
        for name, value in zip(POSITION, position.tolist(), strict=True):
            self.component.set(name, value)
        return self.component.get(ANGLE)

    def jacobian(self) -> np.ndarray:
        """Derivatives of the tip angle by the magnet's position, rad/m."""
        if not self.differences:
            return np.array([self.component.derivative(ANGLE, name) for name in POSITION])
        ends = [
            self.angle(self.position + h) - self.angle(self.position - h)
            for h in DIFFERENCE * np.eye(len(POSITION))
        ]
        return np.array(ends) / (2 * DIFFERENCE)


def run(device: Device) -> Iterator[list[float]]:
    """The rows of the table."""
    for index in range(round(STOP / STEP)):
        time = index * STEP
        angle = device.angle(device.position)
        jacobian = device.jacobian()
        yield [round(time, 9), target(time), angle, *device.position, *jacobian]
        wanted = RATE * STEP * (target(time) - angle)
        move = jacobian * wanted / (jacobian @ jacobian + DAMPING**2)
        move *= min(1.0, FASTEST * STEP / max(np.linalg.norm(move), 1e-12))
        device.position = device.position + move
        device.angle(device.position)
        device.component.slave.doStep(time, STEP)


def draw(picture: Path, rows: list[list[float]]) -> None:
    """Draws tip angle and position of the magnet over time."""
    mpl.use("Agg")
    import matplotlib.pyplot as plt  # noqa: PLC0415 - after the choice of how to draw

    time, wanted, angle, y, z, *_ = np.array(rows).T
    figure, (above, below) = plt.subplots(2, sharex=True, figsize=(7, 5), layout="constrained")
    above.step(time, np.degrees(wanted), where="post", color="grey", label="asked for")
    above.plot(time, np.degrees(angle), color="black", label="reached")
    above.set_ylabel("tip angle (deg)")
    above.legend()
    below.plot(time, 1e3 * y, label="y")
    below.plot(time, 1e3 * z, label="z")
    below.set(ylabel="magnet (mm)", xlabel="time (s)")
    below.legend()
    figure.savefig(picture, dpi=120)
    print(f"wrote {picture}")


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("fmu", type=Path, help="the FMU, as `mcm pack` writes it")
    parser.add_argument("--out", type=Path, required=True, help="the table to write (CSV)")
    parser.add_argument("--picture", type=Path, help="the picture to write (PNG)")
    parser.add_argument("--differences", action="store_true", help="take the Jacobian from differences")
    arguments = parser.parse_args()
    device = Device(arguments.fmu, differences=arguments.differences)
    try:
        rows = list(run(device))
    finally:
        device.component.close()
    with arguments.out.open("w", newline="") as file:
        csv.writer(file).writerows([COLUMNS, *rows])
    print(f"wrote {arguments.out}")
    if arguments.picture:
        draw(arguments.picture, rows)


if __name__ == "__main__":
    main()
