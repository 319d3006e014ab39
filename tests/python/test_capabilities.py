"""Every capability that the description promises, used as a host does."""

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from conftest import PACKAGE, Archive, Device

ROUNDING = 1e-12

# Differences of fourth order, step 1e-3 of an input's usual size: rounding of a solve, 1e-11, over the step.
DIFFERENCE = 3e-7
STEP = 1e-3

# Continues a run from a file of bytes, in a process of its own; prints all answers.
CONTINUE = """
import sys
from pathlib import Path
from conftest import Archive, Device
from test_capabilities import drive
archive, state, folder = map(Path, sys.argv[1:])
device = Device(Archive(archive, folder))
device.slave.setFMUstate(device.slave.deSerializeFMUstate(state.read_bytes()))
device.time = 0.4
print(drive(device))
"""


def drive(device: Device) -> list[list[str]]:
    """A short run and all that it answers, to the last bit."""
    rows = []
    for index in range(3):
        device.step(0.1, {"magnet.position[1]": 0.01 * index, "magnet.position[2]": -0.125 + 0.002 * index})
        rows.append([value.hex() for value in device.get(device.reals())])
    return rows


def test_a_state_goes_on_in_another_process(default: Archive, device: Device, tmp_path: Path) -> None:
    device.start()
    for _ in range(4):
        device.step(0.1, {"magnet.position[3]": 0.03})
    state = device.slave.getFMUstate()
    (tmp_path / "state").write_bytes(device.slave.serializeFMUstate(state))
    device.slave.freeFMUstate(state)
    done = subprocess.run(
        [sys.executable, "-c", CONTINUE, default.path, tmp_path / "state", tmp_path / "unpacked"],
        capture_output=True,
        text=True,
        check=False,
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(PACKAGE / "tests" / "python")},
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == str(drive(device))


def test_derivatives_are_what_differences_say(pack: Callable[..., Archive]) -> None:
    # Differences need shapes that end closer to equilibrium than the default tolerance asks for.
    device = Device(pack("[design]\nsegments = 2\n[magnet]", "--shape-points", "4"))
    device.start({"model.tolerance_position": 1e-6, "model.tolerance_angle": 1e-4})
    device.set({"field.uniform[1]": 0.003, "tip.load_force[3]": 0.002})
    variables = device.archive.variables.values()
    outputs = [v.name for v in variables if v.causality == "output" and v.variability == "continuous"]
    state = device.slave.getFMUstate()

    def at(name: str, value: float) -> np.ndarray:
        device.slave.setFMUstate(state)
        device.set({name: value})
        return np.array(device.get(outputs))

    usual = {"magnet.position[3]": 0.05, "field.uniform[2]": 0.01, "tip.load_moment[1]": 1e-5}
    usual |= {"magnet.orientation[4]": 0.1, "base.orientation[3]": 0.1, "ring[2].load_force[1]": 0.005}
    exact, errors = [], []
    for name, size in usual.items():
        device.slave.setFMUstate(state)
        arguments = device.references(outputs), device.references([name]), [size]
        exact.append(device.slave.getDirectionalDerivative(*arguments))
        (value,) = device.get([name])
        far, near, after, last = (at(name, value + k * STEP * size) for k in (-2, -1, 1, 2))
        errors.append((8 * (after - near) - (last - far)) / (12 * STEP) - exact[-1])
    for kind in {output.rpartition("[")[0] for output in outputs}:
        rows = [row for row, output in enumerate(outputs) if output.rpartition("[")[0] == kind]
        # Relative to the largest effect of any input on this kind of output.
        assert np.abs(errors)[:, rows].max() <= DIFFERENCE * np.abs(exact)[:, rows].max(), kind
    device.slave.freeFMUstate(state)
    device.slave.freeInstance()


def test_inputs_are_interpolated(default: Archive, device: Device) -> None:
    device.start()
    reference = device.references(["magnet.position[2]"])
    device.slave.setRealInputDerivatives(reference, [1], [0.05])
    device.step(0.1)
    assert device.get(["magnet.position[2]"]) == pytest.approx([-0.115], rel=ROUNDING)
    there = Device(default).start()
    there.step(0.1, {"magnet.position[2]": -0.115})
    assert device.get(["tip.angle"]) == pytest.approx(there.get(["tip.angle"]), rel=1e-9)
    (rate,) = device.slave.getRealOutputDerivatives(device.references(["tip.angle"]), [1])
    by = device.slave.getDirectionalDerivative(device.references(["tip.angle"]), reference, [1.0])
    assert rate == pytest.approx(0.05 * by[0], rel=ROUNDING)
    device.step(0.1)
    assert device.slave.getRealOutputDerivatives(device.references(["tip.angle"]), [1]) == [0.0]
    there.slave.freeInstance()


def test_the_working_directory_does_not_matter(
    default: Archive, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    here = Device(default).start()
    expected = drive(here)
    here.slave.freeInstance()
    monkeypatch.chdir(tmp_path)
    there = Device(default).start()
    assert drive(there) == expected
    there.slave.freeInstance()
    assert Path.cwd() == tmp_path and list(tmp_path.iterdir()) == []


def test_steps_of_any_size(default: Archive) -> None:
    device = Device(default).start()
    for size in (1e-6, 0.3, 1e-3, 7.0, 0.1 + 0.2 - 0.3 + 1e-9):
        device.step(size, {"magnet.position[3]": 0.02 + 0.001 * size})
    assert device.log == []
    device.slave.freeInstance()
