"""Peer: MuJoCo on a rod in a vessel, a chain of capsules with springs in its joints between walls, without friction.

A clamped rod with a moment at its tip between two walls touches at M1 = 2 K c / L^2, and then its tip presses with
3 (M - M1) / (2 L). And a rod is pushed into a bent tube: sqrt((rho + c)^2 - rho^2) behind the beginning of the bend its
tip meets the outer wall, and then slides along it.

MuJoCo has no statics: the rod is damped until it rests. Joints have the stiffness of what lies between the middles of
their links, so that a constant moment bends the rod to exactly its angle. Each joint's own inertia and damping give all
the same time to settle, beside which the links' mass is small; otherwise the stiffest joint dictates the step, and the
contact does not come to rest. Lengths are in rods, forces in K / L^2, times in the joints' own.

Ours are FMUs of the same rods in tubes, moved and loaded in the same steps; their time includes the calls by fmpy.

cargo build --release; fmu/venv tests/bench/mujoco.txt
.venv/bin/python tests/bench/vessel_mujoco.py     with target/release/mcm, or MCM_BIN
"""

import os
import subprocess
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

import mujoco
import numpy as np
from fmpy import extract, read_model_description
from fmpy.simulation import instantiate_fmu

GAP = 1 / 200  # from the rod to a wall: slopes are small, and the closed form is good to 1e-4
THICK = 0.01  # radius of the rod; walls are farther by it
MOMENTS = (2.0, 5.0, 10.0)  # in M1; beyond 19.9 the opposite wall is touched
BEND, SLACK = 0.5, 0.02  # radius of the tube's bend and of its lumen, less that of the rod
PUSHED, INCREMENT = 0.75, 0.01  # how far beyond the beginning of the bend, and in which steps
STEP = 0.2  # between walls, with half of it the forces change by 1e-4 and it takes twice as many
SETTINGS = ((10, 0.999), (20, 0.95), (20, 0.999), (40, 0.999))  # links, impedance of a contact
BEND_SETTINGS = (
    (10, 0.2, 5),
    (20, 0.2, 5),
    (20, 0.05, 1.5),
    (40, 0.05, 1.5),
)  # links, step, boxes of the wall (deg)
SETTLED, MOST = 1e-8, 2000  # rad in a joint's own time; steps: on edges between boxes some never rest
REPEATS = 9  # of solves between walls, for the median time

PACKAGE = Path(__file__).resolve().parents[2]
LENGTH, BENDING = 0.05, 1.3e-6  # of our rods, SI: m, N m2
ELEMENTS = 8  # of our rods: the default
WALLS = (1.0, 10.0, 1e3)  # of our vessels, MPa; the rod's own modulus is 26 MPa
BEND_WALLS = (1.0, 10.0)  # from 100 MPa on a step into the bend uses up its iterations


def joined(links: int, impedance: float, step: float, base: str, walls: str) -> mujoco.MjModel:
    """A chain of links along x between walls; `base` holds its first half link."""
    link = 1 / links
    joint = f'<joint type="hinge" axis="0 1 0" stiffness="{links}" damping="{2 * links}" armature="{links}"/>'
    bodies = ""
    for number in reversed(range(links)):
        length = link if number < links - 1 else link / 2
        name = ' name="tip"' if number == links - 1 else ""
        geom = f'<geom{name} type="capsule" fromto="0 0 0 {length} 0 0" size="{THICK}"/>'
        bodies = f'<body pos="{link if number else link / 2} 0 0">{joint}{geom}{bodies}</body>'
    return mujoco.MjModel.from_xml_string(
        f"""<mujoco><option gravity="0 0 0" timestep="{step}" integrator="implicitfast"/>
        <default><geom condim="1" density="0.01" contype="1" conaffinity="2"
            solref="{2 * step} 1" solimp="{impedance} {impedance} 0.001"/>
        <default class="wall"><geom contype="2" conaffinity="1"/></default></default>
        <worldbody>{walls}<body mocap="true" pos="{base}">{bodies}</body></worldbody></mujoco>"""
    )


def settle(model: mujoco.MjModel, data: mujoco.MjData) -> tuple[int, float, bool]:
    """Steps until nothing moves; the time that took, s, and whether it came to that."""
    start = time.perf_counter()
    for step in range(1, MOST + 1):
        mujoco.mj_step(model, data)
        if rests := step > 2 and np.abs(data.qvel).max() < SETTLED:
            break
    return step, time.perf_counter() - start, rests


def tip(model: mujoco.MjModel, data: mujoco.MjData) -> np.ndarray:
    """Position of the rod's end."""
    geom = model.geom("tip").id
    body = model.geom_bodyid[geom]
    return data.xpos[body] + 2 * data.xmat[body].reshape(3, 3)[:, 0] * model.geom_size[geom, 1]


@dataclass
class Row:
    """What one setting reached: errors relative to the closed form, and what a solve took."""

    case: str
    setting: str
    bodies: int
    error: float
    indentation: float  # in gaps
    steps: float
    seconds: float
    restless: int = 0  # solves that did not come to rest

    def __str__(self) -> str:
        """A row of the table."""
        numbers = f"{self.error:+.1e} | {self.indentation:.1e} | {self.steps:.0f} | {1e3 * self.seconds:.3g}"
        return f"| {self.case} | {self.setting} | {self.bodies} | {numbers} | {self.restless} |"


def between_walls(links: int, impedance: float) -> list[Row]:
    """The clamped rod under moments at its tip, each from the straight rod."""
    wall = '<geom class="wall" type="plane" pos="0 0 {}" zaxis="0 0 {}" size="2 2 1"/>'
    walls = wall.format(GAP + THICK, -1) + wall.format(-GAP - THICK, 1)
    model = joined(links, impedance, STEP, "0 0 0", walls)
    last = model.geom_bodyid[model.geom("tip").id]
    rows = []
    for moment in MOMENTS:
        solves = []
        for _ in range(REPEATS):
            data = mujoco.MjData(model)
            data.xfrc_applied[last, 4] = -moment * 2 * GAP
            solves.append(settle(model, data))
        steps, seconds, rests = np.median(solves, axis=0)
        pressing = (
            data.efc_force.sum()
        )  # each contact without friction is one constraint, and there are no others
        error = pressing / (3 * (moment - 1) * GAP) - 1
        indented = tip(model, data)[2] / GAP - 1
        names = (f"M = {moment:g} M1", f"impedance {impedance}")
        rows.append(Row(*names, links, error, indented, steps, seconds, int(not rests)))
    return rows


def round_a_bend(links: int, step: float, facet: float) -> tuple[Row, float]:
    """The rod that is pushed into a bend towards +z; and how far it was pushed on before the tip touched."""
    lumen = SLACK + THICK
    box = '<geom class="wall" type="box" pos="{} 0 {}" euler="0 {} 0" size="{} 1 0.05"/>'
    walls = box.format(-1, -lumen - 0.05, 0, 1) + box.format(-1, lumen + 0.05, 0, 1)
    outer = BEND + lumen + 0.05
    for turn in np.arange(facet / 2, 110, facet):
        across, along = np.sin(np.radians(turn)), np.cos(np.radians(turn))
        walls += box.format(outer * across, BEND - outer * along, -turn, 0.55 * outer * np.radians(facet))
    walls += f'<geom class="wall" type="cylinder" pos="0 0 {BEND}" euler="90 0 0" size="{BEND - lumen} 1"/>'
    model = joined(links, 0.999, step, "-1 0 0", walls)
    data = mujoco.MjData(model)
    solves, worst, touched = [], 0.0, None
    for pushed in np.arange(INCREMENT, PUSHED, INCREMENT):
        data.mocap_pos[0, 0] = pushed - 1
        solves.append(settle(model, data))
        if touched is None and data.ncon:
            touched = pushed
        if touched is not None:
            x, _, z = tip(model, data)
            worst = max(worst, (np.hypot(x, z - BEND) - BEND) / SLACK - 1, key=abs)
    setting = f"steps of {step}, boxes of {facet} deg"
    steps, seconds, _ = np.mean(solves, axis=0)
    restless = sum(not rests for *_, rests in solves)
    row = Row("bend", setting, links, worst, max(worst, 0), steps, seconds, restless)
    return row, touched - np.sqrt((BEND + SLACK) ** 2 - BEND**2)


class Ours:
    """A rod of ours in a tube, as an FMU; lengths and forces in the units of the others."""

    def __init__(self, centreline: Sequence[tuple[float, float]], slack: float, wall: float) -> None:
        """Clamped along z at the origin; the tube's centreline (x, z) and slack, its wall's modulus in MPa."""
        points = ", ".join(f"[{1e3 * LENGTH * x}, 0.0, {1e3 * LENGTH * z}]" for x, z in centreline)
        radius = LENGTH * THICK
        scene = f"""
            design = {{ kind = "cylinder", length_mm = {1e3 * LENGTH}, radius_mm = {1e3 * radius},
                elastic_modulus_mpa = {4e-6 * BENDING / (np.pi * radius**4)}, remanence_t = 0.0, density_kg_m3 = 0.0 }}
            magnet = {{ strength = 0.0 }}
            model = {{ interaction = "none" }}
            [vessel]
            wall_modulus_mpa = {wall}
            [[vessel.branch]]
            name = "tube"
            points_mm = [{points}]
            radius_mm = {1e3 * (radius + LENGTH * slack)}
        """
        with tempfile.TemporaryDirectory() as folder:
            file, fmu = Path(folder, "rod.toml"), Path(folder, "rod.fmu")
            file.write_text(scene)
            mcm = os.environ.get("MCM_BIN", PACKAGE / "target" / "release" / "mcm")
            subprocess.run(
                [mcm, "pack", "--scene", file, "--out", fmu], check=True, stdout=subprocess.DEVNULL
            )
            description = read_model_description(fmu)
            self.slave = instantiate_fmu(extract(fmu), description, "CoSimulation")
        self.number = {variable.name: variable.valueReference for variable in description.modelVariables}
        self.slave.setupExperiment()
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()
        self.now = 0.0

    def step(self, name: str, value: float, unit: float) -> float:
        """Sets an input; the time of the step, s."""
        start = time.perf_counter()
        self.slave.setReal([self.number[name]], [value * unit])
        self.slave.doStep(self.now, 1.0)
        self.now += 1.0
        return time.perf_counter() - start

    def get(self, *names: str) -> np.ndarray:
        """Outputs, SI."""
        return np.array(self.slave.getReal([self.number[name] for name in names]))

    def close(self) -> None:
        """Frees the instance."""
        self.slave.terminate()
        self.slave.freeInstance()


def ours_between_walls(wall: float) -> list[Row]:
    """Our clamped rod under moments at its tip, each from the straight rod."""
    rod, rows = Ours([(0, -1), (0, 0.5), (0, 2)], GAP, wall), []
    for moment in MOMENTS:
        times = []
        for _ in range(REPEATS):
            rod.step("tip.load_moment[2]", 0.0, 1.0)
            times.append(rod.step("tip.load_moment[2]", moment * 2 * GAP, BENDING / LENGTH))
        force = np.linalg.norm(rod.get(*(f"contact.force[{k}]" for k in (1, 2, 3)))) * LENGTH**2 / BENDING
        indented = rod.get("contact.largest_indentation")[0] / (GAP * LENGTH)
        error = force / (3 * (moment - 1) * GAP) - 1
        seconds = float(np.median(times))
        rows.append(
            Row(f"M = {moment:g} M1", f"ours, wall of {wall:g} MPa", ELEMENTS, error, indented, 1, seconds)
        )
    rod.close()
    return rows


def ours_round_a_bend(wall: float) -> tuple[Row, float]:
    """Our rod that is pushed into a bend towards +x; and how far it was pushed on before the tip touched."""
    ahead = [(0.0, z) for z in np.arange(-1.2, 0.0, 0.02)]
    turns = np.radians(np.arange(0, 111, 1.0))
    bent = zip(BEND * (1 - np.cos(turns)), BEND * np.sin(turns), strict=True)
    rod = Ours([(x, z + 1) for x, z in [*ahead, *bent]], SLACK, wall)
    times, worst, deepest, touched = [], 0.0, 0.0, None
    for pushed in np.arange(INCREMENT, PUSHED, INCREMENT):
        times.append(rod.step("base.position[3]", pushed, LENGTH))
        indented = rod.get("contact.largest_indentation")[0] / (SLACK * LENGTH)
        deepest = max(deepest, indented)
        if touched is None and indented > 0:
            touched = pushed
        if touched is not None:
            x, z = rod.get("tip.position[1]", "tip.position[3]") / LENGTH
            worst = max(worst, (np.hypot(x - BEND, z - 1) - BEND) / SLACK - 1, key=abs)
    rod.close()
    row = Row("bend", f"ours, wall of {wall:g} MPa", ELEMENTS, worst, deepest, 1, float(np.mean(times)))
    return row, touched - np.sqrt((BEND + SLACK) ** 2 - BEND**2)


def main() -> None:
    """Prints both cases as a table in Markdown."""
    print(
        f"MuJoCo {version('mujoco')}. Error: of the tip's force; in the bend the worst of its place, in gaps.\n"
    )
    print(
        "| case | setting | bodies, elements | error | indentation (gaps) | steps | ms a solve | never at rest |"
    )
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for setting in SETTINGS:
        print(*between_walls(*setting), sep="\n")
    for wall in WALLS:
        print(*ours_between_walls(wall), sep="\n")
    bends = [(round_a_bend, setting) for setting in BEND_SETTINGS]
    for bend, setting in bends + [(ours_round_a_bend, (wall,)) for wall in BEND_WALLS]:
        row, late = bend(*setting)
        if not 0 <= late <= INCREMENT:
            raise RuntimeError(f"{row.setting}: the tip touches {late} too late")
        print(row)


if __name__ == "__main__":
    main()
