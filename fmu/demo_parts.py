"""What an FMU holds, for the demonstration and its pictures: sizes of device and magnet, as columns of the table."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

# End of the demonstration, s.
STOP = 30.0


@dataclass(frozen=True)
class Cylinder:
    """A cylinder of the magnet, mm.

    `offset` is the place of its centre along the axis; `north` is 1 where its north lies ahead, else -1.
    """

    diameter: float
    bore: float
    length: float
    offset: float
    north: int


@dataclass(frozen=True)
class Parts:
    """Sizes, mm; not a number where there is nothing of the kind."""

    segments: int  # 0 for a plain rod
    ring_diameter: float
    ring_length: float
    core_diameter: float
    boundary: float  # bending angle at which windings touch, deg
    middle: float  # z of the straight device's middle
    cylinders: tuple[Cylinder, ...]

    @classmethod
    def of(cls, starts: Mapping[str, str]) -> "Parts":
        """From the start values of an FMU's variables."""

        def value(name: str, otherwise: float = math.nan) -> float:
            return float(starts.get(name, otherwise))

        segments = int(value("design.segments", 0))
        rings = int(value("design.rings", 0))
        if segments:
            outer, core = value("design.helix.radius"), value("design.helix.core_outer_radius")
            length = segments * value("design.helix.length") + rings * value("design.ring.length")
        else:
            outer, core = math.nan, value("design.cylinder.radius")
            length = value("design.cylinder.length")
        base = value("base.position[3]", 0) + value("feed.insertion", 0)
        return cls(
            segments=segments,
            ring_diameter=2e3 * outer,
            ring_length=1e3 * value("design.ring.length"),
            core_diameter=2e3 * core,
            boundary=math.degrees(value("design.helix.boundary_angle")),
            middle=1e3 * (base + length / 2),
            cylinders=tuple(cylinders(value)),
        )

    def columns(self) -> dict[str, float]:
        """The columns of the table, the same in every row."""
        found = {
            "segments": self.segments,
            "ring_diameter_mm": self.ring_diameter,
            "ring_length_mm": self.ring_length,
            "core_diameter_mm": self.core_diameter,
            "boundary_angle_deg": self.boundary,
            "middle_mm": self.middle,
        }
        for number, cylinder in enumerate(self.cylinders, start=1):
            found |= {
                f"magnet_{number}_diameter_mm": cylinder.diameter,
                f"magnet_{number}_bore_mm": cylinder.bore,
                f"magnet_{number}_length_mm": cylinder.length,
                f"magnet_{number}_offset_mm": cylinder.offset,
                f"magnet_{number}_north": cylinder.north,
            }
        return found

    @classmethod
    def read(cls, rows: np.ndarray) -> "Parts":
        """From the first row of a table."""
        row = {name: float(rows[name][0]) for name in rows.dtype.names}
        numbers = sum(name.startswith("magnet_") and name.endswith("_bore_mm") for name in row)
        found = (
            Cylinder(
                *(row[f"magnet_{number}_{size}_mm"] for size in ("diameter", "bore", "length", "offset")),
                north=int(row[f"magnet_{number}_north"]),
            )
            for number in range(1, numbers + 1)
        )
        sizes = ("ring_diameter_mm", "ring_length_mm", "core_diameter_mm", "boundary_angle_deg", "middle_mm")
        return cls(int(row["segments"]), *(row[name] for name in sizes), cylinders=tuple(found))

    @property
    def width(self) -> float:
        """Largest diameter of the device, mm."""
        return float(np.nanmax([self.ring_diameter, self.core_diameter]))

    @property
    def magnet(self) -> str:
        """The magnet in words; empty for none."""
        if not self.cylinders:
            return ""
        if len(self.cylinders) > 1:
            return "magnet pair" if len(self.cylinders) == 2 else f"magnet of {len(self.cylinders)} cylinders"
        (only,) = self.cylinders
        shape = "ring " if only.bore > 0 else "disc " if only.length < only.diameter / 2 else ""
        return f"{shape}magnet"

    @property
    def device(self) -> str:
        """The device in words."""
        if not self.segments:
            return "magnetic rod"
        return f"catheter of {self.segments} segment{'s' if self.segments > 1 else ''}"


def cylinders(value):
    """Those of the magnet that have a field."""
    strength, number = value("magnet.strength", 0), 1
    while not math.isnan(value(f"magnet.design.cylinder[{number}].radius")):
        name = f"magnet.design.cylinder[{number}]"
        pole = strength * value(f"{name}.remanence")
        if pole != 0:
            yield Cylinder(
                diameter=2e3 * value(f"{name}.radius"),
                bore=2e3 * value(f"{name}.inner_radius"),
                length=1e3 * value(f"{name}.length"),
                offset=1e3 * value(f"{name}.offset"),
                north=1 if pole > 0 else -1,
            )
        number += 1
