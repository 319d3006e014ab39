"""Peer: magpylib's field of a ring and of a cylinder, point by point and in a batch."""

import time

import magpylib
import numpy as np

POINTS = 64
BATCH = 4096


def source(body: str):
    """The ring or the cylinder of the bench, and its outer radius (m)."""
    if body == "ring":
        radius, dimension = 2e-3, (0.75e-3, 2e-3, 1e-3, 0, 360)
        return magpylib.magnet.CylinderSegment(dimension=dimension, polarization=(0, 0, 1.35)), radius
    return magpylib.magnet.Cylinder(dimension=(45e-3, 30e-3), polarization=(0, 0, 1.35)), 22.5e-3


def points(radius: float) -> np.ndarray:
    """The bench's points: 2.1 to 6 radii from the centre, all around."""
    i = np.arange(POINTS)
    distance, polar, azimuth = radius * (2.1 + i * 3.9 / 63), 0.1 + i * 0.0465, i * 2.4
    rho = distance * np.sin(polar)
    return np.column_stack([rho * np.cos(azimuth), rho * np.sin(azimuth), distance * np.cos(polar)])


def measure(body: str) -> tuple[float, float]:
    """Time (s) of a call for one point, and of a point in a batch."""
    magnet, radius = source(body)
    at = points(radius)
    many = np.tile(at, (BATCH // POINTS, 1))
    magnet.getB(at)
    start = time.perf_counter()
    for point in at:
        magnet.getB(point)
    single = (time.perf_counter() - start) / POINTS
    start = time.perf_counter()
    magnet.getB(many)
    return single, (time.perf_counter() - start) / BATCH
