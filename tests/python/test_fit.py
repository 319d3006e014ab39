"""`mcm fit` finds what scipy's `least_squares` finds through the FMU."""

import csv
import math
import random
import time
import tomllib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from conftest import Archive, Device, run
from scipy.optimize import least_squares

SCENE = '[design]\nsegments = 1\n[field]\nuniform_mt = [0, 10, 0]\n[model]\ninteraction = "rings"\n'
ROWS = 100
NOISE = 0.05  # mm
AGREE = 1e-5  # relative; least_squares differentiates by differences
TRUTH = {"design.helix.length": 4.1e-3, "design.ring.remanence": 1.28}
START = {"design.helix.length": 4.0e-3, "design.ring.remanence": 1.35}
KEYS = ["design.helix.length_mm", "design.ring.remanence_t"]
UNITS = [1e-3, 1.0]
NAMES = ["tip.position[2]", "tip.position[3]"]


def tips(packed: Archive, values: dict[str, float], fields: list[float]) -> np.ndarray:
    """Tip (mm) in each of these fields (T), each from the unloaded shape."""
    out = []
    device = Device(packed)
    for field in fields:
        device.start(values | {"field.uniform[2]": field})
        out.append([1e3 * value for value in device.get(NAMES)])
        device.slave.reset()
    device.slave.freeInstance()
    return np.array(out)


def test_scipy_finds_the_same(pack: Callable[..., Archive], tmp_path: Path) -> None:
    packed = pack(SCENE)
    fields = [2e-2 * (number + 1) / ROWS for number in range(ROWS)]
    noise = random.Random(5)
    measured = tips(packed, TRUTH, fields)
    measured += np.array([[noise.gauss(0, NOISE) for _ in NAMES] for _ in fields])
    with (tmp_path / "data.csv").open("w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["field.uniform[2]", "tip_y_mm", "tip_z_mm"])
        table.writerows([field, *row] for field, row in zip(fields, measured.tolist(), strict=True))
    (tmp_path / "scene.toml").write_text(SCENE)
    vary = [word for key in KEYS for word in ("--vary", key)]
    begin = time.perf_counter()
    done = run(
        "fit",
        tmp_path / "scene.toml",
        "--measured",
        tmp_path / "data.csv",
        *vary,
        "--out",
        tmp_path / "fit.toml",
    )
    own = time.perf_counter() - begin
    assert done.returncode == 0, done.stderr
    fitted = tomllib.loads((tmp_path / "fit.toml").read_text())

    def residuals(scaled: np.ndarray) -> np.ndarray:
        values = {key: START[key] * factor for key, factor in zip(START, scaled, strict=True)}
        return (tips(packed, values, fields) - measured).ravel()

    begin = time.perf_counter()
    found = least_squares(residuals, [1.0, 1.0], jac="3-point", method="lm", xtol=1e-12, ftol=1e-12)
    peer = time.perf_counter() - begin
    print(
        f"mcm fit {1e3 * own:.0f} ms with its start, least_squares {1e3 * peer:.0f} ms, {peer / own:.0f} times"
    )
    expected = [start * factor for start, factor in zip(START.values(), found.x, strict=True)]
    values = [fitted["design"]["helix"]["length_mm"], fitted["design"]["ring"]["remanence_t"]]
    for value, unit, other in zip(values, UNITS, expected, strict=True):
        assert value * unit == pytest.approx(other, rel=AGREE)
    # Their deviations, from its Jacobian and what is left.
    scatter = math.sqrt(2 * found.cost / (2 * ROWS - 2))
    deviations = (
        scatter * np.sqrt(np.diag(np.linalg.inv(found.jac.T @ found.jac))) * np.array(list(START.values()))
    )
    for key, unit, other in zip(KEYS, UNITS, deviations, strict=True):
        assert fitted["uncertainty"][key] * unit == pytest.approx(other, rel=1e-3)
