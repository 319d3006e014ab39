"""The beginning of the way through the aorta: the shaft hangs free, and the device follows its magnet."""

import csv
import subprocess
import sys
from pathlib import Path

import numpy as np
from conftest import PACKAGE, program


def test_a_device_follows_its_magnet_into_the_artery(tmp_path: Path) -> None:
    script = PACKAGE / "fmu" / "navigate.py"
    done = subprocess.run(
        [sys.executable, script, program(), "--to", "40"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    with (tmp_path / "navigate.csv").open() as file:
        rows = list(csv.DictReader(file))
    column = {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}
    # Once the shaft hangs along the wall, it comes in as fast as the magnet goes.
    late = column["feed.length"] > 0.025
    assert late.sum() >= 5
    followed = np.diff(column["feed.length"][late]) / (np.diff(column["magnet_z_mm"][late]) / 1e3)
    np.testing.assert_allclose(followed, 1.0, atol=0.02)
    assert (column["solver.status"] < 3).all()
    assert (column["contact.count"] >= 1).all()
    force = np.array([column[f"contact.force[{k}]"] for k in (1, 2, 3)])
    pull = np.array([column[f"magnet.reaction_force[{k}]"] for k in (1, 2, 3)])
    # A free shaft carries next to nothing along the port: magnet and wall balance.
    assert np.abs(force[2] - pull[2])[late].max() < 0.01
    for name in ("navigate.png", "navigate.gif"):
        assert (tmp_path / name).stat().st_size > 10_000
