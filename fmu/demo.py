"""Drives the FMU in fmpy: the paper's magnet pair passes along the free manipulator, then turns."""

import argparse
import csv
import math
import shutil
from pathlib import Path

import demo_picture
import fmpy
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    calloc,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    free,
)
from tqdm import tqdm

STEP = 0.05  # communication step, s
PASSED, BACK, STOP = 12.0, 16.0, 24.0  # ends of the pass, of the way back, of the turn, s
REACH = 0.18  # the pass goes this far before and behind the manipulator's middle, m
MIDDLE = 0.023  # the manipulator's middle, m
TURN = math.radians(45)  # about x, towards the tip

# Axis of the magnet from the axis of the manipulator, m.
DISTANCE = 0.12


def eased(share: float) -> float:
    """From 0 to 1 with a gentle start and end."""
    share = min(max(share, 0.0), 1.0)
    return share * share * (3 - 2 * share)


def path(time: float) -> tuple[float, float]:
    """Position along the manipulator (m) and turn (rad) of the magnet."""
    passing = -REACH + 2 * REACH * eased(time / PASSED)
    back = -REACH * eased((time - PASSED) / (BACK - PASSED))
    return MIDDLE + passing + back, TURN * eased((time - BACK) / (STOP - BACK))


class Device:
    """One instance of the FMU, inputs and outputs by name."""

    INPUTS = ("magnet.position[2]", "magnet.position[3]", "magnet.orientation[1]", "magnet.orientation[2]")

    def __init__(self, fmu: Path) -> None:
        description = fmpy.read_model_description(fmu)
        self.folder = fmpy.extract(fmu)
        self.slave = FMU2Slave(
            guid=description.guid,
            unzipDirectory=self.folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="demo",
        )
        # What happens is read from the outputs: the search runs into folds on purpose.
        callbacks = fmi2CallbackFunctions(logger=fmi2CallbackLoggerTYPE(lambda *_: None))
        callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
        callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
        self.slave.instantiate(callbacks=callbacks)
        variables = description.modelVariables
        self.reference = {v.name: v.valueReference for v in variables}
        reals = [v.name for v in variables if v.causality == "output" and v.type == "Real"]
        self.rings = sum(name.startswith("ring[") and name.endswith("].axis[1]") for name in reals)
        self.points = sum(name.startswith("shape.position[") and name.endswith(",1]") for name in reals)
        self.reals = reals
        self.running = False

    def start(self, distance: float) -> None:
        """Begins again, the magnet at its first pose."""
        if self.running:
            self.slave.reset()
        self.slave.setupExperiment(startTime=0.0, stopTime=STOP)
        self.slave.enterInitializationMode()
        self.place(0.0, distance)
        self.slave.exitInitializationMode()
        self.running = True

    def place(self, time: float, distance: float) -> None:
        """Sets the magnet's pose of this time."""
        z, turn = path(time)
        # Turned by pi about x the magnet's axis points along -z: beside it the field points along +z.
        half = (math.pi + turn) / 2
        values = (-distance, z, math.cos(half), math.sin(half))
        self.slave.setReal([self.reference[name] for name in self.INPUTS], values)

    def step(self, index: int, distance: float) -> None:
        """Takes the communication step number `index`, the magnet at its pose at the end."""
        self.place((index + 1) * STEP, distance)
        self.slave.doStep(currentCommunicationPoint=index * STEP, communicationStepSize=STEP)

    def held(self) -> bool:
        """Whether the shape is stable and has never snapped."""
        stable = self.slave.getBoolean([self.reference["stability.stable"]])[0]
        snaps = self.slave.getInteger([self.reference["stability.snaps"]])[0]
        status = self.slave.getInteger([self.reference["solver.status"]])[0]
        return bool(stable) and snaps == 0 and status != 3

    def row(self, time: float, distance: float) -> dict[str, float]:
        """Everything that the table holds for this time, units in the names."""
        z, turn = path(time)
        values = self.slave.getReal([self.reference[name] for name in self.reals])
        real = dict(zip(self.reals, values, strict=True))
        row = {
            "time_s": round(time, 9),
            "magnet_y_mm": -1e3 * distance,
            "magnet_z_mm": 1e3 * z,
            "magnet_turn_deg": math.degrees(turn),
            "tip_angle_deg": math.degrees(real["tip.angle"]),
        }
        for axis, name in enumerate("xyz", start=1):
            row[f"magnetic_force_{name}_mn"] = 1e3 * real[f"force.magnetic[{axis}]"]
        for axis, name in enumerate("xyz", start=1):
            row[f"tip_field_{name}_mt"] = 1e3 * real[f"field.tip[{axis}]"]
        row["stability_margin"] = real["stability.margin"]
        row["snaps"] = self.slave.getInteger([self.reference["stability.snaps"]])[0]
        for ring in range(1, self.rings + 1):
            for axis, name in ((2, "y"), (3, "z")):
                row[f"ring_{ring}_{name}_mm"] = 1e3 * real[f"ring[{ring}].position[{axis}]"]
                row[f"ring_{ring}_axis_{name}"] = real[f"ring[{ring}].axis[{axis}]"]
        for point in range(1, self.points + 1):
            for axis, name in ((2, "y"), (3, "z")):
                row[f"shape_{point}_{name}_mm"] = 1e3 * real[f"shape.position[{point},{axis}]"]
        return row

    def close(self) -> None:
        """Frees the instance and its folder."""
        if self.running:
            self.slave.terminate()
        self.slave.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)


def steps() -> int:
    """Number of communication steps."""
    return round(STOP / STEP)


def holds(device: Device, distance: float) -> bool:
    """Whether the manipulator keeps its shape along the whole path at this distance."""
    try:
        device.start(distance)
        for index in range(steps()):
            if not device.held():
                return False
            device.step(index, distance)
    except FMICallException:  # no equilibrium was found, not even after a snap
        return False
    return device.held()


def closest(device: Device, near: float = 0.07, far: float = DISTANCE) -> float:
    """Smallest distance (m, to 0.1 mm) at which the manipulator keeps its shape along the whole path."""
    with tqdm(total=math.ceil(math.log2((far - near) / 1e-4)), desc="how close", unit="run") as bar:
        while far - near > 1e-4:
            middle = (near + far) / 2
            near, far = (near, middle) if holds(device, middle) else (middle, far)
            bar.set_postfix_str(f"{1e3 * near:.1f} mm snaps, {1e3 * far:.1f} mm holds")
            bar.update()
    return far


def run(device: Device, distance: float) -> list[dict[str, float]]:
    """Drives the whole path and returns the table's rows."""
    device.start(distance)
    rows = [device.row(0.0, distance)]
    for index in tqdm(range(steps()), desc="magnet pass", unit="step"):
        device.step(index, distance)
        rows.append(device.row((index + 1) * STEP, distance))
    return rows


def main() -> None:
    """Runs the demonstration."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("fmu", type=Path, help="the FMU, as `mcm pack` writes it")
    parser.add_argument(
        "--distance", type=float, default=1e3 * DISTANCE, help="magnet axis to manipulator axis, mm"
    )
    parser.add_argument(
        "--no-search", action="store_true", help="do not search how close the magnet can come"
    )
    arguments = parser.parse_args()

    device = Device(arguments.fmu)
    try:
        if not arguments.no_search:
            found = 1e3 * closest(device)
            print(
                f"the manipulator keeps its shape down to {found:.1f} mm from axis to axis; closer, it snaps"
            )
        rows = run(device, 1e-3 * arguments.distance)
    finally:
        device.close()
    table = Path("mcm_demo.csv")
    with table.open("w", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    picture = Path("mcm_demo.png")
    demo_picture.draw(table, picture)
    print(
        f"wrote {table} and {picture}: largest tip angle {max(row['tip_angle_deg'] for row in rows):.1f} deg"
    )


if __name__ == "__main__":
    main()
