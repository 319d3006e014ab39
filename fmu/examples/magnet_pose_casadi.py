"""Finds the magnet's pose for a wanted tip by CasADi and IPOPT, through model exchange with exact derivatives.

    fmu/venv fmu/examples/casadi.txt
    mcm pack --out mcm.fmu
    .venv/bin/python fmu/examples/magnet_pose_casadi.py mcm.fmu --tip-position-mm 1,-16,41 --keep-away-mm 90

Five freedoms: the magnet's centre and the direction of its axis. Of all poses that bring the tip there, the nearest one
to the start, no nearer with its centre to any ring than `--keep-away-mm`. IPOPT knows nothing of snaps: the way to the
pose found is driven in co-simulation afterwards, in steps. `mcm steer` finds a way without snaps.
"""

import argparse
import shutil
import time
from dataclasses import dataclass
from pathlib import Path

import casadi as ca
import numpy as np
from component import Component
from fmpy import extract

PLACE = [f"magnet.position[{axis}]" for axis in (1, 2, 3)]
TURN = [f"magnet.orientation[{part}]" for part in (1, 2, 3, 4)]
TIP = [f"tip.position[{axis}]" for axis in (1, 2, 3)]
SCALE = np.array([1e-2, 1e-2, 1e-2, 1e-1, 1e-1])  # m, m, m, rad, rad: a step of each freedom
BOX = np.array([5, 5, 5, 10, 10])  # farthest from the start, in these steps
TIP_SCALE = 1e-4  # m: unit of what is missing of the tip's position
STEPS = 20  # of the way that is driven afterwards


def product(a: ca.DM | ca.MX, b: ca.DM | ca.MX) -> ca.MX:
    """The product of two quaternions (w, x, y, z)."""
    real = a[0] * b[0] - ca.dot(a[1:], b[1:])
    return ca.vertcat(real, a[0] * b[1:] + b[0] * a[1:] + ca.cross(a[1:], b[1:]))


@dataclass
class Found:
    """What IPOPT has found."""

    pose: np.ndarray  # position (m) and orientation (w, x, y, z) of the magnet
    solved: bool
    iterations: int
    evaluations: int  # of the device, with and without derivatives
    seconds: float


class Problem:
    """The device as a function of the magnet's pose, and the optimiser that asks it."""

    def __init__(self, fmu: Path, keep_away: float) -> None:
        self.folder = extract(fmu)
        device = ca.DaeBuilder("device", str(self.folder))
        for name in set(device.u()) - {*PLACE, *TURN}:
            device.set_category(name, "c")  # stays as the FMU starts
        rings = [name for name in device.y() if name.startswith("ring[") and ".position[" in name]
        device.set_y([*TIP, *rings])
        answer = device.create("answer", ["u"], ["y"], {"uses_directional_derivatives": True})
        self.start = np.array(device.start(device.u()))

        x, wanted = ca.MX.sym("x", 5), ca.MX.sym("wanted", 3)
        place = self.start[:3] + SCALE[:3] * x[:3]
        tilt = ca.vertcat(1, 0.5 * SCALE[3:] * x[3:], 0)  # about the magnet's own x and y
        turn = product(ca.DM(self.start[3:]), tilt / ca.norm_2(tilt))
        tip, centres = ca.vertsplit(answer(ca.vertcat(place, turn)), [0, 3, 3 + len(rings)])
        away = ca.sum1((ca.reshape(centres, 3, -1) - place) ** 2).T / keep_away**2
        # The nearest pose, with the tip where it shall be and no ring too near.
        problem = {"x": x, "p": wanted, "f": ca.sumsqr(x), "g": ca.vertcat((tip - wanted) / TIP_SCALE, away)}
        self.lower, self.upper = np.zeros(3 + away.size1()), np.zeros(3 + away.size1())
        self.lower[3:], self.upper[3:] = 1.0, np.inf
        # An FMU has no second derivatives: the Hessian is that of the way to go alone.
        weight, multipliers = ca.MX.sym("weight"), ca.MX.sym("multipliers", len(self.lower))
        hessian = ca.Function("nlp_hess_l", [x, wanted, weight, multipliers], [2 * weight * ca.MX.eye(5)])
        options = {
            "print_time": False,
            "ipopt": {"print_level": 0, "sb": "yes", "tol": 1e-6, "constr_viol_tol": 1e-3, "max_iter": 200},
            "hess_lag": hessian,
        }
        self.solver = ca.nlpsol("solver", "ipopt", problem, options)
        self.pose = ca.Function("pose", [x], [ca.vertcat(place, turn)])

    def solve(self, tip: np.ndarray) -> Found:
        """The nearest pose of the magnet that brings the tip to `tip` (m)."""
        began = time.perf_counter()
        found = self.solver(x0=np.zeros(5), p=tip, lbx=-BOX, ubx=BOX, lbg=self.lower, ubg=self.upper)
        seconds = time.perf_counter() - began
        said = self.solver.stats()
        calls = sum(said[f"n_call_{name}"] for name in ("nlp_g", "nlp_jac_g"))
        pose = np.array(self.pose(found["x"])).ravel()
        return Found(pose, said["success"], said["iter_count"], calls, seconds)

    def close(self) -> None:
        """Removes the unpacked FMU."""
        shutil.rmtree(self.folder, ignore_errors=True)


def drive(fmu: Path, start: np.ndarray, end: np.ndarray) -> tuple[np.ndarray, int]:
    """The tip (m) after the straight way from pose to pose in co-simulation, and the number of snaps."""
    device = Component("device", fmu, {})
    for step in range(1, STEPS + 1):
        pose = start + (end - start) * step / STEPS
        pose[3:] /= np.linalg.norm(pose[3:])
        for name, value in zip(PLACE + TURN, pose.tolist(), strict=True):
            device.set(name, value)
        device.slave.doStep(float(step - 1), 1.0)
    tip = np.array([device.get(name) for name in TIP])
    snaps = device.slave.getInteger([device.references["stability.snaps"]])[0]
    device.close()
    return tip, snaps


def triple(text: str) -> np.ndarray:
    """Three numbers, separated by commas."""
    values = np.array([float(part) for part in text.split(",")])
    if values.shape != (3,) or not np.isfinite(values).all():
        raise argparse.ArgumentTypeError(f"{text} is not X,Y,Z")
    return values


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("fmu", type=Path, help="the manipulator's FMU, as `mcm pack` writes it")
    parser.add_argument("--tip-position-mm", type=triple, required=True, help="where the tip shall be, X,Y,Z")
    parser.add_argument(
        "--keep-away-mm", type=float, default=80.0, help="from the magnet's centre to each ring's"
    )
    arguments = parser.parse_args()

    problem, tip = Problem(arguments.fmu, arguments.keep_away_mm / 1e3), arguments.tip_position_mm / 1e3
    found = problem.solve(tip)
    problem.close()
    if not found.solved:
        raise SystemExit(f"IPOPT found no such pose in {found.iterations} iterations, {found.seconds:.2f} s")
    places = ", ".join(f"{1e3 * value:.2f}" for value in found.pose[:3])
    turns = ", ".join(f"{value:.4f}" for value in found.pose[3:])
    print(f"magnet at ({places}) mm, orientation ({turns})")
    print(f"{found.iterations} iterations, {found.evaluations} evaluations, {1e3 * found.seconds:.0f} ms")
    reached, snaps = drive(arguments.fmu, problem.start, found.pose)
    missed = 1e6 * np.linalg.norm(reached - tip)
    print(f"driven there in {STEPS} steps: {missed:.2f} um from the target, {snaps} snaps")


if __name__ == "__main__":
    main()
