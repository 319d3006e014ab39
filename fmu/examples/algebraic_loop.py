"""An arm that holds the tip: an algebraic loop, by delay, by repetition and by Newton's method with the exact Jacobian.

    mcm pack --out mcm.fmu
    .venv/bin/python fmu/examples/algebraic_loop.py mcm.fmu --stiffness 20

The arm's fingers are a spring: they press on the tip with `stiffness * (fingers - tip)`, and the tip moves at once
with the force. So the force depends on itself. What a round makes of an error of the force is the gain, stiffness times
compliance of the tip: up to 1, a delay of a step (Jacobi scheme) or repeating the exchange settles, beyond 1 both
diverge. Newton's method needs the derivatives of the tip by its load, which the FMU knows exactly.
"""

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from component import Component
from fmpy.fmi1 import FMICallException

TIP = [f"tip.position[{axis}]" for axis in (1, 2, 3)]
LOAD = [f"tip.load_force[{axis}]" for axis in (1, 2, 3)]
# One model for all rounds: `auto` may take another one as the load changes, within `model.tolerance_*`.
LEVEL = {"model.interaction": 3}  # full
WAY = np.array([2e-3, 0.0, 0.0])  # m, that the fingers go sideways
STEPS = 20
STEP = 0.05  # communication step, s
SETTLED = 1e-9  # N
ROUNDS = 30  # at most, of an exchange
LOST = 1.0  # N: a force beyond is none that a device of these forces survives


@dataclass
class Loop:
    """The device, and the fingers on its tip."""

    device: Component
    stiffness: float  # N/m

    def __post_init__(self) -> None:
        """Remembers where the tip is without the fingers."""
        self.start = self.tip()

    def tip(self) -> np.ndarray:
        """Position of the tip (m) for the inputs now set."""
        return np.array([self.device.get(name) for name in TIP])

    def load(self, force: np.ndarray) -> None:
        """Sets the force on the tip, N."""
        for name, value in zip(LOAD, force.tolist(), strict=True):
            self.device.set(name, value)

    def answer(self, force: np.ndarray, share: float) -> np.ndarray:
        """The force of the fingers, `share` of their way gone, on the tip that bears `force`."""
        self.load(force)
        return self.stiffness * (self.start + share * WAY - self.tip())

    def compliance(self) -> np.ndarray:
        """Derivatives of the tip's position by the force on it, m/N, exact."""
        return np.array([[self.device.derivative(of, by) for by in LOAD] for of in TIP])


def delayed(loop: Loop, force: np.ndarray, share: float) -> tuple[np.ndarray, int]:
    """The force that the fingers had at the end of the last step."""
    return loop.answer(force, share), 1


def repeated(loop: Loop, force: np.ndarray, share: float) -> tuple[np.ndarray, int]:
    """The exchange, repeated until the force stays."""
    for rounds in range(1, ROUNDS + 1):
        answered = loop.answer(force, share)
        if np.linalg.norm(answered - force) < SETTLED:
            return answered, rounds
        if np.linalg.norm(answered) > LOST:
            break
        force = answered
    raise ArithmeticError(f"the exchange has not settled in {rounds} rounds")


def newton(loop: Loop, force: np.ndarray, share: float) -> tuple[np.ndarray, int]:
    """The zero of `force - answer(force)`, by its exact Jacobian."""
    for rounds in range(1, ROUNDS + 1):
        missing = force - loop.answer(force, share)
        if np.linalg.norm(missing) < SETTLED:
            return force, rounds
        force = force - np.linalg.solve(np.eye(3) + loop.stiffness * loop.compliance(), missing)
    raise ArithmeticError(f"Newton's method has not settled in {rounds} rounds")


Scheme = Callable[[Loop, np.ndarray, float], tuple[np.ndarray, int]]
SCHEMES: dict[str, Scheme] = {"delay": delayed, "repetition": repeated, "Newton": newton}


def run(fmu: Path, stiffness: float, scheme: Scheme) -> str:
    """Moves the fingers; what came of it."""
    device = Component("device", fmu, LEVEL)
    loop, force, rounds = Loop(device, stiffness), np.zeros(3), 0
    try:
        for step in range(STEPS):
            force, needed = scheme(loop, force, (step + 1) / STEPS)
            if np.linalg.norm(force) > LOST:
                raise ArithmeticError(f"the force has grown to {np.linalg.norm(force):.1f} N")
            loop.load(force)
            device.slave.doStep(step * STEP, STEP)
            rounds += needed
        missing = np.linalg.norm(force - loop.answer(force, 1.0))
    except (ArithmeticError, FMICallException) as reason:
        said = reason if isinstance(reason, ArithmeticError) else "no equilibrium for such a force"
        return f"diverges at step {step + 1}: {said}"
    finally:
        device.close()
    parts = ", ".join(f"{1e3 * part:.4f}" for part in force)
    return f"force ({parts}) mN, off by {1e3 * missing:.1e} mN, {rounds} rounds"


def gain(fmu: Path, stiffness: float) -> float:
    """What a round makes of an error of the force, at the start."""
    device = Component("device", fmu, LEVEL)
    loop = Loop(device, stiffness)
    factor = stiffness * np.linalg.norm(loop.compliance(), 2)
    device.close()
    return factor


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("fmu", type=Path, help="the manipulator's FMU, as `mcm pack` writes it")
    parser.add_argument("--stiffness", type=float, default=20.0, help="of the fingers, N/m")
    arguments = parser.parse_args()
    if not arguments.stiffness > 0:
        raise SystemExit(f"--stiffness {arguments.stiffness}: must be above 0 N/m")
    print(f"stiffness {arguments.stiffness} N/m, gain {gain(arguments.fmu, arguments.stiffness):.2g}")
    for name, scheme in SCHEMES.items():
        print(f"{name}: {run(arguments.fmu, arguments.stiffness, scheme)}")


if __name__ == "__main__":
    main()
