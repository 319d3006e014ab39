"""Times scipy and CasADi on targets of the tip, through the FMU, beside `mcm::steer`, in one run.

    fmu/venv tests/bench/requirements.txt
    cargo build --release --examples
    .venv/bin/python tests/bench/steer.py [number of targets]

Targets are tips (position and direction) with the magnet moved at random by up to 20 mm and 0.5 rad along each axis,
asked for from the scene's pose. scipy's `least_squares` moves the magnet's place and direction, five freedoms, by
differences; it knows nothing of snaps. CasADi's IPOPT moves the same by the FMU's exact derivatives, for the tip's
position alone and with a distance to keep, beside the command `mcm steer`, which is timed from its start to its end.
"""

import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

PACKAGE = Path(__file__).resolve().parents[2]
sys.path.append(str(PACKAGE / "fmu" / "examples"))

from component import Component  # noqa: E402 - from the examples' folder
from magnet_pose_casadi import Problem  # noqa: E402

RELEASE = PACKAGE / "target" / "release"
POSITION = 1e-6  # m, counts as met
ANGLE = 1e-4  # rad
AROUND = (0.02, 0.5)  # m, rad
KEEP_AWAY = (
    0.06  # m, from the magnet's centre to rings; by `mcm steer`, which counts between surfaces, half of it
)
SCALE = np.array([1e-2, 1e-2, 1e-2, 1e-1, 1e-1])  # of the freedoms

PLACE = [f"magnet.position[{axis}]" for axis in (1, 2, 3)]
TURN = [f"magnet.orientation[{axis}]" for axis in (1, 2, 3, 4)]
TIP = [f"tip.position[{axis}]" for axis in (1, 2, 3)] + [f"tip.orientation[{axis}]" for axis in (1, 2, 3, 4)]


class Device:
    """The FMU as a function of the magnet's pose."""

    def __init__(self, fmu: Path) -> None:
        self.component = Component("device", fmu, {})
        self.slave = self.component.slave
        self.inputs = [self.component.references[name] for name in PLACE + TURN]
        self.outputs = [self.component.references[name] for name in TIP]
        pose = self.slave.getReal(self.inputs)
        self.place, self.rotation = np.array(pose[:3]), Rotation.from_quat(pose[3:], scalar_first=True)
        self.start = self.slave.getFMUState()

    def tip(self, place: np.ndarray, rotation: Rotation) -> tuple[np.ndarray, np.ndarray]:
        """Position and direction of the tip."""
        self.slave.setReal(self.inputs, [*place.tolist(), *rotation.as_quat(scalar_first=True).tolist()])
        tip = np.array(self.slave.getReal(self.outputs))
        return tip[:3], Rotation.from_quat(tip[3:], scalar_first=True).as_matrix()[:, 2]

    def freedoms(self, x: np.ndarray) -> tuple[np.ndarray, Rotation]:
        """Pose of the magnet after a step of five freedoms from the start."""
        x = x * SCALE
        turn = self.rotation.as_matrix()[:, :2] @ x[3:]
        return self.place + x[:3], Rotation.from_rotvec(turn) * self.rotation

    def reset(self) -> None:
        """Back to the scene's pose."""
        self.slave.setFMUState(self.start)


def packed(segments: int, folder: Path) -> tuple[Path, Path]:
    """A scene and its FMU."""
    scene, fmu = folder / "scene.toml", folder / "scene.fmu"
    scene.write_text(
        f"[design]\nsegments = {segments}\n[magnet]\nposition_mm = [0.0, -120.0, {3 * segments}.0]\n"
        '[model]\ninteraction = "rings"\n'
    )
    subprocess.run([RELEASE / "mcm", "pack", "--scene", scene, "--out", fmu], check=True, capture_output=True)
    return scene, fmu


def targets(device: Device, count: int) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Positions and directions of tips that the device has with the magnet elsewhere; it stands at the start again."""
    random = np.random.default_rng(1)
    for _ in range(count):
        place = device.place + AROUND[0] * random.uniform(-1, 1, 3)
        rotation = Rotation.from_rotvec(AROUND[1] * random.uniform(-1, 1, 3)) * device.rotation
        device.reset()
        wanted = device.tip(place, rotation)
        device.reset()
        yield wanted


def optimise(segments: int, count: int, folder: Path) -> tuple[int, list[float], int, list[float]]:
    """Number of positions met and times (ms), of IPOPT and of `mcm steer`."""
    scene, fmu = packed(segments, folder)
    device, problem = Device(fmu), Problem(fmu, KEEP_AWAY)
    met, times, steered, commands = 0, [], 0, []
    for wanted, _ in targets(device, count):
        found = problem.solve(wanted)
        times.append(1e3 * found.seconds)
        tip, _ = device.tip(found.pose[:3], Rotation.from_quat(found.pose[3:], scalar_first=True))
        met += found.solved and bool(np.linalg.norm(tip - wanted) <= POSITION)
        device.reset()
        where = ",".join(repr(float(1e3 * value)) for value in wanted)
        command = [RELEASE / "mcm", "steer", scene, f"--tip-position-mm={where}"]
        command += ["--move", "magnet.position,magnet.orientation", "--keep-away-mm", str(500 * KEEP_AWAY)]
        began = time.perf_counter()
        done = subprocess.run([*command, "--out", folder / "way.csv"], check=False, capture_output=True)
        commands.append(1e3 * (time.perf_counter() - began))
        steered += done.returncode == 0
    device.component.close()
    problem.close()
    return met, times, steered, commands


def measure(segments: int, count: int, folder: Path) -> tuple[int, list[float]]:
    """Number of targets met, and the times (ms)."""
    device = Device(packed(segments, folder)[1])
    met, times = 0, []
    for wanted, direction in targets(device, count):

        def residuals(
            x: np.ndarray, wanted: np.ndarray = wanted, direction: np.ndarray = direction
        ) -> np.ndarray:
            tip, axis = device.tip(*device.freedoms(x))
            return np.concatenate([(tip - wanted) / POSITION, (axis - direction) / ANGLE])

        started = time.perf_counter()
        found = least_squares(residuals, np.zeros(5), diff_step=1e-4, x_scale=1.0, xtol=1e-12, ftol=1e-12)
        times.append(1e3 * (time.perf_counter() - started))
        left = residuals(found.x)
        met += bool(np.linalg.norm(left[:3]) <= 1 and np.linalg.norm(left[3:]) <= 1)
    device.component.close()
    return met, times


def main() -> None:
    """Prints a table, and ours below it."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    print("| segments | targets | met by least_squares | median (ms) | longest (ms) |")
    print("| --- | --- | --- | --- | --- |")
    for segments in (1, 3, 9):
        with tempfile.TemporaryDirectory() as folder:
            met, times = measure(segments, count, Path(folder))
        print(f"| {segments} | {count} | {met} | {np.median(times):.0f} | {max(times):.0f} |", flush=True)
    print(
        "\n| segments | targets | met by IPOPT | median (ms) | longest | met by `mcm steer` | median (ms) | longest |"
    )
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for segments in (1, 3, 9):
        with tempfile.TemporaryDirectory() as folder:
            met, times, steered, commands = optimise(segments, count, Path(folder))
        row = f"{segments} | {count} | {met} | {np.median(times):.0f} | {max(times):.0f} | {steered}"
        print(f"| {row} | {np.median(commands):.0f} | {max(commands):.0f} |", flush=True)
    print(
        subprocess.run(
            [RELEASE / "examples" / "targets", str(count)], check=True, capture_output=True, text=True
        ).stdout
    )


if __name__ == "__main__":
    main()
