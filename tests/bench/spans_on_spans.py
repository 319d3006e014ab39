"""What spans acting on one another do to the bending stiffness: magnetostatic energy of the bent composite (MPC).

Run (about 6 minutes): .venv/bin/python tests/bench/spans_on_spans.py
With the motion of finite elements too: fmu/venv tests/bench/finite_elements.txt, and the option --elastic (3 minutes
more).
Writes tests/bench/spans_on_spans.csv and prints how it converges.

The energy is that of the magnetic charges, E = mu0 / (8 pi) sum sum q q' / |x - x'|, touching parts in it. For a
body with deformation gradient F and magnetisation M they belong to the reference shape, q = det(F) F^-1 M . N dA:
here to faces and to flanks of the spiral alone. Sheets are cut into panels; pairs that are close are cut again, and
what touches at the finest cut is summed up by Gauss points of two different rules, which errs by a constant times
the size of a panel, and its square: three sizes give the limit (Richardson), the last two steps to it the
uncertainty.

Motion of the composite:
    sections: every section, the spiral's sector in it, is a rigid section of the rod.
    windings: a winding does not stretch; at every angle the gaps between windings share the bend in proportion.
    elastic: as linear elastic finite elements of core and spiral move under a pure moment.
Magnetisation under strain:
    steady: the charges stay, M = F M0 / det F. With rigid sections |M| stays: as if the material kept its volume.
    kept: the moment of the material stays, M = M0 d3 / det F, as the level `full` has it. Rigid sections change the
    volume, so |M| changes, and the energy is only defined up to a part of mu0/2 int M^2 dV (`local_percent`).
"""

import argparse
import csv
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

MU0 = 4e-7 * math.pi

# Table 1 of Richter et al., m, and its Eq. (2), (3), (11), (14), (15).
LENGTH, RADIUS, CORE_OUTER, CORE_INNER, WINDINGS = 4.0e-3, 2.0e-3, 0.95e-3, 0.75e-3, 2
PITCH = RADIUS * math.radians(40.0) / WINDINGS
HEIGHT = (LENGTH - WINDINGS * PITCH) / (2 + WINDINGS)
SECTOR = 2.0 * math.pi * HEIGHT / (HEIGHT + PITCH)
CORE = LENGTH - 2.0 * HEIGHT
TURN = 2.0 * math.pi * WINDINGS
RING = 1.0e-3
ELASTIC = 1.29447e6 * math.exp(2.5 * 0.25 / (1.0 - 1.35 * 0.25))
MAGNETISATION = 0.25 * 1.0 / MU0
BENDING = ELASTIC * math.pi / 4.0 * (CORE_OUTER**4 - CORE_INNER**4)

# Two panels farther apart than this many sums of their radii need not be cut.
APART = 1.3
# Points along an edge of a panel; the second of a pair has one more, so that no two points coincide.
POINTS = 3
# Pairs of panels that are summed up at a time.
CHUNK = 4096
# Bends of a core, deg.
BENDS = (10.0, 20.0, 30.0)
# Finest cuts of the panels of a segment with itself; other segments are far enough for none.
CUTS = (0, 1, 2)


@dataclass(frozen=True)
class Model:
    """How the composite moves with the rod, and how its magnetisation follows the strain."""

    spiral: str  # helical | axisymmetric
    motion: str  # sections | windings | elastic
    moment: str  # steady | kept
    warp: "Warp | None" = None


class Warp:
    """Displacements by finite elements less those of the rod, for a bend of one radian about x and about y."""

    def __init__(self) -> None:
        import spiral_stiffness as elements  # noqa: PLC0415  it needs packages of its own

        self.flanks, self.ends = elements.warping(elements.Grid(1, 1, 3, 0))

    def of(
        self, bend: np.ndarray, sheet: np.ndarray, r: np.ndarray, t: np.ndarray, local: np.ndarray
    ) -> np.ndarray:
        """Displacements (n, points, 3) in the axes of the section."""
        out = np.zeros((*r.shape, 3))
        for angle, flanks, (shift, turn) in zip(bend, self.flanks, self.ends, strict=True):
            for which, start, splines in ((LOWER, SECTOR, flanks[0]), (UPPER, 0.0, flanks[1])):
                at = sheet == which
                for c, spline in enumerate(splines):
                    out[at, c] += angle * spline(r[at], t[at] - start, grid=False)
            at = np.isin(sheet, (FAR, FAR_INNER))
            out[at] += angle * (shift + np.cross(turn, local[at]))
        return out


@dataclass
class Panels:
    """Panels r0..r1, t0..t1 (t the angle, counted on along the spiral) of one sheet each."""

    bounds: np.ndarray  # (n, 4): r0, r1, t0, t1
    sheet: np.ndarray  # (n,): which sheet

    def cut(self) -> "Panels":
        """Every panel in four; those of panel i are 4 i to 4 i + 3."""
        r0, r1, t0, t1 = self.bounds.T
        r, t = 0.5 * (r0 + r1), 0.5 * (t0 + t1)
        quarters = [(r0, r, t0, t), (r, r1, t0, t), (r0, r, t, t1), (r, r1, t, t1)]
        return Panels(
            np.stack([np.stack(q, 1) for q in quarters], 1).reshape(-1, 4), np.repeat(self.sheet, 4)
        )


# The sheets: faces of the segment, of the discs towards the core where nothing is glued to them, what discs and core
# leave of their charges where they are glued together, lower and upper flank of the spiral.
NEAR, FAR, NEAR_INNER, FAR_INNER, NEAR_CORE, FAR_CORE, LOWER, UPPER = range(8)


def sheets(model: Model) -> Panels:
    """The sheets of a segment, cut into panels of about 0.5 mm."""
    rows = []

    def add(sheet: int, r0: float, r1: float, t0: float, t1: float) -> None:
        radial = max(1, round((r1 - r0) / 0.5e-3))
        around = max(1, round((t1 - t0) * 0.5 * (r0 + r1) / 0.5e-3))
        r, t = np.linspace(r0, r1, radial + 1), np.linspace(t0, t1, around + 1)
        rows.extend((sheet, r[i], r[i + 1], t[k], t[k + 1]) for i in range(radial) for k in range(around))

    circle = 2.0 * math.pi
    for sheet in (NEAR, FAR):
        add(sheet, CORE_INNER, RADIUS, 0.0, circle)
    for inner, core in ((NEAR_INNER, NEAR_CORE), (FAR_INNER, FAR_CORE)):
        if model.moment == "kept":
            add(core, CORE_INNER, CORE_OUTER, 0.0, circle)
        if model.spiral == "axisymmetric":
            add(core, CORE_OUTER, RADIUS, 0.0, circle)
        else:
            add(inner, CORE_OUTER, RADIUS, SECTOR, circle)
            if model.moment == "kept" and model.motion == "sections":
                add(core, CORE_OUTER, RADIUS, 0.0, SECTOR)
    if model.spiral == "helical":
        add(LOWER, CORE_OUTER, RADIUS, SECTOR, TURN)
        add(LOWER, CORE_OUTER, RADIUS, TURN, TURN + SECTOR)
        add(UPPER, CORE_OUTER, RADIUS, 0.0, SECTOR)
        add(UPPER, CORE_OUTER, RADIUS, SECTOR, TURN)
    table = np.array(rows)
    return Panels(table[:, 1:], table[:, 0].astype(int))


def winding_frame(t: np.ndarray) -> np.ndarray:
    """Arc length of the section that carries the winding at angle t, if only the gaps between windings are strained."""
    per_turn = CORE / WINDINGS
    turn, angle = np.divmod(t, 2.0 * math.pi)
    within = np.clip((angle - SECTOR) / (2.0 * math.pi - SECTOR), 0.0, 1.0)
    return per_turn * (turn + within)


def place(model: Model, panels: Panels, points: int, bend: np.ndarray, segment: int):
    """Points (n, points^2, 3) of a segment's panels and their charges; every core is bent by `bend` (rad)."""
    nodes, weights = np.polynomial.legendre.leggauss(points)
    u, w = 0.5 * (1.0 + nodes), 0.5 * weights
    r0, r1, t0, t1 = (column[:, None] for column in panels.bounds.T)
    uu, vv = (grid.ravel() for grid in np.meshgrid(u, u, indexing="ij"))
    ww = np.outer(w, w).ravel()
    r, t = r0 + (r1 - r0) * uu, t0 + (t1 - t0) * vv
    sheet = np.broadcast_to(panels.sheet[:, None], r.shape)
    area = (r1 - r0) * (t1 - t0) * ww * r
    x, y = r * np.cos(t), r * np.sin(t)
    curvature = bend / CORE

    # The section's arc length, and how far in front of it the point lies.
    climb = CORE / TURN
    height = np.select(
        [sheet == LOWER, sheet == UPPER, np.isin(sheet, (FAR, FAR_INNER, FAR_CORE))],
        [climb * (t - SECTOR), climb * t, CORE],
        0.0,
    )
    ahead = np.select([sheet == NEAR, sheet == FAR], [-HEIGHT, HEIGHT], 0.0)
    if model.motion == "windings":
        flank = np.isin(sheet, (LOWER, UPPER))
        section = np.where(flank, winding_frame(t), height)
        ahead = ahead + height - section
        height = section
    stretch = 1.0 + curvature[0] * y - curvature[1] * x
    kept = 1.0 / stretch if model.moment == "kept" else np.ones_like(x)
    if model.motion == "windings":
        kept = np.where(r > CORE_OUTER, 1.0, kept)
    share = 1.0
    if model.spiral == "axisymmetric":
        share = np.where(r > CORE_OUTER, SECTOR / (2.0 * math.pi), 1.0)
    density = np.select(
        [
            np.isin(sheet, (NEAR, FAR_INNER)),
            np.isin(sheet, (FAR, NEAR_INNER)),
            sheet == LOWER,
            sheet == UPPER,
            sheet == NEAR_CORE,
        ],
        [-1.0, 1.0, -kept, kept, 1.0 - kept * share],
        kept * share - 1.0,
    )
    charge = density * area * MAGNETISATION
    local = np.stack([x, y, ahead], -1)
    if model.warp is not None:
        local = local + model.warp.of(bend, sheet, r, t, local)
    where = along(bend, height, local)
    for _ in range(segment):
        where = along(bend, np.array(CORE), where + np.array([0.0, 0.0, 2.0 * HEIGHT + RING]))
    return where, charge


def along(bend: np.ndarray, height: np.ndarray, local: np.ndarray) -> np.ndarray:
    """Points with coordinates `local` in the section at arc length `height` of a core bent to an arc."""
    angle = float(np.hypot(*bend))
    if angle == 0.0:
        return local + height[..., None] * np.array([0.0, 0.0, 1.0])
    axis = np.array([bend[0], bend[1], 0.0]) / angle
    side = np.cross(axis, [0.0, 0.0, 1.0])
    part = height * (angle / CORE)
    sine, versine = np.sin(part)[..., None], (1.0 - np.cos(part))[..., None]
    radius = CORE / angle
    crossed = np.cross(axis, local)
    rotated = local + sine * crossed + versine * np.cross(axis, crossed)
    return rotated + radius * (sine * np.array([0.0, 0.0, 1.0]) + versine * side)


class Sum:
    """Energies (J) of several shapes relative to the straight one, by all pairs of panels of two segments."""

    def __init__(self, model: Model, bends: list[np.ndarray], other: int, cuts: int) -> None:
        self.model, self.other, self.cuts = model, other, cuts
        self.bends = [np.zeros(2), *bends]
        self.energies = np.zeros(len(bends))
        self.straight = 0.0
        self.pairs = 0
        self.run()

    def run(self) -> None:
        """Cuts close pairs again until `cuts` times, and adds up the rest."""
        panels = sheets(self.model)
        count = len(panels.sheet)
        if self.other:
            first, second = (grid.ravel() for grid in np.meshgrid(range(count), range(count), indexing="ij"))
            weight = np.full(len(first), 2.0)
        else:
            first, second = np.triu_indices(count)
            weight = np.where(first == second, 1.0, 2.0)
        for level in range(self.cuts + 1):
            centre, radius = zip(*(self.balls(panels, segment) for segment in (0, self.other)), strict=True)
            gap = np.linalg.norm(centre[0][first] - centre[1][second], axis=1)
            close = gap < APART * (radius[0][first] + radius[1][second])
            if level == self.cuts:
                close[:] = False
            self.add(panels, first[~close], second[~close], weight[~close])
            first, second, weight = first[close], second[close], weight[close]
            if len(first) == 0:
                break
            panels = panels.cut()
            # Sixteen pairs of quarters; ten of a panel with itself.
            i, k = (grid.ravel() for grid in np.meshgrid(range(4), range(4), indexing="ij"))
            a, b, w = 4 * first[:, None] + i, 4 * second[:, None] + k, np.repeat(weight[:, None], 16, 1)
            same = (first == second)[:, None] & (self.other == 0)
            w = np.where(same & (i < k), 2.0, w)
            keep = ~(same & (i > k))
            first, second, weight = a[keep], b[keep], w[keep]

    def balls(self, panels: Panels, segment: int):
        """Centre and radius of a ball around every panel when straight."""
        where, _ = place(self.model, panels, 4, np.zeros(2), segment)
        centre = 0.5 * (where.min(axis=1) + where.max(axis=1))
        return centre, np.linalg.norm(where - centre[:, None], axis=2).max(axis=1)

    def add(self, panels: Panels, first: np.ndarray, second: np.ndarray, weight: np.ndarray) -> None:
        """Adds pairs of panels."""
        self.pairs += len(first)
        if len(first) == 0:
            return
        one = [place(self.model, panels, POINTS, bend, 0) for bend in self.bends]
        two = [place(self.model, panels, POINTS + 1, bend, self.other) for bend in self.bends]
        for start in range(0, len(first), CHUNK):
            part = slice(start, start + CHUNK)
            i, k, w = first[part], second[part], weight[part]
            found = []
            for (x, p), (y, q) in zip(one, two, strict=True):
                a, b = x[i], y[k]
                square = np.zeros((len(i), a.shape[1], b.shape[1]))
                for c in range(3):
                    square += (a[:, :, None, c] - b[:, None, :, c]) ** 2
                found.append(np.einsum("i,ij,ik,ijk->", w, p[i], q[k], 1.0 / np.sqrt(square), optimize=True))
            scale = MU0 / (8.0 * math.pi)
            self.straight += scale * found[0]
            self.energies += scale * (np.array(found[1:]) - found[0])


def limit(values: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Limit of results for panels of three sizes, each half of the one before, and the last step to it."""
    once = [2.0 * values[1] - values[0], 2.0 * values[2] - values[1]]
    twice = (4.0 * once[1] - once[0]) / 3.0
    return twice, np.abs(twice - once[1])


def local(model: Model, angle: float) -> float:
    """Change of mu0/2 int M^2 dV of one segment for a bend, over the elastic energy: by the area's second moments."""
    if model.moment != "kept":
        return 0.0
    tube = math.pi / 4.0 * (CORE_OUTER**4 - CORE_INNER**4)
    part = SECTOR / (2.0 * math.pi)
    power = {"helical": 1, "axisymmetric": 2}[model.spiral]
    inertia = tube
    if model.motion == "sections":
        inertia += part**power * math.pi / 4.0 * (RADIUS**4 - CORE_OUTER**4)
    return 0.5 * MU0 * MAGNETISATION**2 * inertia * angle**2 / CORE / elastic(angle)


def elastic(angle: float) -> float:
    """Elastic energy of one core without its spiral, J."""
    return 0.5 * BENDING / CORE * angle**2


def moments(angles: np.ndarray, energies: np.ndarray) -> np.ndarray:
    """Derivatives by the angle of an even function that is known at three angles."""
    powers = np.array([2, 4, 6])
    factors = np.linalg.solve(angles[:, None] ** powers, energies)
    return (powers * angles[:, None] ** (powers - 1)) @ factors


def study(model: Model, rows: list[list]) -> None:
    """Appends the rows of one model to the table, for one segment and for three in a row."""
    angles = np.radians(BENDS)
    axes = np.eye(2)
    bends = [sign * angle * axis for axis in axes for angle in angles for sign in (1.0, -1.0)]
    name = f"{model.spiral}, {model.motion}, {model.moment}"
    found = [Sum(model, bends, 0, cuts) for cuts in CUTS]
    for cuts, result in zip(CUTS, found, strict=True):
        even = result.energies.reshape(2, len(angles), 2).mean(-1)
        print(
            f"{name}: {cuts} cuts, {result.pairs} pairs, straight {1e6 * result.straight:.3f} uJ, softening "
            + ", ".join(f"{-100.0 * energy:.3f}" for energy in (even / elastic(angles)).ravel())
            + " % of the elastic energy",
            flush=True,
        )
    alone = [result.energies for result in found]
    # The warped end of one segment would move the next, which is left out.
    chains = (1, 3) if model.warp is None else (1,)
    for segments in chains:
        whole = alone
        if segments == 3:
            neighbours = [Sum(model, bends, other, 0).energies for other in (1, 2)]
            whole = [own + (2.0 * neighbours[0] + neighbours[1]) / 3.0 for own in alone]
        for i, axis in enumerate("xy"):
            shares, rest = [], []
            for energies in whole:
                both = energies.reshape(2, len(angles), 2)[i]
                moment = moments(angles, both.mean(-1))
                shares.append(-100.0 * moment * CORE / (BENDING * angles))
                rest.append(np.array((both[0, 1] - both[0, 0]) / (2.0 * angles[0]) * CORE / BENDING))
            share, doubt = limit(shares)
            bent, _ = limit(rest)
            for k, bend in enumerate(BENDS):
                rows.append(
                    [
                        *(model.spiral, model.motion, model.moment, segments, axis, f"{bend:.0f}"),
                        *(f"{share[k]:.3f}", f"{doubt[k]:.3f}", f"{100.0 * local(model, angles[k]):.2f}"),
                        f"{math.degrees(float(bent)):.3f}",
                    ]
                )
                print("   ", *rows[-1], flush=True)


HEADER = (
    *("spiral", "motion", "moment", "segments", "axis", "bend_deg"),
    *("softening_percent", "uncertainty_percent", "local_percent", "rest_bend_deg"),
)


def main() -> None:
    """Computes and writes the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--elastic", action="store_true", help="the motion of finite elements too")
    arguments = parser.parse_args()
    models = [
        Model("helical", "sections", "steady"),
        Model("helical", "sections", "kept"),
        Model("helical", "windings", "steady"),
        Model("helical", "windings", "kept"),
        Model("axisymmetric", "sections", "steady"),
        Model("axisymmetric", "sections", "kept"),
    ]
    if arguments.elastic:
        models.append(Model("helical", "elastic", "steady", Warp()))
    rows: list[list] = []
    for model in models:
        study(model, rows)
    path = Path(__file__).with_suffix(".csv")
    with path.open("w", newline="", encoding="utf-8") as table:
        writer = csv.writer(table, lineterminator="\n")
        writer.writerow(HEADER)
        writer.writerows(rows)
    print(f"written: {path.name}")


if __name__ == "__main__":
    main()
