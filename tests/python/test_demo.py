"""What the demonstration draws and writes is what the FMU holds and what its rows say."""

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from conftest import PACKAGE, Archive

sys.path.insert(0, str(PACKAGE / "fmu"))
import demo_picture
from demo_parts import Parts

DISC = """
[design]
segments = 2
[design.helix]
radius_mm = 1.6
core_outer_radius_mm = 0.8
[design.ring]
length_mm = 0.7
[magnet]
cylinders = [{ radius_mm = 30.0, length_mm = 10.0, offset_mm = 3.0, remanence_t = -1.2 }]
[model]
interaction = "none"
"""
NO_MAGNET = '[design]\nsegments = 2\n[model]\ninteraction = "none"'
ROD = '[design]\nkind = "cylinder"\nlength_mm = 20.0\nradius_mm = 1.0\nshore_a = 33.0\n[magnet]'


def demo(archive: Archive, folder: Path, *options: str) -> subprocess.CompletedProcess[str]:
    """Runs the demonstration without its search."""
    command = [sys.executable, PACKAGE / "fmu" / "demo.py", archive.path, "--no-search", *options]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False, timeout=300)


def driven(archive: Archive, folder: Path, *options: str) -> tuple[np.ndarray, Parts]:
    """The rows, and what the FMU holds as the table says."""
    done = demo(archive, folder, *options)
    assert done.returncode == 0, done.stderr
    assert (folder / "mcm_demo.png").stat().st_size > 10_000
    assert (folder / "mcm_demo.gif").stat().st_size > 10_000
    rows = demo_picture.read(folder / "mcm_demo.csv")
    return rows, Parts.read(rows)


def test_sizes_and_words_are_those_of_the_fmu(pack: Callable[..., Archive], tmp_path: Path) -> None:
    archive = pack(DISC)
    rows, parts = driven(archive, tmp_path, "--distance", "80")
    start = {name: variable.start for name, variable in archive.variables.items()}
    assert parts.ring_diameter == pytest.approx(2e3 * float(start["design.helix.radius"]))
    assert (parts.ring_diameter, parts.ring_length, parts.core_diameter) == pytest.approx((3.2, 0.7, 1.6))
    assert parts.middle == pytest.approx(1e3 * (2 * float(start["design.helix.length"]) + 3 * 0.0007) / 2)
    assert demo_picture.finding(rows, parts) == (
        f"A disc magnet that passes at 80 mm bends a catheter of 2 segments to {rows['tip_angle_deg'].max():.0f}°"
    )
    # The rings and the poles as they are drawn.
    rings = demo_picture.manipulator(rows[0], parts, "black")[1:]
    assert len(rings) == 3
    sides = np.linalg.norm(np.diff(rings[0].get_xy(), axis=0), axis=1)
    assert sorted(set(np.round(sides, 6))) == pytest.approx([0.7, 3.2])
    (pole, middle, _), (other, end, corners) = demo_picture.halves(rows[0], parts)
    # A negative remanence: along -z, where the axis points at first, lies the south pole of what is drawn second.
    assert (pole, other) == ("N", "S")
    assert np.linalg.norm(end - middle) == pytest.approx(5.0)
    assert (end - middle)[0] < 0
    assert np.ptp(corners[:, 1]) == pytest.approx(60.0)


def test_windings_that_touch_are_counted(default: Archive, tmp_path: Path) -> None:
    rows, parts = driven(default, tmp_path, "--distance", "100")
    touch = sum(row["largest_core_angle_deg"] >= parts.boundary for row in rows)
    assert touch > 10
    assert demo_picture.touching(rows, parts) == f"Windings touch in {touch} of {len(rows)} rows"
    assert demo_picture.touching(rows[rows["largest_core_angle_deg"] < 39], parts) == "No windings touch"
    snapped = rows.copy()
    snapped["snaps"][-1] = 2
    assert demo_picture.stability(rows) == "The shape stays stable"
    assert demo_picture.stability(snapped) == "The shape snaps 2 times"
    assert demo_picture.stability(rows[:100]) == f"No shape is found after {rows['time_s'][99]:.2f} s"


def test_no_magnet_and_no_segments_are_said(pack: Callable[..., Archive], tmp_path: Path) -> None:
    rows, parts = driven(pack(NO_MAGNET), tmp_path)
    assert demo_picture.finding(rows, parts) == "Without a magnet, a catheter of 2 segments is bent by 0°"
    assert demo_picture.halves(rows[0], parts) == []
    rows, parts = driven(pack(ROD), tmp_path, "--distance", "60")
    assert demo_picture.finding(rows, parts).startswith(
        "A magnet pair that passes at 60 mm bends a magnetic rod to "
    )
    assert demo_picture.touching(rows, parts) == "Bending"


def test_a_pass_that_ends_is_said_and_wrong_distances_are_refused(
    pack: Callable[..., Archive], tmp_path: Path
) -> None:
    archive = pack('[design]\nsegments = 1\n[magnet]\n[model]\ninteraction = "none"')
    # The magnet meets the device on its way: its rows up to there are drawn.
    done = demo(archive, tmp_path, "--distance", "20")
    assert done.returncode == 0 and "Traceback" not in done.stderr, done.stderr
    assert "the pass ends after" in done.stderr and "bodies touch" in done.stderr
    rows = demo_picture.read(tmp_path / "mcm_demo.csv")
    assert 10 < len(rows) < 600
    assert demo_picture.stability(rows) == f"No shape is found after {rows['time_s'][-1]:.2f} s"
    for wrong in ("-100", "0", "nan", "inf", "far"):
        done = demo(archive, tmp_path, "--distance", wrong)
        assert done.returncode == 2
        assert f"{wrong} is not a distance in mm" in done.stderr


def test_a_file_that_is_no_fmu_is_refused(tmp_path: Path) -> None:
    (tmp_path / "text.fmu").write_text("no archive")
    for name in ("text.fmu", "missing.fmu"):
        command = [sys.executable, PACKAGE / "fmu" / "demo.py", name]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False, timeout=300)
        assert done.returncode == 2
        assert f"{name} is not an FMU; `mcm pack --out {name}` writes one" in done.stderr
