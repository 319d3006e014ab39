"""Peer: scipy's solve_bvp on a rod with a dipole at its tip, a 3-D Cosserat rod with extension and shear.

The core of one segment, 2.698 mm long, carries a ring magnet at its tip in a field of 20 mT across it.
The moment is the same everywhere, so the angle solves theta = Lam sin(phi - theta).

fmu/venv tests/bench/requirements.txt
.venv/bin/python tests/bench/solve_bvp_peer.py
"""

import time
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_bvp
from scipy.optimize import brentq

LENGTH = 2.698e-3  # m
BENDING = 1.3008e-6  # E I, N m2
TORSION = 2 * BENDING / 2.8  # G J of a round section with Poisson's ratio 0.4, N m2
SHEAR = 7.1 * BENDING / LENGTH**2  # G A, N
AXIAL = 19.9 * BENDING / LENGTH**2  # E A, N
MOMENT = 0.0116  # A m2
FIELD = 0.02  # T


def turned(q: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Vectors `v` turned by unit quaternions `q` (w, x, y, z), one per column."""
    w, r = q[0], q[1:]
    across = 2 * np.cross(r, v, axis=0)
    return v + w * across + np.cross(r, across, axis=0)


def slope(_s: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Derivative along the arc of position, quaternion, force and moment."""
    q, n, m = y[3:7], y[7:10], y[10:13]
    back = np.array([q[0], -q[1], -q[2], -q[3]])
    u = turned(back, m) / np.array([[BENDING], [BENDING], [TORSION]])
    v = turned(back, n) / np.array([[SHEAR], [SHEAR], [AXIAL]]) + np.array([[0.0], [0.0], [1.0]])
    dp = turned(q, v)
    dq = 0.5 * np.vstack([-np.sum(q[1:] * u, axis=0), q[0] * u + np.cross(q[1:], u, axis=0)])
    return np.vstack([dp, dq, np.zeros_like(n), -np.cross(dp, n, axis=0)])


def ends(field: np.ndarray):
    """Clamped base; at the tip no force, and the moment of the dipole."""

    def residual(base: np.ndarray, tip: np.ndarray) -> np.ndarray:
        axis = turned(tip[3:7, None], np.array([[0.0], [0.0], [1.0]]))[:, 0]
        clamp = base[:7] - np.array([0, 0, 0, 1, 0, 0, 0])
        return np.concatenate([clamp, tip[7:10], tip[10:13] - MOMENT * np.cross(axis, field)])

    return residual


@dataclass
class Measured:
    """One setting of a peer: times of a solve (s) and the error of the angle (rad)."""

    setting: str
    cold: float
    warm: float
    error: float


def straight() -> tuple[np.ndarray, np.ndarray]:
    """Mesh and state of the unloaded rod."""
    s = np.linspace(0, LENGTH, 5)
    y = np.zeros((13, s.size))
    y[2], y[3] = s, 1.0
    return s, y


def solved(field: np.ndarray, tolerance: float, guess: tuple[np.ndarray, np.ndarray]):
    """The solution in this field from this guess."""
    solution = solve_bvp(slope, ends(field), *guess, tol=tolerance, max_nodes=100_000)
    if not solution.success:
        raise RuntimeError(solution.message)
    return solution


def angle(solution) -> float:
    """Angle of the tip, rad."""
    q = solution.y[3:7, -1:]
    axis = turned(q, np.array([[0.0], [0.0], [1.0]]))[:, 0]
    return float(np.arctan2(np.hypot(axis[0], axis[1]), axis[2]))


def closed_form() -> float:
    """Angle of the tip in the field across, rad."""
    lam = MOMENT * FIELD * LENGTH / BENDING
    return brentq(lambda theta: theta - lam * np.cos(theta), 0.0, 1.5, xtol=1e-15)


def median_time(call, repeats: int) -> float:
    """Median time of a call, s."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return float(np.median(times))


def measure(tolerance: float, repeats: int = 21) -> Measured:
    """Times and error at one tolerance; warm starts from the solution in a field turned by 0.1 deg."""
    field = np.array([0.0, FIELD, 0.0])
    turn = np.radians(0.1)
    before = solved(FIELD * np.array([0.0, np.cos(turn), np.sin(turn)]), tolerance, straight())
    guess = (before.x, before.y)
    return Measured(
        setting=f"tol {tolerance:.0e}",
        cold=median_time(lambda: solved(field, tolerance, straight()), repeats),
        warm=median_time(lambda: solved(field, tolerance, guess), repeats),
        error=abs(angle(solved(field, tolerance, guess)) - closed_form()),
    )


if __name__ == "__main__":
    for row in map(measure, (1e-3, 1e-6, 1e-9)):
        print(f"{row.setting}: cold {row.cold:.2e} s, warm {row.warm:.2e} s, error {row.error:.1e} rad")
