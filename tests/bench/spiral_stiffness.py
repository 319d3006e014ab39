"""What the glued spiral adds to a core's stiffness, which the paper neglects: linear finite elements of one core.

Run (about 8 minutes): fmu/venv tests/bench/finite_elements.txt
                       .venv/bin/python tests/bench/spiral_stiffness.py
Writes tests/bench/spiral_stiffness.csv. With --fine a mesh of twice the cells around and along too, which is in the
record (10 minutes more).

The core of Table 1 of Richter et al. (E = 3.325 MPa, nu = 0.4) with and without its spiral, on one mesh of
quadratic tetrahedra whose faces follow the flanks' helicoids: cells of a grid in angle and height are cut along the
helix. The ends are glued to rigid bodies, or to the discs and those to rigid rings. One end is clamped, the other
moved in six ways; the inverse of the stiffness there gives that under a pure moment, torque or pull. Where the
spiral leaves the tube strains are singular: the layers are thin there. The tube alone meets its closed forms:
torsion G J at once, bending and pull E I and E A by the difference of two lengths, in which the glued ends, which
cannot contract, cancel. The table gives the stiffness over that without a spiral, and over that of the rod of `mcm`.
"""

import argparse
import csv
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pypardiso
from scipy.interpolate import RectBivariateSpline
from scipy.sparse import triu
from scipy.spatial import KDTree
from skfem import Basis, BilinearForm, ElementTetP2, ElementVector, MeshTet, MeshTet2
from skfem.helpers import ddot, eye, sym_grad, trace

LENGTH, RADIUS, CORE_OUTER, CORE_INNER, WINDINGS = 4.0e-3, 2.0e-3, 0.95e-3, 0.75e-3, 2
PITCH = RADIUS * math.radians(40.0) / WINDINGS
HEIGHT = (LENGTH - WINDINGS * PITCH) / (2 + WINDINGS)
CORE = LENGTH - 2.0 * HEIGHT
ELASTIC, POISSON = 1.29447e6 * math.exp(2.5 * 0.25 / (1.0 - 1.35 * 0.25)), 0.4
SHEAR = ELASTIC / (2.0 * (1.0 + POISSON))
LAME = ELASTIC * POISSON / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON))
INERTIA = math.pi / 4.0 * (CORE_OUTER**4 - CORE_INNER**4)
AREA = math.pi * (CORE_OUTER**2 - CORE_INNER**2)

# The sector's part of a turn, h / (h + p) = 0.48250, as a fraction whose denominator is the number of cells of a turn.
SECTOR_CELLS, TURN_CELLS = 14, 29


@dataclass(frozen=True)
class Grid:
    """Resolution and ends."""

    fine: int  # cells of a turn, times 29
    tube: int  # layers across the tube's wall
    spiral: int  # layers across the spiral
    disc: int = 0  # layers of a disc, 0: the core's ends are rigid
    cores: int = 1  # how many times as long


def mesh(grid: Grid, spiral: bool):
    """Quadratic tetrahedra on the cylinder's and the helicoids' true surfaces, m."""
    n = TURN_CELLS * grid.fine
    wide = SECTOR_CELLS * grid.fine
    layers = n * WINDINGS * grid.cores
    radii = np.concatenate(
        [
            np.linspace(CORE_INNER, CORE_OUTER, grid.tube + 1),
            # Thin layers where the spiral leaves the tube: strains are singular along that corner.
            CORE_OUTER + (RADIUS - CORE_OUTER) * (np.arange(1, grid.spiral + 1) / grid.spiral) ** 2,
        ]
    )
    heights = np.concatenate(
        [
            np.linspace(-HEIGHT, 0.0, grid.disc + 1)[:-1],
            np.linspace(0.0, CORE * grid.cores, layers + 1),
            CORE * grid.cores + np.linspace(0.0, HEIGHT, grid.disc + 1)[1:],
        ]
    )
    base = grid.disc
    prisms = []
    for k in range(len(heights) - 1):
        for i in range(n):
            # Corners (angle, height) of the triangles below and above the cell's diagonal, which follows the helix.
            below = ((i, k), (i + 1, k), (i + 1, k + 1))
            above = ((i, k), (i + 1, k + 1), (i, k + 1))
            turn = k - base
            for triangle, lies_above in ((below, False), (above, True)):
                # Cells of angle between the upper flank's diagonal and this one, on from where the material is.
                behind = (i - turn - (1 if lies_above else 0)) % n
                solid = not 0 <= turn < layers
                inside = solid or (spiral and behind < wide)
                last = len(radii) - 1 if inside else grid.tube
                prisms.extend((j, triangle) for j in range(last))
    table = {}
    points = []

    def node(j: int, i: int, k: int) -> int:
        key = (j, i % n, k)
        if key not in table:
            table[key] = len(points)
            points.append((radii[j], 2.0 * math.pi * (i % n) / n, heights[k]))
        return table[key]

    cells = []
    for j, triangle in prisms:
        # The corners in one order for all cells, so that the faces' diagonals agree.
        order = sorted(triangle, key=lambda corner: (corner[1], corner[0]))
        low = [node(j, i, k) for i, k in order]
        high = [node(j + 1, i, k) for i, k in order]
        cells += [
            (low[0], low[1], low[2], high[2]),
            (low[0], low[1], high[1], high[2]),
            (low[0], high[0], high[1], high[2]),
        ]
    polar = np.array(points).T
    flat = MeshTet(_cartesian(polar), np.array(cells).T)
    # Nodes at half the angle and not on the chord.
    first, second = flat.edges
    turn = (polar[1, second] - polar[1, first] + math.pi) % (2.0 * math.pi) - math.pi
    middle = 0.5 * (polar[:, first] + polar[:, second])
    middle[1] = polar[1, first] + 0.5 * turn
    quadratic = MeshTet2.from_mesh(flat)
    doflocs = quadratic.doflocs.copy()
    doflocs[:, : flat.p.shape[1]] = flat.p
    doflocs[:, flat.p.shape[1] :] = _cartesian(middle)
    return MeshTet2(doflocs, quadratic.t)


def _cartesian(polar: np.ndarray) -> np.ndarray:
    return np.stack([polar[0] * np.cos(polar[1]), polar[0] * np.sin(polar[1]), polar[2]])


@BilinearForm
def elasticity(u, v, _):
    """Linear isotropic elasticity."""
    strain = sym_grad(u)
    return ddot(2.0 * SHEAR * strain + LAME * eye(trace(strain), 3), sym_grad(v))


def assembled(grid: Grid, spiral: bool):
    """Mesh's basis and stiffness matrix."""
    basis = Basis(mesh(grid, spiral), ElementVector(ElementTetP2()), intorder=4)
    return basis, elasticity.assemble(basis).tocsr()


def rigid(points: np.ndarray, centre: np.ndarray) -> np.ndarray:
    """Displacements (6, 3, n) of points (3, n): three translations, three small rotations about `centre`."""
    out = np.zeros((6, *points.shape))
    for c in range(3):
        out[c, c] = 1.0
        axis = np.zeros(3)
        axis[c] = 1.0
        out[3 + c] = np.cross(axis, (points - centre[:, None]).T).T
    return out


def stiffness(grid: Grid, spiral: bool):
    """Stiffness (6, 6) of one end against the other, both glued to rigid bodies."""
    basis, matrix = assembled(grid, spiral)
    low, high = (-HEIGHT, CORE + HEIGHT) if grid.disc else (0.0, CORE * grid.cores)
    where = basis.doflocs
    component = components(basis)
    clamped = np.flatnonzero(np.abs(where[2] - low) < 1e-9)
    moved = np.flatnonzero(np.abs(where[2] - high) < 1e-9)
    motion = np.zeros((basis.N, 6))
    shapes = rigid(where[:, moved], np.array([0.0, 0.0, high]))
    for way in range(6):
        motion[moved, way] = shapes[way][component[moved], np.arange(len(moved))]
    free = np.setdiff1d(np.arange(basis.N), np.concatenate([clamped, moved]))
    inner = matrix[free][:, free].tocsr()
    motion[free] = solve(inner, -(matrix[free] @ motion))
    return motion.T @ (matrix @ motion), basis, motion


def solve(matrix, right: np.ndarray) -> np.ndarray:
    """Solution of a symmetric system for several right sides."""
    solver = pypardiso.PyPardisoSolver(mtype=2)
    return solver.solve(triu(matrix, format="csr"), np.ascontiguousarray(right))


def components(basis) -> np.ndarray:
    """Which component of the displacement each unknown is."""
    out = np.empty(basis.N, dtype=int)
    for c in range(3):
        out[basis.nodal_dofs[c]] = c
        out[basis.edge_dofs[c]] = c
    return out


def warping(grid: Grid):
    """Displacements under pure moments about x and y for a turn of one radian, less those of a rod bent to an arc.

    Of every moment: of the lower and the upper flank three splines by radius and angle from the flank's start, and the
    far end's shift and turn.
    """
    matrix, basis, motion = stiffness(grid, spiral=True)
    compliance = np.linalg.inv(matrix)
    component = components(basis)
    trees = [KDTree(basis.doflocs[:, component == c].T) for c in range(3)]
    radii = CORE_OUTER + (RADIUS - CORE_OUTER) * (np.arange(grid.spiral + 1) / grid.spiral) ** 2
    r = np.sort(np.concatenate([radii, 0.5 * (radii[1:] + radii[:-1])]))
    cells = TURN_CELLS * grid.fine * WINDINGS
    t = np.linspace(0.0, 2.0 * math.pi * WINDINGS, 2 * cells + 1)
    rr, tt = np.meshgrid(r, t, indexing="ij")
    flanks, ends = [], []
    for axis in (0, 1):
        amplitudes = compliance[:, 3 + axis] / compliance[3 + axis, 3 + axis]
        displacement = motion @ amplitudes
        about = np.eye(3)[axis]
        arc = np.cross(about, [0.0, 0.0, 1.0])
        ends.append((amplitudes[:3] - arc * CORE / 2.0, amplitudes[3:] - about))
        splines = []
        for start in (2.0 * math.pi * SECTOR_CELLS / TURN_CELLS, 0.0):
            x, y, part = rr * np.cos(tt + start), rr * np.sin(tt + start), tt / t[-1]
            points = np.stack([x, y, CORE * part], -1)
            section = np.stack([x, y, np.zeros_like(x)], -1)
            rod = np.cross(about, section) * part[..., None] + arc * (CORE / 2.0 * part**2)[..., None]
            flank = []
            for c in range(3):
                distance, index = trees[c].query(points.reshape(-1, 3))
                if distance.max() > 1e-9:
                    raise SystemExit("a point of the flank is not a node of the mesh")
                found = displacement[component == c][index].reshape(rr.shape)
                flank.append(RectBivariateSpline(r, t, found - rod[..., c]))
            splines.append(flank)
        flanks.append(splines)
    return flanks, ends


def compliances(grid: Grid, spiral: bool) -> tuple[np.ndarray, int]:
    """Turn about x and y by a moment (rad/N m), about z by a torque, shift by a pull (m/N); number of unknowns."""
    matrix, basis, _ = stiffness(grid, spiral)
    return np.diag(np.linalg.inv(matrix))[[3, 4, 5, 2]], basis.N


def rod(grid: Grid) -> np.ndarray:
    """The same of the rod, which bends as a tube without a spiral, and as discs in a row with it."""
    moduli = np.array([ELASTIC, ELASTIC, SHEAR, ELASTIC])
    out = np.zeros(4)
    for outer, length in ((CORE_OUTER, CORE * grid.cores), (RADIUS, 2.0 * HEIGHT if grid.disc else 0.0)):
        inertia = math.pi / 4.0 * (outer**4 - CORE_INNER**4)
        area = math.pi * (outer**2 - CORE_INNER**2)
        out += length / (moduli * np.array([inertia, inertia, 2.0 * inertia, area]))
    return out


def main() -> None:
    """Computes and writes the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--fine", action="store_true", help="a mesh of twice the cells around and along too")
    arguments = parser.parse_args()
    short, long = Grid(1, 1, 1), Grid(1, 1, 1, cores=2)
    added = compliances(long, spiral=False)[0] - compliances(short, spiral=False)[0]
    checked = (rod(long) - rod(short)) / added
    print("tube over closed form (bending x, y, torsion, axial):", checked, flush=True)
    grids = [Grid(1, 1, 2), Grid(1, 1, 3), Grid(1, 1, 4), Grid(1, 1, 3, 2)]
    if arguments.fine:
        grids.insert(3, Grid(2, 1, 3))
    rows, tubes = [], {}
    for grid in grids:
        key = (grid.fine, grid.disc)
        if key not in tubes:
            tubes[key], _ = compliances(grid, spiral=False)
        both, unknowns = compliances(grid, spiral=True)
        row = ["discs" if grid.disc else "rigid", TURN_CELLS * grid.fine, grid.spiral, unknowns]
        row += [f"{value:.4f}" for value in (*(tubes[key] / both), *(rod(grid) / both))]
        print(*row, flush=True)
        rows.append(row)
    path = Path(__file__).with_suffix(".csv")
    names = ["bending_x", "bending_y", "torsion", "axial"]
    with path.open("w", newline="", encoding="utf-8") as table:
        writer = csv.writer(table, lineterminator="\n")
        header = ["ends", "cells_per_turn", "spiral_layers", "unknowns"]
        writer.writerow(header + [f"{name}_ratio" for name in names] + [f"{name}_over_rod" for name in names])
        writer.writerows(rows)
    print(f"written: {path.name}")


if __name__ == "__main__":
    main()
