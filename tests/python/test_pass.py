"""The magnet passes: the FMU answers what the command line answers."""

import csv
import math
import subprocess
import sys
from collections.abc import Callable, Iterator
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from conftest import PACKAGE, Archive, Device
from fmpy import simulate_fmu
from PIL import Image

# Relative to a quantity's usual size: the levels are solved to 1e-11.
SLACK = 1e-9
# `auto` ends a solve where its tolerances of the tip (50 um, 0.1 deg) allow, a little elsewhere on each way. Which of
# its models answers may depend on the way: not here, where these tolerances alone count.
SLACKS = {"full": SLACK, "auto": 1e-7}
STOP = 2.0

TIP = [f"tip.position[{k}]" for k in (1, 2, 3)]
# Nine segments and ten rings, m.
LENGTHS = [*[4e-3] * 9, *[1e-3] * 10]

SCENE = """
[magnet]
position_mm = [{x!r}, {y!r}, {z!r}]
orientation_wxyz = [{w!r}, {i!r}, 0.0, 0.0]
[model]
interaction = "{level}"
tolerance_relative = {relative}
"""

# JSON name, FMU name, components, usual size.
QUANTITIES = [
    ("alpha_rad", "tip.angle", 0, 1.0),
    ("tip_position_m", "tip.position", 3, 0.01),
    ("tip_orientation_wxyz", "tip.orientation", 4, 1.0),
    ("magnetic_force_n", "force.magnetic", 3, 0.01),
    ("magnetic_torque_nm", "torque.magnetic", 3, 0.001),
    ("base_reaction_force_n", "base.reaction_force", 3, 0.01),
    ("base_reaction_moment_nm", "base.reaction_moment", 3, 0.001),
    ("magnet_reaction_force_n", "magnet.reaction_force", 3, 0.01),
    ("magnet_reaction_torque_nm", "magnet.reaction_torque", 3, 0.001),
]


def pose(time: float) -> dict[str, float]:
    """Where the magnet is: it passes along the manipulator, sideways and turning a little."""
    half = (math.pi + 0.3 * time) / 2
    return {
        "magnet.position[1]": 0.01 * time,
        "magnet.position[2]": -0.125,
        "magnet.position[3]": -0.03 + 0.05 * time,
        "magnet.orientation[1]": math.cos(half),
        "magnet.orientation[2]": math.sin(half),
    }


def scene(values: dict[str, float], level: str = "auto", relative: float = 0.001) -> str:
    """The same as a scene; `relative` is the tolerance of the tip over its way, 0.001 by default."""
    x, y, z, w, i = values.values()
    return SCENE.format(x=1e3 * x, y=1e3 * y, z=1e3 * z, w=w, i=i, level=level, relative=relative)


def compare(device: Device, expected: dict, slack: float = SLACK) -> None:
    """Asserts that the outputs of a device are those of the command line."""
    rows = [(expected[key], name, n, size) for key, name, n, size in QUANTITIES]
    rows += [(p, f"ring[{k}].position", 3, 0.01) for k, p in enumerate(expected["ring_positions_m"], 1)]
    rows += [(angle, f"core[{k}].angle", 0, 1.0) for k, angle in enumerate(expected["core_angles_rad"], 1)]
    for value, name, count, size in rows:
        names = [f"{name}[{k}]" for k in range(1, count + 1)] if count else [name]
        np.testing.assert_allclose(
            device.get(names), np.atleast_1d(value), rtol=slack, atol=slack * size, err_msg=name
        )
    assert device.get(["stability.margin"])[0] == pytest.approx(expected["stability_margin"], rel=slack)
    for point, position in enumerate(expected["shape_m"], 1):
        names = [f"shape.position[{point},{axis}]" for axis in (1, 2, 3)]
        np.testing.assert_allclose(
            device.get(names), position, rtol=slack, atol=slack * 0.01, err_msg=names[0]
        )


def times(step: float) -> Iterator[float]:
    """Ends of the steps."""
    return (step * (index + 1) for index in range(round(STOP / step)))


@pytest.mark.parametrize("level", SLACKS)
@pytest.mark.parametrize("step", [0.25, 0.1])
def test_pass_equals_the_command_line(
    pack: Callable[..., Archive], solve: Callable[..., dict], step: float, level: str
) -> None:
    device = Device(pack(scene(pose(0.0), level, 0.0)))
    device.start(pose(0.0))
    compare(device, solve(scene(pose(0.0), level, 0.0)), SLACKS[level])
    for end in times(step):
        device.step(step, pose(end))
        compare(device, solve(scene(pose(end), level, 0.0)), SLACKS[level])
    assert device.status() == 0
    assert device.log == []


def test_pass_is_within_a_thousandth_of_the_way_of_the_tip(
    pack: Callable[..., Archive], solve: Callable[..., dict]
) -> None:
    device = Device(pack(scene(pose(0.0))))
    device.start(pose(0.0))
    unloaded = np.array([0.0, 0.0, sum(LENGTHS)])
    ways = []
    for end in times(0.1):
        device.step(0.1, pose(end))
        exact = solve(scene(pose(end), "full", 1e-7) + "bending_stop = true\n")["tip_position_m"]
        ways.append(np.linalg.norm(exact - unloaded))
        off = np.linalg.norm(np.array(device.get(TIP)) - exact)
        assert off <= min(5e-5, 1e-3 * ways[-1]), f"at {end} s: {off} m of {ways[-1]}"
    assert min(ways) < 0.05, "the relative tolerance decides nowhere"


def test_inputs_by_signal(default: Archive, solve: Callable[..., dict]) -> None:
    names = list(pose(0.0))
    signals = np.array(
        [(time, *pose(time).values()) for time in np.linspace(0, 1, 11)],
        dtype=[("time", float), *((name, float) for name in names)],
    )
    outputs = [*names, "tip.angle", "force.magnetic[2]"]
    result = simulate_fmu(
        str(default.path), stop_time=1.0, output_interval=0.1, input=signals, output=outputs
    )
    # The first row is the state after initialisation with the first input.
    expected = solve(scene(pose(0.0)))
    assert result["tip.angle"][0] == pytest.approx(expected["alpha_rad"], rel=SLACK)
    assert np.ptp(result["tip.angle"]) > 1e-3
    assert np.isfinite(result["force.magnetic[2]"]).all()


def test_parameters_by_start_values(default: Archive, solve: Callable[..., dict]) -> None:
    values = {
        "design.helix.length": 4.5e-3,
        "design.helix.shore_a": 30.0,
        "design.backbone.present": True,
        "design.backbone.outer_radius": 0.5e-3,
        "magnet.design.cylinder[1].remanence": 1.2,
        "model.interaction": 0,  # none
        "gravity[2]": -9.81,
    }
    outputs = ["tip.angle", "tip.position[2]"]
    result = simulate_fmu(
        str(default.path), stop_time=0.1, output_interval=0.1, start_values=values, output=outputs
    )
    cylinder = "{{ radius_mm = 22.5, length_mm = 30.0, offset_mm = {}, remanence_t = {} }}"
    expected = solve(
        f"""
[design.helix]
length_mm = 4.5
shore_a = 30.0
[design.backbone]
outer_radius_mm = 0.5
inner_radius_mm = 0.25
shore_a = 50.0
poisson = 0.4
[magnet]
position_mm = [0.0, -120.0, 23.0]
cylinders = [{cylinder.format(-20.0, 1.2)}, {cylinder.format(20.0, 1.35)}]
[gravity]
acceleration_m_s2 = [0.0, -9.81, 0.0]
[model]
interaction = "none"
"""
    )
    assert result["tip.angle"][-1] == pytest.approx(expected["alpha_rad"], rel=SLACK)
    assert result["tip.position[2]"][-1] == pytest.approx(expected["tip_position_m"][1], rel=SLACK)


def test_a_packed_scene_starts_as_the_command_line_solves_it(
    pack: Callable[..., Archive], solve: Callable[..., dict]
) -> None:
    text = """
[design]
segments = 3
[field]
uniform_mt = [1.0, 5.0, 0.0]
gradient_t_per_m = [0.1, 0.0, 0.2, -0.05, 0.0]
[base]
position_mm = [1.0, 2.0, 3.0]
orientation_wxyz = [0.6, 0.0, 0.8, 0.0]
[load]
tip_force_n = [0.0, 0.001, 0.0]
"""
    device = Device(pack(text, "--shape-points", "7")).start()
    compare(device, solve(text, 7))
    device.slave.freeInstance()


def test_the_demonstration_leaves_a_table_and_an_animation_that_loops(
    default: Archive, tmp_path: Path
) -> None:
    script = PACKAGE / "fmu" / "demo.py"
    run = [sys.executable, script, default.path, "--no-search"]
    done = subprocess.run(run, cwd=tmp_path, capture_output=True, text=True, check=False, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    with (tmp_path / "mcm_demo.csv").open() as file:
        rows = list(csv.DictReader(file))
    first, last = ({name: float(value) for name, value in row.items()} for row in (rows[0], rows[-1]))
    assert last["snaps"] == 0
    for name in ("magnet_z_mm", "magnet_turn_deg", "tip_angle_deg", "stability_margin"):
        assert last[name] == pytest.approx(first[name], rel=1e-4, abs=1e-9), (
            f"{name} at the end as at the start"
        )
    assert all(float(row["largest_core_angle_deg"]) < float(row["boundary_angle_deg"]) for row in rows)
    picture = tmp_path / "mcm_demo.gif"
    assert picture.stat().st_size < 3_000_000
    with Image.open(picture) as film:
        assert film.info["loop"] == 0, "forever"
        assert film.n_frames > 60
        frames = []
        for index in range(film.n_frames):
            film.seek(index)
            frames.append(np.asarray(film.convert("RGB"), dtype=int))
            assert film.info["duration"] * film.n_frames in range(8_000, 12_001)
    moved = [np.abs(frame - before).max() for before, frame in pairwise(frames)]
    assert min(moved) > 50, "each frame differs from the one before"
