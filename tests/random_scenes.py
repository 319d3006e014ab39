"""Random scenes of every kind, which follow from a seed alone: levels, devices, sources, loads, vessels, shafts."""

import json
import math
from random import Random


class Draw:
    """Draws the tables of one scene."""

    def __init__(self, seed: int, number: int, vessels: dict[str, dict]) -> None:
        self.random = Random(f"{seed}/{number}")
        self.vessels = vessels

    def between(self, low: float, high: float) -> float:
        """A number of six digits, as a person would write it."""
        return float(f"{self.random.uniform(low, high):.6g}")

    def happens(self, share: float) -> bool:
        """True in this share of all scenes."""
        return self.random.random() < share

    def vector(self, largest: float) -> list[float]:
        """A vector of any direction, up to a length."""
        direction = [self.random.gauss(0, 1) for _ in range(3)]
        length = self.random.uniform(0, largest) / math.hypot(*direction)
        return [float(f"{length * component:.6g}") for component in direction]

    def away(self, nearest: float, farthest: float) -> list[float]:
        """A position beside the device (mm)."""
        angle, distance = self.random.uniform(0, math.tau), self.random.uniform(nearest, farthest)
        across = [float(f"{distance * part(angle):.6g}") for part in (math.cos, math.sin)]
        return [*across, self.between(-40, 80)]

    def turn(self) -> dict:
        """A turn about an axis."""
        return {"turn_deg": self.between(-180, 180), "turn_axis": self.vector(2)}

    def scene(self) -> dict:
        """A whole scene."""
        fed = self.happens(0.3)
        scene = {"design": self.design(fed), "model": self.model()}
        if self.happens(0.7):
            scene["field"] = self.field()
        if magnets := [self.magnet(number) for number in range(self.random.choice([0, 0, 1, 1, 2]))]:
            scene["magnet"] = magnets
        if coils := [self.coil() for _ in range(self.random.choice([0, 0, 0, 1, 2]))]:
            scene["coil"] = coils
        if self.happens(0.3):
            scene["load"] = self.load(scene["design"])
        if self.happens(0.3):
            scene["gravity"] = {"acceleration_m_s2": self.vector(10)}
        if fed:
            scene.update(self.insertion())
        elif self.happens(0.2):
            scene["base"] = {"position_mm": self.vector(20), **self.turn()}
        if "inner_radius_mm" in scene["design"].get("backbone", {}) and self.happens(0.3):
            scene["guidewire"] = self.guidewire()
        if not fed and self.happens(0.15):
            scene["start"] = {"way": [{"field.uniform[1]": self.between(-0.02, 0.02)} for _ in range(2)]}
        if not scene.keys() & {"feed", "guidewire", "start"} and self.happens(0.15):
            scene["model"] |= self.method()
        return scene

    def method(self) -> dict:
        """One of the methods to compare with, at a level that it has."""
        methods = ["planar", "constant-curvature", "shooting", "multiple-shooting", "collocation"]
        level = self.random.choice(["none", "rings"])
        return {"method": self.random.choice(methods), "interaction": level, "bending_stop": False}

    def design(self, fed: bool) -> dict:
        """A chain of segments, or now and then a plain rod."""
        if not fed and self.happens(0.08):
            rod = {"kind": "cylinder", "length_mm": self.between(10, 60), "radius_mm": self.between(0.5, 2)}
            return rod | {"shore_a": self.between(20, 60), "volume_fraction": self.between(0.05, 0.4)}
        design = {"segments": self.random.randint(1, 9)}
        if self.happens(0.3):
            design |= {"base_magnet": self.happens(0.5), "tip_magnet": self.happens(0.5)}
        if self.happens(0.5):
            design["spiral"] = self.random.choice(["axisymmetric", "alternating"])
        if self.happens(0.2):
            design["spiral_start_deg"] = self.between(-180, 180)
        if self.happens(0.6):
            design["helix"] = {
                "length_mm": self.between(3.5, 6),
                "boundary_angle_deg": self.between(25, 60),
                "windings": self.between(1.5, 3),
                "core_outer_radius_mm": self.between(0.9, 1.1),
                "shore_a": self.between(25, 50),
                "poisson": self.between(0.3, 0.49),
                "volume_fraction": self.between(0.1, 0.35),
                "particle_remanence_t": self.between(0.5, 1.2),
            }
        if self.happens(0.5):
            design["ring"] = {"length_mm": self.between(0.5, 1.5), "remanence_t": self.between(0.8, 1.4)}
            if self.happens(0.5):
                design["ring"]["recoil_permeability"] = self.between(1.02, 1.1)
        if fed or self.happens(0.3):
            design["backbone"] = self.tube(0.75)
        return design

    def tube(self, outer: float) -> dict:
        """A tube of at most this outer radius (mm), of rubber or of plastic."""
        stiff = {"elastic_modulus_mpa": self.between(2, 50)} if self.happens(0.5) else {}
        tube = {
            "outer_radius_mm": self.between(0.8 * outer, outer),
            "inner_radius_mm": self.between(0.25, 0.4),
        }
        return tube | (stiff or {"shore_a": self.between(30, 60)}) | {"poisson": self.between(0.3, 0.49)}

    def model(self) -> dict:
        """Level, bending stop, tolerances. Iterations are limited instead of time, which depends on the machine."""
        levels = ["none", "preceding", "rings", "full", "auto"]
        model = {"interaction": self.random.choice(levels), "time_budget_s": 1000.0, "iterations": 500}
        if self.happens(0.4):
            model["bending_stop"] = self.happens(0.5)
        if self.happens(0.2):
            model |= {
                "tolerance_position_mm": self.between(0.01, 1),
                "tolerance_angle_deg": self.between(0.05, 1),
            }
        if self.happens(0.2):
            model["tolerance_relative"] = self.random.choice([0.0, 1e-4, 1e-2])
        if self.happens(0.2):
            model["mutual_wrenches"] = True
        return model

    def field(self) -> dict:
        """A uniform field, in places with a turn and a gradient."""
        field = {"uniform_mt": self.vector(30)}
        if self.happens(0.3):
            field |= self.turn()
        if self.happens(0.3):
            field["gradient_t_per_m"] = [self.between(-0.3, 0.3) for _ in range(5)]
        return field

    def magnet(self, number: int) -> dict:
        """The pair of the paper, or cylinders and rings of one's own."""
        magnet = {"position_mm": self.away(90, 200)} if number or self.happens(0.8) else {}
        if self.happens(0.5):
            magnet |= self.turn()
        if self.happens(0.3):
            magnet["strength"] = self.random.choice([0.0, self.between(-1.5, 1.5)])
        if self.happens(0.5):
            offsets = [[0.0], [-15.0, 15.0]][self.random.randint(0, 1)]
            magnet["cylinders"] = [self.cylinder(offset) for offset in offsets]
        return magnet

    def cylinder(self, offset: float) -> dict:
        """A cylinder or a ring (mm)."""
        cylinder = {"radius_mm": self.between(10, 25), "length_mm": self.between(10, 28), "offset_mm": offset}
        if self.happens(0.4):
            cylinder["inner_radius_mm"] = self.between(2, 8)
        return cylinder | {"remanence_t": self.between(-1.4, 1.4)}

    def coil(self) -> dict:
        """A winding about air, or with the multipoles of an iron core."""
        coil = {
            "position_mm": self.away(90, 160),
            "inner_radius_mm": self.between(10, 20),
            "outer_radius_mm": self.between(25, 40),
            "length_mm": self.between(30, 60),
            "turns": float(self.random.randint(200, 1000)),
            "current_a": self.between(-10, 10),
        }
        if self.happens(0.4):
            # A dipole of 5e-6 T m3/A makes 50 mT at 100 mm with 5 A; the next ones shrink by the size of the core.
            coil["multipoles"] = [self.between(-5e-6, 5e-6), 0.0, self.between(-1e-9, 1e-9)]
        return coil

    def load(self, design: dict) -> dict:
        """Forces and a moment."""
        load = {"tip_force_n": self.vector(0.01)} if self.happens(0.7) else {}
        if self.happens(0.3):
            load["tip_moment_nm"] = self.vector(5e-5)
        if "segments" in design and self.happens(0.3):
            # A ring behind every segment and one at the base, where they are not left out.
            ends = sum(design.get(name, True) for name in ("base_magnet", "tip_magnet"))
            load["ring_force_n"] = [self.vector(0.003) for _ in range(design["segments"] - 1 + ends)]
        return load

    def insertion(self) -> dict:
        """A shaft pushed through a vessel, or free of one."""
        push = self.happens(0.2)
        feed = {"mode": "force" if push else "insertion", "insertion_mm": self.between(0, 80)}
        if push:
            feed["force_n"] = self.between(-0.01, 0.05)
        if self.happens(0.4):
            feed["roll_deg"] = self.between(-180, 180)
        if self.happens(0.4):
            feed["shaft"] = self.tube(1.2)
        if not push and self.happens(0.2):
            return {"feed": feed}
        vessel = self.vessel()
        if self.happens(0.5):
            vessel["friction"] = self.between(0.02, 0.4)
        return {"feed": feed, "vessel": vessel}

    def vessel(self) -> dict:
        """A tube, straight or bent, alone or forked, or one of the aortas."""
        if self.happens(0.3):
            return dict(self.vessels[self.random.choice(sorted(self.vessels))])
        bend = self.random.choice([0.0, self.between(0.001, 0.008)])
        radius = self.between(3, 7)
        trunk = [[float(f"{0.5 * bend * max(z, 0) ** 2:.6g}"), 0.0, float(z)] for z in range(-100, 181, 10)]
        branches = [{"name": "trunk", "points_mm": trunk, "radius_mm": radius}]
        if self.happens(0.3):
            side = [[trunk[15][0], 0.8 * step, trunk[15][2] + step] for step in (0.0, 20.0, 40.0, 60.0, 80.0)]
            branches.append({"name": "side", "points_mm": side, "radius_mm": float(f"{0.8 * radius:.6g}")})
        return {"wall_modulus_mpa": self.between(0.1, 5), "branch": branches}

    def guidewire(self) -> dict:
        """A wire that fits into the tube."""
        wire = {"radius_mm": self.between(0.1, 0.24), "elastic_modulus_mpa": self.between(100, 60000)}
        return wire | {"insertion_mm": self.between(0, 60)}


def toml(table: dict, name: str = "") -> str:
    """A table in TOML: its numbers first, then the tables in it. A number, a text and a list are written as in JSON."""
    tables = {key: value for key, value in table.items() if isinstance(value, dict)}
    lists = {
        key: value
        for key, value in table.items()
        if isinstance(value, list) and value and isinstance(value[0], dict)
    }
    plain = {key: value for key, value in table.items() if key not in tables | lists}
    text = "".join(
        f"{json.dumps(key) if '.' in key else key} = {json.dumps(value)}\n" for key, value in plain.items()
    )
    for key, value in tables.items():
        text += f"\n[{name}{key}]\n{toml(value, f'{name}{key}.')}"
    for key, rows in lists.items():
        text += "".join(f"\n[[{name}{key}]]\n{toml(row, f'{name}{key}.')}" for row in rows)
    return text
