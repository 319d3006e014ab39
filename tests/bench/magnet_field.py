"""Fields of magnets of every shape in high precision, and how far magpylib is from them.

    fmu/venv tests/bench/requirements.txt
    .venv/bin/python tests/bench/magnet_field.py --out tests/magnetics/magnets.csv

The field of a uniform remanence b is b_j d_i d_j V, and b more inside, with the Newtonian potential V of the body over
4 pi. The second derivatives of V are the textbook's: of a cuboid logarithms and arc tangents of its corners (Yang,
Superconductor Science and Technology 3 (1990), 591), of a cylinder Legendre's integrals. Further derivatives are
differences with 160 digits.
"""

import argparse
import csv
import functools
import itertools
import random
from pathlib import Path

import magpylib
import mpmath
import numpy
from mpmath import mpf

mpmath.mp.dps = 160

# Name, shape, dimensions (m) and remanence (T).
MAGNETS = [
    ("cube", "cuboid", (0.01, 0.01, 0.01), (0.0, 0.0, 1.45)),
    ("bar", "cuboid", (0.005, 0.012, 0.02), (0.4, -0.6, 1.2)),
    ("plate", "cuboid", (0.04, 0.03, 0.002), (0.0, 0.0, 1.3)),
    ("cylinder", "cylinder", (0.0, 0.0225, 0.03), (1.35, 0.0, 0.0)),
    ("disc", "cylinder", (0.0, 0.02, 0.002), (0.6, 0.5, -0.9)),
    ("rod", "cylinder", (0.0, 0.002, 0.02), (0.0, 1.2, 0.3)),
    ("ring", "cylinder", (0.01, 0.03, 0.015), (0.7, -0.3, 1.0)),
]
RANGES = [("near", 1.05, 2), ("mid", 2, 6), ("far", 6, 13), ("very far", 13, 300)]


def points_of(shape, size, rng):
    """Points near faces and edges, on axes, inside, near and far (m), each with what it is."""
    half = [edge / 2 for edge in size] if shape == "cuboid" else [size[1], size[1], size[2] / 2]
    least, extent = min(half), float(numpy.linalg.norm(half[:3] if shape == "cuboid" else half[1:]))
    inner = 0.0 if shape == "cuboid" else size[0]
    found = [("axis", [0.0, 0.0, 1.7 * half[2]]), ("axis", [1.7 * half[0], 0.0, 0.0])]
    found.append(("beside", [1e-6 * least, 7e-7 * least, 1.5 * half[2]]))
    found.append(("beside", [1e-3 * least, 7e-4 * least, -1.2 * half[2]]))
    if shape == "cuboid":
        # On the line that goes on from an edge, and almost there.
        found.append(("beside", [half[0], half[1], 2 * half[2]]))
        found.append(("beside", [half[0], half[1] + 1e-6 * least, -2 * half[2]]))
    for gap in (1e-4, 1e-2, 1e-2):
        angle, share = rng.uniform(0, 6.28), rng.uniform(0.3, 0.8)
        at = [half[0] * share * numpy.cos(angle), half[1] * share * numpy.sin(angle), half[2] + gap * least]
        if shape == "cylinder":
            across = (inner + share * (size[1] - inner)) / size[1] / share
            at = [at[0] * across, at[1] * across, at[2]]
        found.append(("face", at))
    for gap in (1e-3, -1e-3, 1e-2):
        angle = rng.uniform(0, 6.28)
        at = [half[0] + gap * least, 0.3 * half[1], half[2] + abs(gap) * least]
        if shape == "cylinder":
            rho = size[1] + gap * least
            at = [rho * numpy.cos(angle), rho * numpy.sin(angle), half[2] + abs(gap) * least]
        found.append(("edge", at))
    for _ in range(3):
        angle, rho = rng.uniform(0, 6.28), inner + rng.uniform(0.1, 0.9) * (half[0] - inner)
        across = half[1] / half[0]
        z = half[2] * rng.uniform(-0.8, 0.8)
        found.append(("inside", [rho * numpy.cos(angle), across * rho * numpy.sin(angle), z]))
    for (name, low, high), _ in itertools.product(RANGES, range(4)):
        direction = numpy.array([rng.gauss(0, 1) for _ in range(3)])
        reach = extent * numpy.exp(rng.uniform(numpy.log(low), numpy.log(high)))
        found.append((name, list(direction / numpy.linalg.norm(direction) * reach)))
    return [(name, [float(v) for v in at]) for name, at in found]


@functools.lru_cache(maxsize=4096)
def of_cuboid(size, x, y, z):
    """The second derivatives xx, xy, xz, yy, yz, zz of V of a cuboid."""
    sums = [mpf(0)] * 6
    for signs in itertools.product((-1, 1), repeat=3):
        u, v, w = (c - s * mpf(edge) / 2 for c, s, edge in zip((x, y, z), signs, size, strict=True))
        r, sign = mpmath.sqrt(u * u + v * v + w * w), signs[0] * signs[1] * signs[2]
        parts = (
            mpmath.atan2(v * w, u * r) if u > 0 else -mpmath.atan2(v * w, -u * r),
            -mpmath.log(w + r),
            -mpmath.log(v + r),
            mpmath.atan2(w * u, v * r) if v > 0 else -mpmath.atan2(w * u, -v * r),
            -mpmath.log(u + r),
            mpmath.atan2(u * v, w * r) if w > 0 else -mpmath.atan2(u * v, -w * r),
        )
        sums = [total + sign * part for total, part in zip(sums, parts, strict=True)]
    return [total / (4 * mpmath.pi) for total in sums]


def of_edge(a, rho, u):
    """dV/drho / rho, d2V/drho dz / rho and d2V/dz2 of a half-infinite cylinder, less those of half an infinite one."""
    far = (a + rho) ** 2 + u * u
    root, m, n = mpmath.sqrt(far), 4 * a * rho / far, 4 * a * rho / (a + rho) ** 2
    k, e, third = mpmath.ellipk(m), mpmath.ellipe(m), mpmath.ellippi(n, m)
    axial = u / (2 * mpmath.pi * root) * (k + (a - rho) / (a + rho) * third)
    radial = 2 * ((1 - m / 2) * k - e) / (-mpmath.pi * m * root) * a / rho
    p = 1 - n
    i = 16 / ((a + rho) ** 2 * root * n) * ((k - e) / m - p * (third - k) / n)
    return -(a**2) / (4 * mpmath.pi) * u * i, radial, axial


@functools.lru_cache(maxsize=4096)
def of_cylinder(size, x, y, z):
    """g = dV/drho / rho and the derivatives xz, yz, zz of V of a cylinder or ring."""
    inner, outer, length = (mpf(number) for number in size)
    rho = mpmath.sqrt(x * x + y * y)
    edges = [(outer, 1), (inner, -1)] if inner > 0 else [(outer, 1)]
    g = radial = axial = mpf(0)
    for a, sign in edges:
        for end in (-1, 1):
            parts = of_edge(a, rho, z - end * length / 2)
            g, radial, axial = (
                total - sign * end * part for total, part in zip((g, radial, axial), parts, strict=True)
            )
    return g, x * radial, y * radial, axial


def derivative(shape, size, at, indices):
    """Derivative of V along these two to four axes."""
    indices = tuple(sorted(indices))
    if shape == "cuboid":
        place = {(0, 0): 0, (0, 1): 1, (0, 2): 2, (1, 1): 3, (1, 2): 4, (2, 2): 5}[indices[-2:]]
        rest = indices[:-2]

        def function(*c):
            return of_cuboid(size, *c)[place]

    elif indices[-1] < 2:
        # V_x = x g and V_y = y g.
        rest, first = indices[:-1], indices[-1]

        def function(*c):
            return c[first] * of_cylinder(size, *c)[0]

    else:
        rest, place = indices[:-2], indices[-2] + 1

        def function(*c):
            return of_cylinder(size, *c)[place]

    order = tuple(rest.count(axis) for axis in range(3))
    if not any(order):
        return function(*at)
    step = mpf(10) ** -22 * max(abs(c) for c in at)
    return difference(function, at, order, step)


def difference(function, at, order, step):
    """Central differences of second order, of error step squared."""
    for axis, count in enumerate(order):
        if count == 0:
            continue
        rest = tuple(c - (i == axis) for i, c in enumerate(order))
        up, down = (tuple(c + side * step * (i == axis) for i, c in enumerate(at)) for side in (1, -1))
        return (difference(function, up, rest, step) - difference(function, down, rest, step)) / (2 * step)
    return function(*at)


def jet(shape, size, b, at):
    """B, the gradient's six entries and the second derivative's ten."""
    # The textbook's formulas are singular on an axis, and on the lines that go on from an edge.
    aside = mpf(10) ** -22 * max(map(abs, at))
    at = tuple(mpf(c) + aside * share for c, share in zip(at, (1, mpf(7) / 10, 0), strict=True))
    of = functools.cache(lambda indices: derivative(shape, size, at, indices))
    sums = []
    for rank in (1, 2, 3):
        for indices in itertools.combinations_with_replacement(range(3), rank):
            total = sum(mpf(b[j]) * of(tuple(sorted((*indices, j)))) for j in range(3) if b[j] != 0)
            sums.append(total)
    inside = is_inside(shape, size, at)
    # Of a cylinder the textbook's B_z holds the remanence along its axis.
    added = [b[i] if inside and (shape == "cuboid" or i < 2) else 0.0 for i in range(3)]
    sums[:3] = [total + mpf(more) for total, more in zip(sums, added, strict=False)]
    return sums


def is_inside(shape, size, at):
    """Whether a point is inside a body of this shape."""
    if shape == "cuboid":
        return all(abs(c) < mpf(edge) / 2 for c, edge in zip(at, size, strict=True))
    return size[0] < mpmath.sqrt(at[0] ** 2 + at[1] ** 2) < size[1] and abs(at[2]) < mpf(size[2]) / 2


def of_magpylib(shape, size, b, at):
    """B of magpylib, T."""
    if shape == "cuboid":
        return magpylib.magnet.Cuboid(polarization=b, dimension=size).getB(at)
    if size[0] > 0:
        dimension = (size[0], size[1], size[2], 0, 360)
        return magpylib.magnet.CylinderSegment(polarization=b, dimension=dimension).getB(at)
    return magpylib.magnet.Cylinder(polarization=b, dimension=(2 * size[1], size[2])).getB(at)


def main():
    """Write the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--out", type=Path, default=Path("tests/magnetics/magnets.csv"))
    out = parser.parse_args().out
    names = [
        "".join("xyz"[i] for i in c)
        for r in (2, 3)
        for c in itertools.combinations_with_replacement(range(3), r)
    ]
    rng, worst = random.Random(7), {}
    with out.open("w", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["magnet", "where", "x", "y", "z", "Bx", "By", "Bz", *(f"d{n}" for n in names)])
        for name, shape, size, b in MAGNETS:
            for where, at in points_of(shape, size, rng):
                exact = jet(shape, size, b, at)
                rows.writerow([name, where, *map(repr, at), *(mpmath.nstr(v, 20) for v in exact)])
                field = numpy.array([float(v) for v in exact[:3]])
                peer = numpy.linalg.norm(of_magpylib(shape, size, b, at) - field) / numpy.linalg.norm(field)
                worst[name, where] = max(worst.get((name, where), 0.0), peer)
    for (name, where), error in worst.items():
        print(f"{name} {where} {error:.1e}")


if __name__ == "__main__":
    main()
