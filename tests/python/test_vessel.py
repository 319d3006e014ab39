"""An FMU whose vessel is a mesh takes it along."""

import math
import shutil
import struct
from collections.abc import Callable
from pathlib import Path

from conftest import Archive, Device

Point = tuple[float, float, float]

SCENE = """[design]
segments = 1
[model]
interaction = "rings"
time_budget_s = 20.0
[vessel]
mesh_stl = "{mesh}"
"""


def tube(radius: float, start: float, end: float, around: int = 120, along: int = 80) -> bytes:
    """A closed tube along z as a binary STL file, mm."""

    def at(i: int, j: int) -> Point:
        angle = math.tau * (j % around) / around
        return radius * math.cos(angle), radius * math.sin(angle), start + (end - start) * i / along

    triangles: list[tuple[Point, Point, Point]] = []
    for j in range(around):
        for i in range(along):
            a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
            triangles += [(a, b, c), (a, c, d)]
        triangles.append(((0.0, 0.0, start), at(0, j), at(0, j + 1)))
        triangles.append(((0.0, 0.0, end), at(along, j + 1), at(along, j)))
    rows = (struct.pack("<12fH", 0, 0, 0, *a, *b, *c, 0) for a, b, c in triangles)
    return bytes(80) + struct.pack("<I", len(triangles)) + b"".join(rows)


def press(device: Device) -> list[float]:
    """Presses the device against the wall and tells how."""
    device.start()
    for index in range(1, 5):
        device.step(0.1, {"field.uniform[2]": 0.003 * index})
    told = device.get(["tip.position[2]", "contact.force[2]", "contact.largest_indentation"])
    device.slave.freeInstance()
    return told


def test_a_mesh_travels_with_its_fmu(pack: Callable[..., Archive], tmp_path: Path) -> None:
    mesh = tmp_path / "tube.stl"
    mesh.write_bytes(tube(2.2, -20.0, 40.0))
    archive = pack(SCENE.format(mesh=mesh.as_posix()))
    mesh.unlink()
    resources = archive.folder / "resources"
    assert {path.name for path in resources.iterdir()} == {"package.toml", "scene.toml", "vessel.grid"}
    assert str(tmp_path) not in (resources / "scene.toml").read_text()
    told = press(Device(archive))
    assert told[1] < -1e-3
    assert told[2] > 0.0
    shutil.move(archive.folder, tmp_path / "elsewhere")
    archive.folder = tmp_path / "elsewhere"
    assert press(Device(archive)) == told
