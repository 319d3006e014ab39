"""Draws the way of a device through an aorta: from above with the vessels, and the forces over time."""

from pathlib import Path

import matplotlib as mpl
import numpy as np

mpl.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.animation import FuncAnimation, PillowWriter
from matplotlib.collections import PatchCollection

INK, WALL, LUMEN, DEVICE, MAGNET = "#22252a", "#d7a09a", "#f7e6e3", "#4f7cac", "#c8553d"
SHOWN = 8  # shapes in the picture
FRAMES = 80
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
    for grown, colour, order in ((1.0, WALL, 1), (0.0, LUMEN, 2)):
        circles = [
            plt.Circle((centre[2], centre[0]), radius + grown)
            for branch in vessel
            for centre, radius in zip(*balls(branch), strict=True)
        ]
        axes.add_collection(PatchCollection(circles, color=colour, lw=0, zorder=order))
    axes.set(xlabel="z, along the port (mm)", ylabel="x (mm)", aspect="equal")
    axes.autoscale_view()


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
    figure, (above, forces) = plt.subplots(
        2, 1, figsize=(11, 7.4), layout="constrained", height_ratios=[1.3, 1]
    )
    draw_vessels(above, vessel)
    for number, row in enumerate(np.linspace(0, len(shapes) - 1, SHOWN).astype(int)):
        alpha = 0.35 + 0.65 * number / (SHOWN - 1)
        above.plot(
            1e3 * shapes[row][:, 2], 1e3 * shapes[row][:, 0], color=DEVICE, alpha=alpha, lw=2, zorder=4
        )
        draw_magnet(above, columns, row, alpha)
    above.set_title("Shapes from above; arrows: the magnet beneath, and its field at the vessels")
    norm = lambda name: 1e3 * np.linalg.norm([columns[f"{name}[{k}]"] for k in (1, 2, 3)], axis=0)  # noqa: E731
    time = columns["time"]
    forces.plot(time, norm("magnet.reaction_force"), color=MAGNET, label="magnet and device")
    forces.plot(time, norm("contact.force"), color=WALL, label="wall on the device")
    forces.plot(time, 1e3 * columns["contact.largest_force"], color=INK, label="largest contact")
    forces.axhline(90, color=INK, lw=0.8, ls=":", label="largest axial force of the paper")
    forces.set(xlabel="time (s)", ylabel="force (mN), predicted", ylim=(0, None))
    length = forces.twinx()
    length.plot(time, 1e3 * columns["feed.length"], color=DEVICE, ls="--", label="shaft inside (right)")
    length.set(ylabel="shaft inside (mm)", ylim=(0, None))
    lines = [*forces.get_lines(), *length.get_lines()]
    names = [line.get_label() for line in lines]
    forces.legend(lines, names, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=5, frameon=False)
    figure.savefig(picture, dpi=130)
    plt.close(figure)


def animate(columns: dict, shapes: list[np.ndarray], vessel: list[dict], film: Path) -> None:
    """The device on its way, from above."""
    figure, axes = plt.subplots(figsize=(9, 3.8), layout="constrained")
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
