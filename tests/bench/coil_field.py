"""The field of a thick coil in high precision, and how far thin sheets of magpylib are from it.

    fmu/venv tests/bench/requirements.txt
    .venv/bin/python tests/bench/coil_field.py --out tests/magnetics/coil.csv

Each point's field is the integral of the fields of current loops (Smythe, Static and Dynamic Electricity,
7.10) over the winding's section, by mpmath with 30 digits. A thin sheet has the field of a magnetised cylinder
of its radius.
"""

import argparse
import csv
from pathlib import Path

import magpylib
import mpmath
import numpy

mpmath.mp.dps = 30

INNER, OUTER, LENGTH, TURNS = 0.02, 0.04, 0.06, 600  # m, turns
SHEETS = (6, 20, 100)

# rho and z of each point, m: in the bore, beside, above, at the corner, far away.
POINTS = [
    (0.0, 0.0),
    (0.0, 0.05),
    (0.01, 0.0),
    (0.01, 0.028),
    (0.015, 0.02),
    (0.0175, 0.03),
    (0.06, 0.0),
    (0.05, 0.01),
    (0.0425, 0.02),
    (0.03, 0.06),
    (0.03, 0.035),
    (0.02, 0.04),
    (0.0425, 0.0325),
    (0.045, 0.045),
    (0.1, 0.02),
    (0.15, 0.1),
    (0.05, 0.2),
    (0.4, 0.3),
]


def loop(radius, rho, z):
    """B_rho and B_z (T/A) of a loop of current in the plane z = 0."""
    mu = 4 * mpmath.pi * mpmath.mpf("1e-7")
    if rho == 0:
        return mpmath.mpf(0), mu * radius**2 / (2 * (radius**2 + z**2) ** mpmath.mpf("1.5"))
    far, near = (radius + rho) ** 2 + z**2, (radius - rho) ** 2 + z**2
    m = 4 * radius * rho / far
    k, e = mpmath.ellipk(m), mpmath.ellipe(m)
    scale = mu / (2 * mpmath.pi * mpmath.sqrt(far))
    along = scale * (k + (radius**2 - rho**2 - z**2) / near * e)
    across = scale * z / rho * (-k + (radius**2 + rho**2 + z**2) / near * e)
    return across, along


def coil(rho, z):
    """B_rho and B_z (T/A) of the coil."""
    rho, z = mpmath.mpf(rho), mpmath.mpf(z)
    inner, outer, half = mpmath.mpf(INNER), mpmath.mpf(OUTER), mpmath.mpf(LENGTH) / 2
    density = TURNS / ((outer - inner) * 2 * half)
    # Split where the loops come nearest, so that each part is smooth.
    radii = sorted({inner, outer, *([rho] if inner < rho < outer else []), (inner + outer) / 2})
    places = sorted({-half, half, *([z] if -half < z < half else []), mpmath.mpf(0)})
    parts = [
        mpmath.quad(lambda r, h, part=part: loop(r, rho, z - h)[part], radii, places, method="gauss-legendre")
        for part in (0, 1)
    ]
    return [density * part for part in parts]


def sheets(rho, z, count):
    """The same by so many thin sheets in magpylib, each a magnetised cylinder of the sheet's radius."""
    edges = numpy.linspace(INNER, OUTER, count + 1)
    field = numpy.zeros(3)
    for radius in 0.5 * (edges[1:] + edges[:-1]):
        magnetisation = TURNS / LENGTH / count  # A/m for one ampere
        sheet = magpylib.magnet.Cylinder(magnetization=(0, 0, magnetisation), dimension=(2 * radius, LENGTH))
        field += sheet.getB((rho, 0, z))
    return field[0], field[2]


def main():
    """Writes the table and prints the errors of the sheets."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", required=True, type=Path, help="the table to write (CSV)")
    out = parser.parse_args().out
    rows = [(rho, z, *coil(rho, z)) for rho, z in POINTS]
    with out.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["rho_m", "z_m", "b_rho_t_per_a", "b_z_t_per_a"])
        for rho, z, across, along in rows:
            writer.writerow([rho, z, mpmath.nstr(across, 18), mpmath.nstr(along, 18)])
    for count in SHEETS:
        worst = 0.0
        for rho, z, across, along in rows:
            got = sheets(rho, z, count)
            error = mpmath.hypot(got[0] - across, got[1] - along) / mpmath.hypot(across, along)
            worst = max(worst, float(error))
        print(f"magpylib {magpylib.__version__}, {count} sheets: {worst:.1e} of the field")


if __name__ == "__main__":
    main()
