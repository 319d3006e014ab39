"""Drives an FMU in fmpy: its magnet passes along the free manipulator, turns, and returns.

Sizes, words and limits of the pictures are those of the FMU and of the rows that it gave.
"""

import argparse
import csv
import math
import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from zipfile import is_zipfile

import demo_animation
import demo_picture
import fmpy
from demo_parts import STOP, Parts
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
PASSED, BACK, TURNED = 12.0, 16.0, 24.0  # ends of the pass, of the way back, of the turn, s
REACH = 0.18  # the pass goes this far before and behind the manipulator's middle, m
TURN = math.radians(45)  # about x, towards the tip

# Axis of the magnet from the axis of the manipulator, m. On this path no core of the default FMU bends by the boundary
# angle of 40 deg, at which its windings would touch.
DISTANCE = 0.14

# The closest and the farthest distance of the search, m.
NEAREST, FARTHEST = 0.07, 0.16

# Level `rings` of model.interaction, for the search: it takes twenty passes.
RINGS = 2

# What `solver.status` says when the other outputs are the last good ones.
NOT_SOLVED = 3


def eased(share: float) -> float:
    """From 0 to 1 with a gentle start and end."""
    share = min(max(share, 0.0), 1.0)
    return share * share * (3 - 2 * share)


def path(time: float) -> tuple[float, float]:
    """Position along the manipulator, from its middle (m), and turn (rad) of the magnet."""
    passing = -REACH + 2 * REACH * eased(time / PASSED)
    back = -REACH * eased((time - PASSED) / (BACK - PASSED))
    turned = eased((time - BACK) / (TURNED - BACK))
    home = eased((time - TURNED) / (STOP - TURNED))
    return passing + back - REACH * home, TURN * (turned - home)


class Device:
    """One instance of the FMU, inputs and outputs by name."""

    INPUTS = tuple(f"magnet.position[{k}]" for k in (1, 2, 3)) + tuple(
        f"magnet.orientation[{k}]" for k in (1, 2, 3, 4)
    )

    def __init__(self, fmu: Path) -> None:
        description = fmpy.read_model_description(fmu)
        self.folder = fmpy.extract(fmu)
        self.slave = FMU2Slave(
            guid=description.guid,
            unzipDirectory=self.folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="demo",
        )
        # What happens is read from the outputs, as the search runs into folds on purpose; the last message says why a
        # run ends.
        self.said = ""
        callbacks = fmi2CallbackFunctions(logger=fmi2CallbackLoggerTYPE(self.hear))
        callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
        callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
        self.slave.instantiate(callbacks=callbacks)
        variables = description.modelVariables
        self.reference = {v.name: v.valueReference for v in variables}
        reals = [v.name for v in variables if v.causality == "output" and v.type == "Real"]
        self.rings = sum(name.startswith("ring[") and name.endswith("].axis[1]") for name in reals)
        self.points = sum(name.startswith("shape.position[") and name.endswith(",1]") for name in reals)
        self.reals = reals
        self.cores = [name for name in reals if name.startswith("core[")]
        self.parts = Parts.of({v.name: v.start for v in variables if v.start is not None})
        self.boundary = math.radians(self.parts.boundary)
        self.running = False

    def hear(self, *said: bytes) -> None:
        """Keeps what the FMU says, without the doubled `%` of a format."""
        self.said = said[4].decode().replace("%%", "%")

    def start(self, distance: float, level: int | None = None) -> None:
        """Begins again, the magnet at its first pose, with the FMU's own level of interaction or that one."""
        if self.running:
            self.slave.reset()
        if level is not None:
            self.slave.setInteger([self.reference["model.interaction"]], [level])
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
        z += 1e-3 * self.parts.middle
        values = (0.0, -distance, z, math.cos(half), math.sin(half), 0.0, 0.0)
        self.slave.setReal([self.reference[name] for name in self.INPUTS], values)

    def step(self, index: int, distance: float) -> None:
        """Takes the communication step number `index`, the magnet at its pose at the end."""
        self.place((index + 1) * STEP, distance)
        self.slave.doStep(currentCommunicationPoint=index * STEP, communicationStepSize=STEP)

    def status(self) -> int:
        """How the last step ended."""
        return self.slave.getInteger([self.reference["solver.status"]])[0]

    def held(self) -> bool:
        """Whether the shape is stable and has never snapped."""
        stable = self.slave.getBoolean([self.reference["stability.stable"]])[0]
        snaps = self.slave.getInteger([self.reference["stability.snaps"]])[0]
        return bool(stable) and snaps == 0 and self.status() != NOT_SOLVED

    def apart(self) -> bool:
        """Whether it is held and no two windings touch."""
        return self.held() and not self.largest_core_angle() >= self.boundary

    def largest_core_angle(self) -> float:
        """Bending of the core that bends most, rad; 0 without cores."""
        return max((0.0, *self.slave.getReal([self.reference[name] for name in self.cores])))

    def summary(self) -> dict[str, float]:
        """Margin and largest core angle (deg)."""
        margin = self.slave.getReal([self.reference["stability.margin"]])[0]
        return {"margin": margin, "core": math.degrees(self.largest_core_angle())}

    def row(self, time: float, distance: float) -> dict[str, float]:
        """Everything that the table holds for this time, units in the names."""
        z, turn = path(time)
        values = self.slave.getReal([self.reference[name] for name in self.reals])
        real = dict(zip(self.reals, values, strict=True))
        row = {
            "time_s": round(time, 9),
            "magnet_y_mm": -1e3 * distance,
            "magnet_z_mm": 1e3 * z + self.parts.middle,
            "magnet_turn_deg": math.degrees(turn),
            "tip_angle_deg": math.degrees(real["tip.angle"]),
            "largest_core_angle_deg": max((0.0, *(math.degrees(real[name]) for name in self.cores))),
        }
        row |= self.parts.columns()
        for axis, name in enumerate("xyz", start=1):
            row[f"magnetic_force_{name}_mn"] = 1e3 * real[f"force.magnetic[{axis}]"]
        for axis, name in enumerate("xyz", start=1):
            row[f"tip_field_{name}_mt"] = 1e3 * real[f"field.tip[{axis}]"]
        row["stability_margin"] = self.slave.getReal([self.reference["stability.margin"]])[0]
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


def follow(device: Device, distance: float, keeps: Callable[[Device], bool]) -> dict[str, float] | None:
    """When and how the device first no longer `keeps`, and its summary a step before; `None`: it keeps to the end."""
    device.start(distance, RINGS)
    for index in range(steps()):
        before = device.summary()
        try:
            device.step(index, distance)
            kept = keeps(device)
        except FMICallException:  # no equilibrium was found: the last good outputs are kept
            kept = False
        if not kept:
            return {"time": (index + 1) * STEP, "status": device.status(), **before}
    return None


def closest(device: Device, words: str, keeps: Callable[[Device], bool], far: float) -> tuple[float, float]:
    """Two distances (m), 0.1 mm apart: from the first on inwards the device does not keep on the whole path.

    Both are the nearest or the farthest distance of the search where the device keeps on all of them or on none.
    """
    near = NEAREST
    if follow(device, far, keeps) is not None:
        return far, far
    if follow(device, near, keeps) is None:
        return near, near
    with tqdm(total=math.ceil(math.log2((far - near) / 1e-4)), desc=words, unit="run") as bar:
        while far - near > 1e-4:
            middle = (near + far) / 2
            near, far = (middle, far) if follow(device, middle, keeps) else (near, middle)
            bar.update()
    return near, far


def bound(lost: float, kept: float) -> str:
    """How far something is kept, in words."""
    if lost < kept:
        return f"down to {1e3 * kept:.1f} mm"
    return "at every distance tried" if kept == NEAREST else f"not even at {1e3 * kept:.1f} mm"


def search(device: Device) -> None:
    """Says how close the magnet can come, and what happens then."""
    far = FARTHEST
    if not math.isnan(device.boundary):
        lost, far = closest(device, "windings apart", Device.apart, FARTHEST)
        print(f"adjacent windings stay apart {bound(lost, far)} from axis to axis;")
    near, kept = closest(device, "shape kept", Device.held, far)
    print(
        f"at level `rings` and without a stop at the windings' contact the shape is kept {bound(near, kept)}."
    )
    event = follow(device, near, Device.held) if near < kept else None
    if event is None:
        return
    z, _ = path(event["time"])
    end = "no stable shape is found" if event["status"] == NOT_SOLVED else "the shape snaps"
    print(
        f"At {1e3 * near:.1f} mm, with the magnet at z = {1e3 * z + device.parts.middle:.0f} mm, {end} "
        f"(solver.status {event['status']:.0f});"
    )
    print(
        f"a step before, the margin was {event['margin']:.2f} and one core bent by {event['core']:.0f} deg."
    )


def run(device: Device, distance: float) -> list[dict[str, float]]:
    """Drives the path and returns the table's rows, as far as there is a shape; says where there is none."""
    rows: list[dict[str, float]] = []
    try:
        device.start(distance)
        rows.append(device.row(0.0, distance))
        for index in tqdm(range(steps()), desc="magnet pass", unit="step"):
            device.step(index, distance)
            rows.append(device.row((index + 1) * STEP, distance))
    except FMICallException:
        z, _ = path(len(rows) * STEP)
        where = f"with the magnet at z = {1e3 * z + device.parts.middle:.0f} mm"
        print(f"the pass ends after {len(rows)} rows, {where}: {device.said}", file=sys.stderr)
    return rows


def distance(text: str) -> float:
    """A distance in mm: a finite number above 0."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"{text} is not a distance in mm: a number above 0")
    return value


def main() -> None:
    """Runs the demonstration."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("fmu", type=Path, help="the FMU, as `mcm pack` writes it")
    parser.add_argument(
        "--distance", type=distance, default=1e3 * DISTANCE, help="magnet axis to manipulator axis, mm"
    )
    parser.add_argument(
        "--no-search", action="store_true", help="do not search how close the magnet can come"
    )
    arguments = parser.parse_args()
    if not is_zipfile(arguments.fmu):
        parser.error(f"{arguments.fmu} is not an FMU; `mcm pack --out {arguments.fmu}` writes one")

    device = Device(arguments.fmu)
    try:
        if not arguments.no_search:
            search(device)
        rows = run(device, 1e-3 * arguments.distance)
    finally:
        device.close()
    if not rows:
        raise SystemExit("there is no shape to draw")
    table = Path("mcm_demo.csv")
    with table.open("w", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    picture, film = Path("mcm_demo.png"), Path("mcm_demo.gif")
    demo_picture.draw(table, picture)
    demo_animation.draw(table, film)
    largest = max(row["tip_angle_deg"] for row in rows)
    print(f"wrote {table}, {picture} and {film}: largest tip angle {largest:.1f} deg")


if __name__ == "__main__":
    main()
