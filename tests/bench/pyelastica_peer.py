"""Peer: PyElastica's explicit dynamics, damped until it rests, on the rod with a dipole at its tip of `solve_bvp_peer`.

The first and the last element are half outside the rod: so it has as many joints as fit its length, a constant moment
bends them to exactly its angle, and what is left of the error is how far it has settled. Density and radius do not
change where it rests: they make the waves of bending and of stretching equally fast, and so the step as long as it can
be.

fmu/venv tests/bench/requirements.txt
.venv/bin/python tests/bench/pyelastica_peer.py
"""

import time

import elastica
import numpy as np
from solve_bvp_peer import AXIAL, BENDING, FIELD, LENGTH, MOMENT, SHEAR, TORSION, Measured, closed_form

DENSITY = 1e9  # kg/m3
STEP = 0.9  # of the time in which a wave passes an element; beyond 1 it is unstable
DAMPING = 1.4  # of the lowest frequency of bending: with half or twice as much it settles later
SETTLED = 1e-9  # rad in a period of that frequency


class Simulator(elastica.BaseSystemCollection, elastica.Constraints, elastica.Forcing, elastica.Damping):
    """One rod, clamped, loaded and damped."""


class TipDipole(elastica.NoForces):
    """The couple of a uniform field on a dipole in the last element."""

    def __init__(self, field: np.ndarray) -> None:
        super().__init__()
        self.field = field

    def apply_torques(self, system, time: float = 0.0) -> None:
        """Torques count in the element's own axes."""
        x, y, z = system.director_collection[2, :, -1]
        a, b, c = self.field
        couple = MOMENT * np.array([y * c - z * b, z * a - x * c, x * b - y * a])
        system.external_torques[:, -1] += system.director_collection[:, :, -1] @ couple


class Rod:
    """A rod of so many elements, at rest."""

    def __init__(self, elements: int, field: np.ndarray) -> None:
        element = LENGTH / (elements - 1)
        radius = 2 * np.sqrt(BENDING / AXIAL)  # that of a round section: both waves are equally fast
        length, area = elements * element, np.pi * radius**2
        self.rod = elastica.CosseratRod.straight_rod(
            elements,
            np.zeros(3),
            np.array([0.0, 0.0, 1.0]),
            np.array([1.0, 0.0, 0.0]),
            length,
            radius,
            DENSITY,
            youngs_modulus=AXIAL / area,
        )
        self.rod.shear_matrix[:] = np.diag([SHEAR, SHEAR, AXIAL])[:, :, None]
        self.rod.bend_matrix[:] = np.diag([BENDING, BENDING, TORSION])[:, :, None]
        self.field = field.copy()
        frequency = 3.516 * np.sqrt(BENDING / (DENSITY * area)) / LENGTH**2  # rad/s, of a cantilever
        self.step = STEP * element / np.sqrt(AXIAL / (DENSITY * area))
        self.period = max(1, round(2 * np.pi / frequency / self.step))
        self.simulator = Simulator()
        self.simulator.append(self.rod)
        self.simulator.constrain(self.rod).using(
            elastica.OneEndFixedBC, constrained_position_idx=(0,), constrained_director_idx=(0,)
        )
        self.simulator.add_forcing_to(self.rod).using(TipDipole, field=self.field)
        self.simulator.dampen(self.rod).using(
            elastica.AnalyticalLinearDamper,
            uniform_damping_constant=DAMPING * frequency,
            time_step=self.step,
        )
        self.simulator.finalize()
        self.stepper, self.now = elastica.PositionVerlet(), 0.0

    def angle(self) -> float:
        """Angle of the last element, rad."""
        x, y, z = self.rod.director_collection[2, :, -1]
        return float(np.arctan2(np.hypot(x, y), z))

    def settle(self) -> float:
        """Steps until the angle rests; the time that takes, s."""
        start, before = time.perf_counter(), np.inf
        while abs(self.angle() - before) > SETTLED:
            before = self.angle()
            for _ in range(self.period):
                self.now = self.stepper.step(self.simulator, self.now, self.step)
        return time.perf_counter() - start


def measure(elements: int, repeats: int = 5) -> Measured:
    """Times and error with so many elements; warm starts from the shape in a field turned by 0.1 deg."""
    field, turn = np.array([0.0, FIELD, 0.0]), np.radians(0.1)
    Rod(elements, field).settle()  # compiles
    cold, warm = [], []
    for _ in range(repeats):
        rod = Rod(elements, FIELD * np.array([0.0, np.cos(turn), np.sin(turn)]))
        cold.append(rod.settle())
        rod.field[:] = field
        warm.append(rod.settle())
    return Measured(
        setting=f"{elements} elements",
        cold=float(np.median(cold)),
        warm=float(np.median(warm)),
        error=abs(rod.angle() - closed_form()),
    )


if __name__ == "__main__":
    for row in map(measure, (4, 8, 16)):
        print(f"{row.setting}: cold {row.cold:.2e} s, warm {row.warm:.2e} s, error {row.error:.1e} rad")
