"""Draws the way of a device through an aorta: from above with the vessels, and the forces over time."""

from pathlib import Path

import look
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import FuncAnimation, PillowWriter
from matplotlib.collections import PatchCollection

DEVICE, MAGNET = look.BLUE, look.NORTH
SHOWN = 8  # shapes in the picture
FRAMES = 80
PAPER = 90  # mN, measured on nine segments
SMOOTH = 6  # points of an outline between two of its branch


def balls(branch: dict) -> tuple[np.ndarray, np.ndarray]:
    """Centres and radii (mm) along a branch, close together."""
    points, radius = np.array(branch["points_mm"], dtype=float), branch["radius_mm"]
    radii = np.full(len(points), radius) if np.isscalar(radius) else np.array(radius)
    at = np.arange(len(points))
    fine = np.linspace(0, len(points) - 1, SMOOTH * (len(points) - 1) + 1)
    return np.array([np.interp(fine, at, column) for column in points.T]).T, np.interp(fine, at, radii)


def draw_vessels(axes, vessel: list[dict]) -> None:
    """The union of all balls, seen from above."""
    for grown, colour, order in ((1.0, look.WALL, 1), (0.0, look.LUMEN, 2)):
        circles = [
            plt.Circle((centre[2], centre[0]), radius + grown)
            for branch in vessel
            for centre, radius in zip(*balls(branch), strict=True)
        ]
        axes.add_collection(PatchCollection(circles, color=colour, lw=0, zorder=order))
    axes.set(xlabel="z, along the port (mm)", ylabel="x (mm)", aspect="equal")
    axes.autoscale_view()
    axes.grid(visible=False)


def draw_magnet(axes, columns: dict, row: int, alpha: float = 1.0) -> list:
    """Its place, and the direction of its field at the vessels."""
    x, z = columns["magnet_x_mm"][row], columns["magnet_z_mm"][row]
    heading = np.radians(columns["heading_deg"][row])
    arrow = axes.quiver(
        z,
        x,
        np.cos(heading),
        np.sin(heading),
        color=MAGNET,
        alpha=alpha,
        zorder=5,
        scale=25,
        width=0.004,
        pivot="mid",
    )
    return [arrow]


def draw(columns: dict, shapes: list[np.ndarray], vessel: list[dict], picture: Path) -> None:
    """Shapes along the way above; forces and inserted length below."""
    figure = plt.figure(figsize=(8.5, 6.2))
    grid = figure.add_gridspec(2, 2, height_ratios=(1.15, 1), width_ratios=(1.5, 1))
    above, forces, length = (figure.add_subplot(grid[at]) for at in ((0, slice(None)), (1, 0), (1, 1)))
    draw_vessels(above, vessel)
    for number, row in enumerate(np.linspace(0, len(shapes) - 1, SHOWN).astype(int)):
        alpha = 0.35 + 0.65 * number / (SHOWN - 1)
        z, x = 1e3 * shapes[row][:, 2], 1e3 * shapes[row][:, 0]
        above.plot(z, x, color=DEVICE, alpha=alpha, lw=2, zorder=4)
        draw_magnet(above, columns, row, alpha)
    above.set_title("From above: the device at times, and the magnet beneath (arrow: its field)")
    time = columns["time"]
    strength = {
        name: 1e3 * np.linalg.norm([columns[f"{name}[{k}]"] for k in (1, 2, 3)], axis=0)
        for name in ("magnet.reaction_force", "contact.force")
    }
    largest = 1e3 * columns["contact.largest_force"]
    forces.plot(time, strength["magnet.reaction_force"], color=MAGNET)
    forces.plot(time, strength["contact.force"], color=look.WALL, ls=(0, (4, 2)))
    forces.plot(time, largest, color=look.INK)
    look.level(forces, PAPER, "largest axial force in the paper", x=0.22, above=False)
    forces.set(xlabel="time (s)", ylabel="force (mN), predicted", ylim=(0, None))
    forces.set_title("The wall bears what the magnet pulls")
    look.label(forces, time[0], max(strength["magnet.reaction_force"]), "magnet; dashed: wall", MAGNET)
    look.label(forces, time[len(time) // 4], min(largest), "largest contact", look.INK, xytext=(0, -10))
    length.plot(time, 1e3 * columns["feed.length"], color=DEVICE)
    length.set(xlabel="time (s)", ylabel="shaft inside (mm)", ylim=(0, None))
    length.set_title("The shaft follows")
    look.title(figure, "A magnet beneath leads the device up the aorta into a branch")
    figure.savefig(picture)
    plt.close(figure)


def animate(columns: dict, shapes: list[np.ndarray], vessel: list[dict], film: Path) -> None:
    """The device on its way, from above."""
    figure, axes = plt.subplots(figsize=(9, 3.8))
    draw_vessels(axes, vessel)
    (line,) = axes.plot([], [], color=DEVICE, lw=2.2, zorder=4)
    drawn: list = []

    def frame(row: int) -> list:
        for artist in drawn:
            artist.remove()
        drawn[:] = draw_magnet(axes, columns, row)
        line.set_data(1e3 * shapes[row][:, 2], 1e3 * shapes[row][:, 0])
        axes.set_title(
            f"{columns['time'][row]:.0f} s, {1e3 * columns['feed.length'][row]:.0f} mm of shaft inside"
        )
        return [line, *drawn]

    rows = np.unique(np.linspace(0, len(shapes) - 1, FRAMES).astype(int))
    FuncAnimation(figure, frame, frames=rows).save(film, writer=PillowWriter(fps=12), dpi=80)
    plt.close(figure)
