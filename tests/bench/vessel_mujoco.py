"""Peer: MuJoCo on a rod in a vessel, a chain of capsules with springs in its joints between walls, without friction.

A clamped rod with a moment at its tip between two walls touches at M1 = 2 K c / L^2, and then its tip presses with
3 (M - M1) / (2 L). And a rod is pushed into a bent tube: sqrt((rho + c)^2 - rho^2) behind the beginning of the bend its
tip meets the outer wall, and then slides along it.

MuJoCo has no statics: the rod is damped until it rests. Joints have the stiffness of what lies between the middles of
their links, so that a constant moment bends the rod to exactly its angle. Each joint's own inertia and damping give all
the same time to settle, beside which the links' mass is small; otherwise the stiffest joint dictates the step, and the
contact does not come to rest. Lengths are in rods, forces in K / L^2, times in the joints' own.

fmu/venv tests/bench/mujoco.txt
.venv/bin/python tests/bench/vessel_mujoco.py
.venv/bin/python tests/bench/vessel_mujoco.py rod_between_walls.fmu     beside our own
"""

import sys
import time
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

ROD = {"length": 0.05, "bending": 1.3e-6, "gap": GAP * 0.05}  # of the FMU, SI


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


def ours(fmu: Path) -> list[Row]:
    """The clamped rod in an FMU of ours: a rod of `ROD`, clamped along z, in a straight vessel wider by the gap."""
    description = read_model_description(fmu)
    number = {variable.name: variable.valueReference for variable in description.modelVariables}
    names = ("contact.largest_force", "contact.largest_indentation")
    if missing := [name for name in names if name not in number]:
        raise SystemExit(f"{fmu} has no {', '.join(missing)}")
    slave = instantiate_fmu(extract(fmu), description, "CoSimulation")
    slave.setupExperiment()
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    length, touching = ROD["length"], 2 * ROD["bending"] * ROD["gap"] / ROD["length"] ** 2
    rows = []
    for now, moment in enumerate(MOMENTS):
        slave.setReal([number["tip.load_moment[1]"]], [moment * touching])
        start = time.perf_counter()
        slave.doStep(now, 1.0)
        force, indented = slave.getReal([number[name] for name in names])
        seconds = time.perf_counter() - start
        error = force * 2 * length / (3 * (moment - 1) * touching) - 1
        rows.append(Row(f"M = {moment:g} M1", "ours", 1, error, indented / ROD["gap"], 1, seconds))
    slave.terminate()
    slave.freeInstance()
    return rows


def main() -> None:
    """Prints both cases as a table in Markdown."""
    print(
        f"MuJoCo {version('mujoco')}. Error: of the tip's force; in the bend the worst of its place, in gaps.\n"
    )
    print("| case | setting | bodies | error | indentation (gaps) | steps | ms a solve | never at rest |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for setting in SETTINGS:
        print(*between_walls(*setting), sep="\n")
    if len(sys.argv) > 1:
        print(*ours(Path(sys.argv[1])), sep="\n")
    for setting in BEND_SETTINGS:
        row, late = round_a_bend(*setting)
        if not 0 <= late <= INCREMENT:
            raise RuntimeError(f"{row.setting}: the tip touches {late} too late")
        print(row)


if __name__ == "__main__":
    main()
