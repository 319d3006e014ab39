"""Reference: mean magnetisation of ring magnets whose recoil permeability is not 1, by an integral equation.

fmu/venv tests/bench/requirements.txt
.venv/bin/python tests/bench/recoil_permeability.py

A magnet of uniform remanence B_r along z and relative recoil permeability mu_r, M = B_r/mu_0 + (mu_r - 1) H, carries
charges sigma = M n on its surface only. They solve, with n outwards and H_n the field of all charges in the surface,

    sigma (1 + (mu_r - 1)/2) - (mu_r - 1) H_n[sigma] = (B_r/mu_0) n_z

and the moment is the integral of sigma z. Here sigma is constant on panels that shrink towards the edges, the equation
holds at the middle of each, and the fields of rings of charge are elliptic integrals. The magnetisation is not taken as
uniform, and no demagnetising factor is used. Meshes are refined twofold; the mean is extrapolated from the last two,
and its distance from the extrapolation before is the error that is stated. The rows go to recoil_permeability.csv.
"""

import csv
import math
from itertools import pairwise
from pathlib import Path

import numpy as np
from scipy.special import ellipe, ellipkm1

TABLE = Path(__file__).with_suffix(".csv")

# Inner radius, outer radius and length in mm, and mu_r; the paper's ring comes first.
CASES = [
    (0.75, 2.0, 1.0, 1.05),
    (0.75, 2.0, 1.0, 1.1),
    (0.75, 2.0, 1.0, 1.3),
    (0.75, 2.0, 1.0, 2.0),
    (0.0, 2.0, 1.0, 1.05),
    (0.0, 1.0, 2.0, 1.05),
    (0.0, 2.0, 0.1, 1.05),
    (0.0, 0.5, 10.0, 1.05),
    (0.75, 2.0, 0.2, 1.05),
    (0.75, 2.0, 8.0, 1.05),
    (1.6, 2.0, 1.0, 1.05),
    (1.9, 2.0, 2.0, 1.05),
]
COLUMNS = [
    "inner_radius_mm",
    "outer_radius_mm",
    "length_mm",
    "recoil_permeability",
    "mean_magnetisation",
    "mesh_error",
    "axial_field_excess",
]
PANELS = [24, 48, 96]
GRADING = 3  # panels next to an edge are as long as this power of their part of the length
POINTS = 8  # Gauss points of a panel
NEAR = 2.0  # lengths of a panel within which it is halved towards the point seen
HALVINGS = 16


def charged_ring(rho, z, radius, height):
    """Radial and axial field at (rho, z) of a ring of unit surface charge per length of the meridian."""
    dz = z - height
    far = np.sqrt((rho + radius) ** 2 + dz**2)
    near2 = (rho - radius) ** 2 + dz**2
    complement = near2 / far**2
    first, second = ellipkm1(complement), ellipe(1 - complement)
    radial = radius / (2 * np.pi * rho * far) * (first + (rho**2 - radius**2 - dz**2) / near2 * second)
    return radial, radius * dz * second / (np.pi * far * near2)


def mesh(inner, outer, half, count):
    """Panels of the upper half of the meridian: start, end (rows of rho, z) and normal."""
    steps = np.linspace(0, 1, count + 1)
    one_end = 1 - (1 - steps) ** GRADING
    both_ends = np.where(steps < 0.5, 0.5 * (2 * steps) ** GRADING, 1 - 0.5 * (2 - 2 * steps) ** GRADING)
    walls = [(outer, 1.0)] + ([(inner, -1.0)] if inner > 0 else [])
    # On a solid disc nothing happens on the axis.
    face = inner + (outer - inner) * (both_ends if inner > 0 else one_end)
    parts = [(np.stack([face, np.full_like(face, half)], axis=1), (0.0, 1.0))]
    for radius, side in walls:
        up = half * one_end
        parts.append((np.stack([np.full_like(up, radius), up], axis=1), (side, 0.0)))
    start = np.concatenate([nodes[:-1] for nodes, _ in parts])
    end = np.concatenate([nodes[1:] for nodes, _ in parts])
    normal = np.concatenate([np.tile(normal, (count, 1)) for _, normal in parts])
    return start, end, normal


def panel_fields(points, start, end):
    """Field (rho, z) at each of the points by one panel of unit charge, of which none is near."""
    nodes, weights = np.polynomial.legendre.leggauss(POINTS)
    middle, arm = 0.5 * (start + end), 0.5 * (end - start)
    place = middle + nodes[:, None] * arm
    fields = charged_ring(points[:, :1], points[:, 1:], place[:, 0], place[:, 1])
    return np.stack([field @ (weights * math.hypot(*arm)) for field in fields], axis=1)


def near_field(point, start, end):
    """The same where the point is near or on the panel: parts halved towards the closest place."""
    length = np.linalg.norm(end - start)
    along = (end - start) / length
    closest = min(max((point - start) @ along, 0.0), length)
    nodes, weights = np.polynomial.legendre.leggauss(POINTS)
    places, measures = [], []
    for side in (-closest, length - closest):
        for halving in range(HALVINGS + 1):
            first = side * 0.5 ** (halving + 1) if halving < HALVINGS else 0.0
            last = side * 0.5**halving
            places.append(0.5 * (first + last) + 0.5 * (last - first) * nodes)
            measures.append(0.5 * abs(last - first) * weights)
    place = start + np.outer(closest + np.concatenate(places), along)
    fields = charged_ring(point[0], point[1], place[:, 0], place[:, 1])
    return np.array([field @ np.concatenate(measures) for field in fields])


def normal_fields(start, end, normal):
    """Matrix of the normal field at the middle of each panel by each pair of a panel and its mirror image below."""
    middle, length = 0.5 * (start + end), np.linalg.norm(end - start, axis=1)
    below = np.array([1.0, -1.0])
    out = np.empty((len(start), len(start)))
    for column, (first, last) in enumerate(zip(start, end, strict=True)):
        total = np.zeros((len(middle), 2))
        for sign, (a, b) in ((1.0, (first, last)), (-1.0, (first * below, last * below))):
            distance = np.linalg.norm(middle - 0.5 * (a + b), axis=1)
            near = distance < NEAR * length[column]
            fields = np.empty((len(middle), 2))
            fields[~near] = panel_fields(middle[~near], a, b)
            for row in np.flatnonzero(near):
                fields[row] = near_field(middle[row], a, b)
            # In its own plane a flat face makes no normal field; rounding would say otherwise.
            level = (normal[:, 1] == 1.0) & (normal[column, 1] == 1.0) & (sign > 0)
            fields[level, 1] = 0.0
            total += sign * fields
        out[:, column] = np.sum(total * normal, axis=1)
    return out


def axial_field(charge, start, end, z):
    """Field on the axis at the height z by the panels and their mirror images."""
    nodes, weights = np.polynomial.legendre.leggauss(POINTS)
    place = 0.5 * (start + end)[:, None, :] + 0.5 * nodes[:, None] * (end - start)[:, None, :]
    radius, height = place[..., 0], place[..., 1]

    def one(above):
        return radius * above / 2 / (radius**2 + above**2) ** 1.5

    measure = 0.5 * weights * np.linalg.norm(end - start, axis=1)[:, None]
    return np.sum(charge[:, None] * measure * (one(z - height) - one(z + height)))


def solve(inner, outer, length, permeability, count):
    """Mean magnetisation over B_r/mu_0, and its field on the axis beside that of a uniform one of the same moment."""
    start, end, normal = mesh(inner, outer, 0.5 * length, count)
    susceptibility = permeability - 1.0
    matrix = (1 + 0.5 * susceptibility) * np.eye(len(start))
    matrix -= susceptibility * normal_fields(start, end, normal)
    charge = np.linalg.solve(matrix, normal[:, 1])
    middle, size = 0.5 * (start + end), np.linalg.norm(end - start, axis=1)
    moment = 4 * np.pi * np.sum(charge * middle[:, 0] * middle[:, 1] * size)
    mean = moment / (np.pi * (outer**2 - inner**2) * length)
    z = 2.5 * outer + max(0.0, 0.5 * (length - outer))
    field = axial_field(charge, start, end, z) / axial_field(mean * normal[:, 1], start, end, z)
    return mean, field


def main() -> None:
    """Solves all cases and writes the table."""
    rows = []
    for case in CASES:
        means, fields = zip(*(solve(*case, count) for count in PANELS), strict=True)
        # The error falls with the square of the panels' length.
        limits = [fine + (fine - coarse) / 3 for coarse, fine in pairwise(means)]
        error = max(abs(limits[-1] - limits[-2]), 1e-9)
        rows.append([*case, f"{limits[-1]:.9f}", f"{error:.1e}", f"{fields[-1] - 1:.2e}"])
        print(*case, *(f"{mean:.9f}" for mean in means), *rows[-1][4:])
    with TABLE.open("w", newline="") as out:
        out.write(
            "# Mean magnetisation of rings over B_r/mu_0, by the integral equation of a body of revolution, free to\n"
            "# magnetise unevenly; its error by mesh refinement; and what its field on the axis, 2.5 outer radii\n"
            "# from the centre (further off for long ones), has beyond that of a uniform ring of the same moment,\n"
            "# relative to it.\n"
            "# Made by: .venv/bin/python tests/bench/recoil_permeability.py\n"
        )
        table = csv.writer(out, lineterminator="\n")
        table.writerow(COLUMNS)
        table.writerows(rows)


if __name__ == "__main__":
    main()
