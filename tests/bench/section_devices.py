"""Reference: equilibria of devices made of sections in mixed directions, by shooting and surface charges.

fmu/venv tests/bench/requirements.txt
.venv/bin/python tests/bench/section_devices.py

Nothing of it is shared with the project: the rod is the strong form of the Cosserat equations, integrated from the base
with Runge-Kutta's method; rigid magnets act on one another by the Coulomb forces between the magnetic charges on all
their surfaces. The unknowns are the wrench at the base and that of every rigid magnet in the field of the others; the
residual is what the charges and the free tip say of them. Each device is solved with two finenesses, and their
difference is stated. The devices go to section_devices.json.
"""

import json
import math
import random
from pathlib import Path

import numpy as np
from scipy.optimize import root
from scipy.spatial.transform import Rotation

MU0 = 4e-7 * math.pi
TABLE = Path(__file__).with_suffix(".json")
DEVICES = 6


def unit(source):
    """A random direction."""
    height, turn = source.uniform(-1, 1), source.uniform(0, 2 * math.pi)
    across = math.sqrt(1 - height * height)
    return np.array([across * math.cos(turn), across * math.sin(turn), height])


def section(source, rigid):
    """A random section, lengths in mm."""
    outer = source.uniform(0.5, 0.8) * (1.4 if rigid else 1.0)
    own = {
        "length_mm": source.uniform(2, 3) if rigid else source.uniform(5, 9),
        "outer_radius_mm": outer,
        "inner_radius_mm": source.uniform(0.1, 0.3),
        "remanence_t": source.uniform(0.6, 1.2) if rigid else source.uniform(0.02, 0.1),
        "direction": list(unit(source)),
    }
    if rigid:
        return own | {"rigid": True, "density_kg_m3": 7500.0}
    return own | {
        "elastic_modulus_mpa": source.uniform(1.0, 3.0),
        "poisson": 0.45,
        "density_kg_m3": 1100.0,
        "direction_turn_deg_per_mm": source.uniform(-15, 15),
        "rest_curvature_per_m": list(unit(source) * source.uniform(0, 40)),
    }


def device(number):
    """A random device and its loads, in SI units."""
    source = random.Random(number)
    sections = [section(source, k % 2 == 1) for k in range(5)]
    lean = unit(source)
    gradient = (np.outer(lean, lean) - np.eye(3) / 3) * source.uniform(0.0, 0.3)
    return {
        "sections": sections,
        "field": unit(source) * source.uniform(3e-3, 8e-3),
        "gradient": gradient,
        "gravity": unit(source) * 9.81,
        "force": unit(source) * 2e-4,
    }


def toml(own):
    """The scene of a device."""

    def value(entry):
        if isinstance(entry, bool):
            return str(entry).lower()
        return repr([float(x) for x in entry]) if isinstance(entry, list) else repr(float(entry))

    tables = [
        "[[design.section]]\n" + "".join(f"{key} = {value(entry)}\n" for key, entry in part.items())
        for part in own["sections"]
    ]
    g = own["gradient"]
    numbers = [g[0, 0], g[0, 1], g[0, 2], g[1, 1], g[1, 2]]
    return (
        '[design]\nkind = "sections"\n'
        + "".join(tables)
        + f"[field]\nuniform_mt = {value(list(own['field'] * 1e3))}\n"
        f"gradient_t_per_m = {value(numbers)}\n[gravity]\nacceleration_m_s2 = {value(list(own['gravity']))}\n"
        f'[load]\ntip_force_n = {value(list(own["force"]))}\n[model]\ninteraction = "rings"\n'
    )


def charges(part, nodes):
    """Places (m) and charges (A m) on the surfaces of a rigid tube whose proximal face is at the origin."""
    outer, inner, length = (part[key] * 1e-3 for key in ("outer_radius_mm", "inner_radius_mm", "length_mm"))
    moment = np.array(part["direction"]) * part["remanence_t"] / MU0
    x, w = np.polynomial.legendre.leggauss(nodes)
    turns = 2 * math.pi * (np.arange(4 * nodes) + 0.5) / (4 * nodes)
    places, sizes = [], []
    squares = 0.5 * (outer**2 + inner**2) + 0.5 * (outer**2 - inner**2) * x
    for rho, weight in zip(np.sqrt(squares), w, strict=True):
        area = 0.25 * (outer**2 - inner**2) * weight * 2 * math.pi / len(turns)
        for height, sign in ((0.0, -1), (length, 1)):
            places.append(
                np.stack([rho * np.cos(turns), rho * np.sin(turns), np.full_like(turns, height)], 1)
            )
            sizes.append(np.full_like(turns, sign * moment[2] * area))
    for radius, sign in ((outer, 1), (inner, -1)):
        for height, weight in zip(0.5 * length * (1 + x), w, strict=True):
            area = 0.5 * length * weight * radius * 2 * math.pi / len(turns)
            places.append(
                np.stack([radius * np.cos(turns), radius * np.sin(turns), np.full_like(turns, height)], 1)
            )
            sizes.append(sign * area * (moment[0] * np.cos(turns) + moment[1] * np.sin(turns)))
    return np.concatenate(places), np.concatenate(sizes)


def mutual(bodies):
    """Force and torque about its proximal face on each body: place, rotation, places and sizes of charges."""
    world = [(p + places @ r.T, sizes) for p, r, places, sizes in bodies]
    out = [np.zeros(6) for _ in bodies]
    for i, (at, q) in enumerate(world):
        for j in range(i):
            other, q2 = world[j]
            apart = at[:, None, :] - other[None, :, :]
            sizes = MU0 / (4 * math.pi) * q[:, None] * q2[None, :] / np.linalg.norm(apart, axis=2) ** 3
            forces = sizes[:, :, None] * apart
            on, back = forces.sum(1), -forces.sum(0)
            out[i] += np.concatenate([on.sum(0), np.cross(at - bodies[i][0], on).sum(0)])
            out[j] += np.concatenate([back.sum(0), np.cross(other - bodies[j][0], back).sum(0)])
    return out


def hat(v):
    """The matrix of the cross product with a vector."""
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


class Rod:
    """An elastic section in the field of a device."""

    def __init__(self, part, own):
        """Take up stiffness, rest shape and magnetisation."""
        outer, inner = (part[key] * 1e-3 for key in ("outer_radius_mm", "inner_radius_mm"))
        area, inertia = math.pi * (outer**2 - inner**2), math.pi / 4 * (outer**4 - inner**4)
        young = part["elastic_modulus_mpa"] * 1e6
        shear = young / (2 * (1 + part["poisson"]))
        self.bend = np.array([young * inertia, young * inertia, 2 * shear * inertia])
        self.stretch = np.array([shear * area, shear * area, young * area])
        self.rest = np.array(part["rest_curvature_per_m"])
        self.turn = math.radians(part["direction_turn_deg_per_mm"]) * 1e3
        self.direction = part["direction"]
        self.strength = part["remanence_t"] / MU0 * area
        self.field, self.gradient = own["field"], own["gradient"]
        self.weight = part["density_kg_m3"] * area * own["gravity"]

    def rates(self, s, state):
        """Rates of place, rotation, force and moment along the section."""
        q, rot, n, m = state
        c, d = math.cos(self.turn * s), math.sin(self.turn * s)
        x, y, z = self.direction
        moment = rot @ np.array([c * x - d * y, d * x + c * y, z]) * self.strength
        u = self.rest + (rot.T @ m) / self.bend
        v = np.array([0, 0, 1]) + (rot.T @ n) / self.stretch
        tangent = rot @ v
        force = self.gradient @ moment + self.weight
        torque = np.cross(moment, self.field + self.gradient @ q)
        return tangent, rot @ hat(u), -force, -np.cross(tangent, n) - torque


def shoot(own, base, wrenches, steps):
    """Tip residual and poses of the rigid bodies for these wrenches at the base and on the bodies."""
    p, r, n, m = np.zeros(3), np.eye(3), base[:3].copy(), base[3:].copy()
    field, gradient, gravity = own["field"], own["gradient"], own["gravity"]
    poses = []
    for part in own["sections"]:
        length, outer, inner = (
            part[key] * 1e-3 for key in ("length_mm", "outer_radius_mm", "inner_radius_mm")
        )
        area = math.pi * (outer**2 - inner**2)
        if part.get("rigid"):
            axis = r[:, 2]
            centre, volume = p + axis * length / 2, area * length
            moment = r @ np.array(part["direction"]) * part["remanence_t"] / MU0 * volume
            # In a linear field the force is that on the moment, wherever it is; the torque is about the proximal face.
            force = gradient @ moment + part["density_kg_m3"] * volume * gravity
            torque = np.cross(moment, field + gradient @ centre) + np.cross(centre - p, force)
            wrench = wrenches[len(poses)]
            poses.append((p.copy(), r.copy()))
            # What the part behind the body carries.
            n_end = n - force - wrench[:3]
            m = m - torque - wrench[3:] - np.cross(axis * length, n_end)
            n, p = n_end, p + axis * length
            continue
        rod = Rod(part, own)

        h = length / steps
        state = (p, r, n, m)
        for step in range(steps):
            s = step * h
            k1 = rod.rates(s, state)
            k2 = rod.rates(s + h / 2, tuple(a + h / 2 * b for a, b in zip(state, k1, strict=True)))
            k3 = rod.rates(s + h / 2, tuple(a + h / 2 * b for a, b in zip(state, k2, strict=True)))
            k4 = rod.rates(s + h, tuple(a + h * b for a, b in zip(state, k3, strict=True)))
            state = tuple(
                a + h / 6 * (b + 2 * c + 2 * d + e)
                for a, b, c, d, e in zip(state, k1, k2, k3, k4, strict=True)
            )
        p, r, n, m = state
    return np.concatenate([n - own["force"], m]), poses, (p, r)


def weaker(own, share):
    """The device with this share of its loads and of the remanence of its rigid magnets."""
    loads = {key: own[key] * share for key in ("field", "gradient", "gravity", "force")}
    sections = [
        part | {"remanence_t": part["remanence_t"] * share} if part.get("rigid") else part
        for part in own["sections"]
    ]
    return own | loads | {"sections": sections}


def solve(own, steps, nodes, start=None):
    """Tip position and rotation, and the unknowns."""

    def residual(x, own, surfaces):
        x = (x * scale).reshape(-1, 6)
        tip, poses, _ = shoot(own, x[0], x[1:], steps)
        acting = mutual([(p, r, *surface) for (p, r), surface in zip(poses, surfaces, strict=True)])
        missing = (given - found for given, found in zip(x[1:], acting, strict=True))
        return np.concatenate([tip, *missing]) / scale

    rigid = sum(1 for part in own["sections"] if part.get("rigid"))
    scale = np.tile([1e-3, 1e-3, 1e-3, 1e-6, 1e-6, 1e-6], 1 + rigid)
    # The loads grow from a tenth to the whole: far from the shape shooting does not converge.
    shares = (0.1, 0.3, 0.5, 0.7, 0.85, 1.0) if start is None else (1.0,)
    x = np.zeros(len(scale)) if start is None else start
    for share in shares:
        now = weaker(own, share)
        surfaces = [charges(part, nodes) for part in now["sections"] if part.get("rigid")]
        found = root(residual, x, args=(now, surfaces), tol=1e-12)
        if not found.success and np.abs(found.fun).max() > 1e-6:
            raise SystemExit(f"not converged at {share}: {np.abs(found.fun).max()}")
        x = found.x
    _, _, (p, r) = shoot(own, (x * scale)[:6], (x * scale)[6:].reshape(-1, 6), steps)
    return p, r, x


def main():
    """Solve all devices and write the table."""
    rows = []
    for number in range(DEVICES):
        own = device(number)
        coarse, _, x = solve(own, 40, 6)
        p, r, _ = solve(own, 80, 9, x)
        u, _, vt = np.linalg.svd(r)
        w = Rotation.from_matrix(u @ vt).as_quat()
        length = 1e-3 * sum(part["length_mm"] for part in own["sections"])
        error = float(np.linalg.norm(p - coarse) / length)
        print(number, p, error, flush=True)
        rows.append(
            {
                "id": number,
                "toml": toml(own),
                "length_m": length,
                "tip_position_m": p.tolist(),
                "tip_orientation_wxyz": [w[3], w[0], w[1], w[2]],
                "error": error,
            }
        )
    TABLE.write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
