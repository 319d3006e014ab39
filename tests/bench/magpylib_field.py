"""Time and accuracy of magpylib for the reference ring and pair of cylinders: the peer of `cargo bench --bench field`.

fmu/venv tests/bench/requirements.txt
.venv/bin/python tests/bench/magpylib_field.py
"""

import csv
import platform
import statistics
import timeit
from pathlib import Path

import magpylib
import numpy as np

REFERENCE = Path(__file__).resolve().parent.parent / "reference"
POLARIZATION = (0.0, 0.0, 1.35)


def cylinder(diameter: float, height: float, z: float = 0.0, sign: float = 1.0):
    """Axially magnetised cylinder, dimensions in m, remanence 1.35 T."""
    return magpylib.magnet.Cylinder(
        polarization=tuple(sign * p for p in POLARIZATION),
        dimension=(diameter, height),
        position=(0.0, 0.0, z),
    )


def points(radius: float) -> np.ndarray:
    """The points of `peer.rs`: 2.1 to 6 radii from the centre."""
    i = np.arange(64)
    distance, polar, azimuth = radius * (2.1 + i * 3.9 / 63.0), 0.1 + i * 0.0465, i * 2.4
    rho = distance * np.sin(polar)
    return np.stack([rho * np.cos(azimuth), rho * np.sin(azimuth), distance * np.cos(polar)], axis=1)


def microseconds(function, calls: int) -> float:
    """Median of seven repetitions."""
    return statistics.median(timeit.repeat(function, number=calls, repeat=7)) / calls * 1e6


def rows(name: str) -> tuple[np.ndarray, np.ndarray]:
    """Points and fields of a reference table; an empty one is an error."""
    with (REFERENCE / name).open(newline="", encoding="utf-8") as table:
        values = np.array([[float(entry) for entry in row] for row in list(csv.reader(table))[1:]])
    if values.size == 0:
        raise SystemExit(f"{name} is empty")
    return values[:, :3], values[:, 3:6]


def report() -> list[tuple[str, float, float]]:
    """Prints a table of times and one of errors; of the ring in a batch: how far, time (s) of a point, median error."""
    ring = magpylib.Collection(cylinder(4e-3, 1e-3), cylinder(1.5e-3, 1e-3, sign=-1.0))
    pair = magpylib.Collection(cylinder(45e-3, 30e-3, z=-20e-3), cylinder(45e-3, 30e-3, z=20e-3))
    one = cylinder(45e-3, 30e-3)
    print(f"magpylib {magpylib.__version__}, Python {platform.python_version()}, {platform.machine()}\n")
    print(
        "| source | field, microseconds per single call | per point of 65536 in one call |\n| --- | --- | --- |"
    )
    found = []
    for name, source, few in (
        ("cylinder", one, points(22.5e-3)),
        ("ring", ring, points(2e-3)),
        ("ring, 17 to 48 radii", ring, 8 * points(2e-3)),
    ):
        many = np.tile(few, (1024, 1))
        single = microseconds(lambda s=source, p=few[7]: s.getB(p), 100)
        batch = microseconds(lambda s=source, p=many: s.getB(p), 1) / len(many)
        found.append(batch)
        print(f"| {name} | {single:.0f} | {batch:.2f} |")
    print("\n| source | rows | median error of B | largest |\n| --- | --- | --- | --- |")
    medians = []
    for name, source in (("ring", ring), ("cylinder_pair", pair)):
        where, expected = rows(f"{name}_field_dev.csv")
        size = np.linalg.norm(expected, axis=1)
        error = np.linalg.norm(source.getB(where) - expected, axis=1)[size > 0] / size[size > 0]
        medians.append(float(np.median(error)))
        print(f"| {name} | {len(error)} | {np.median(error):.1e} | {error.max():.1e} |")
    return [("near", 1e-6 * found[1], medians[0]), ("far", 1e-6 * found[2], medians[0])]


if __name__ == "__main__":
    report()
