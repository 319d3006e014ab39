"""Draws the table of the demonstration: shapes with rings and magnet to scale, and what happens over time."""

import sys
from pathlib import Path

import look
import matplotlib.pyplot as plt
import numpy as np
from demo_parts import STOP, Parts
from matplotlib.patches import Polygon

SHOWN = (0, 4, 6, 8, 12, 24)  # s
FORCE = {"y": look.NORTH, "z": look.SOUTH}
WARNING = look.VERMILION


def read(table: Path) -> np.ndarray:
    """The rows of the table by the names of its columns."""
    return np.atleast_1d(np.genfromtxt(table, delimiter=",", names=True))


def signed_angle(rows: np.ndarray) -> np.ndarray:
    """Tip angle, deg, negative where the tip points to the magnet's side."""
    last = count(rows, "shape_")
    return np.copysign(rows["tip_angle_deg"], rows[f"shape_{last}_y_mm"] - rows[f"shape_{last - 1}_y_mm"])


def count(rows: np.ndarray, name: str) -> int:
    """Number of rings or points of the centreline in the table."""
    return sum(column.startswith(name) and column.endswith("_y_mm") for column in rows.dtype.names)


def box(y: float, z: float, axis: tuple[float, float], diameter: float, length: float) -> np.ndarray:
    """Corners (z, y) of a cylinder seen from the side; `axis` is (y, z)."""
    along = np.array([axis[1], axis[0]]) / np.hypot(*axis)
    across = np.array([-along[1], along[0]])
    signs = ((-1, -1), (-1, 1), (1, 1), (1, -1))
    return np.array([[z, y] + a * length / 2 * along + b * diameter / 2 * across for a, b in signs])


def centreline(row: np.ndarray) -> np.ndarray:
    """z and y of the points of the centreline, mm."""
    points = range(1, count(row, "shape_") + 1)
    return np.array([[row[f"shape_{i}_{axis}_mm"] for i in points] for axis in "zy"])


def manipulator(row: np.ndarray, parts: Parts, colour: str, core: float = 0.35) -> list[Polygon]:
    """Core as a ribbon of its own width, so opaque, and rings as boxes."""
    z, y = centreline(row)
    across = np.array([-np.gradient(y), np.gradient(z)])
    across *= parts.core_diameter / 2 / np.hypot(*across)
    left, right = np.array([z, y]) + across, np.array([z, y]) - across
    drawn = [Polygon(np.concatenate([left.T, right.T[::-1]]), facecolor=colour, alpha=core, lw=0, zorder=20)]
    for k in range(1, count(row, "ring_") + 1):
        axis = (row[f"ring_{k}_axis_y"], row[f"ring_{k}_axis_z"])
        size = parts.ring_diameter, parts.ring_length
        corners = box(row[f"ring_{k}_y_mm"], row[f"ring_{k}_z_mm"], axis, *size)
        drawn.append(Polygon(corners, facecolor=colour, lw=0, zorder=21))
    return drawn


def halves(row: np.ndarray, parts: Parts) -> list[tuple[str, np.ndarray, np.ndarray]]:
    """Pole, middle (z, y) and corners of each half of every cylinder of the magnet."""
    turn = np.pi + np.radians(row["magnet_turn_deg"])
    axis = np.array([-np.sin(turn), np.cos(turn)])  # (y, z) of the third axis, turned about x
    found = []
    for cylinder in parts.cylinders:
        for half in (-1, 1):
            shift = (cylinder.offset + half * cylinder.length / 4) * axis
            y, z = row["magnet_y_mm"] + shift[0], row["magnet_z_mm"] + shift[1]
            pole = "N" if half == cylinder.north else "S"
            corners = box(y, z, axis, cylinder.diameter, cylinder.length / 2)
            found.append((pole, np.array([z, y]), corners))
    return found


def clamp(axes, size: float) -> None:
    """The wall that holds the base, `size` mm high."""
    axes.plot([0, 0], [-size / 2, size / 2], color=look.INK, lw=1.6, zorder=22)
    for y in np.linspace(-size / 2, size / 2, 6):
        axes.plot([0, -size / 6], [y, y - size / 6], color=look.INK, lw=0.8, zorder=22)


def capital(words: str) -> str:
    """The words with a capital at the beginning."""
    return words[:1].upper() + words[1:]


def draw_scene(axes, rows, parts, instants, colours) -> None:
    """The whole scene to scale; a later magnet hides an earlier one."""
    for floor, (index, colour) in enumerate(zip(instants, colours, strict=True), start=1):
        row = rows[index]
        for patch in manipulator(row, parts, colour):
            axes.add_patch(patch)
        corners = []
        for pole, (z, y), half in halves(row, parts):
            tint = look.NORTH if pole == "N" else look.SOUTH
            axes.add_patch(Polygon(half, facecolor="white", lw=0, zorder=floor))
            axes.add_patch(Polygon(half, facecolor=tint, alpha=0.25, edgecolor=tint, zorder=floor + 0.1))
            axes.text(z, y, pole, color=tint, ha="center", va="center", fontsize=8, zorder=floor + 0.2)
            corners.extend(half)
        if not corners:
            continue
        lowest, highest = np.array(corners)[:, 1].min(), np.array(corners)[:, 1].max()
        if row["magnet_turn_deg"] > 1:
            place, how, below = (row["magnet_z_mm"], highest), {"va": "bottom", "ha": "center"}, 2
        else:
            place, how, below = (np.array(corners)[:, 0].min(), lowest), {"va": "top", "ha": "left"}, -2
        axes.annotate(
            f"{row['time_s']:.0f} s",
            place,
            (0, below),
            textcoords="offset points",
            color=colour,
            fontweight="bold",
            **how,
        )
    low, high = extent(rows, parts, instants)
    size = 0.06 * (high - low)[1]
    clamp(axes, size)
    axes.text(-size / 2, size / 2, "clamped base", ha="right", fontsize=9)
    axes.set_aspect("equal")
    room = 0.05 * (high - low)
    axes.set(xlim=(low[0] - room[0], high[0] + room[0]), ylim=(low[1] - 2 * room[1], high[1] + room[1]))
    axes.set(xlabel="z (mm), along the straight manipulator", ylabel="y (mm)")
    axes.set_title(
        f"{capital(parts.magnet)} and manipulator, to scale" if parts.magnet else "Manipulator, to scale"
    )


def extent(rows, parts, instants) -> tuple[np.ndarray, np.ndarray]:
    """Least and largest z and y of all that is drawn, mm."""
    places = [np.zeros((1, 2))]
    for row in rows[instants]:
        line = centreline(row).T
        places.extend((line - parts.width / 2, line + parts.width / 2))
        places.extend(corners for _, _, corners in halves(row, parts))
    return np.concatenate(places).min(axis=0), np.concatenate(places).max(axis=0)


def draw_shapes(axes, rows, parts, instants, colours) -> None:
    """The manipulator alone, larger."""
    for index, colour in zip(instants, colours, strict=True):
        row = rows[index]
        for patch in manipulator(row, parts, colour):
            axes.add_patch(patch)
        line = centreline(row)
        length = np.hypot(*np.diff(line)).sum()
        end = line[:, -1] - line[:, -2]
        z, y = line[:, -1] + 0.06 * length * end / np.hypot(*end)
        axes.text(z, y, f"{row['time_s']:.0f}", color=colour, ha="center", va="center", fontsize=9)
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.margins(0.08)
    clamp(axes, 2 * parts.width)
    axes.set(xlabel="z (mm)", ylabel="y (mm)")
    axes.set_title("Shapes by time (s)")


def draw_histories(panels, rows, parts, instants, colours) -> None:
    """Tip angle, forces and stability margin against time."""
    time, end = rows["time_s"], rows["time_s"][-1]
    angle, force, margin = panels
    angle.plot(time, rows["tip_angle_deg"], color=look.INK)
    angle.plot(time, rows["largest_core_angle_deg"], color=look.BLUE)
    if np.isfinite(parts.boundary):
        angle.axhline(parts.boundary, color=WARNING, lw=1, ls="--")
        look.label(angle, end, parts.boundary, "windings touch", WARNING)
    look.label(angle, end, rows["tip_angle_deg"][-1], "tip", look.INK)
    look.label(angle, end, rows["largest_core_angle_deg"][-1], "most bent core", look.BLUE, xytext=(4, -7))
    angle.set_ylabel("angle (°)")
    for axis, colour in FORCE.items():
        values = rows[f"magnetic_force_{axis}_mn"]
        force.plot(time, values, color=colour)
        look.label(force, end, values[-1], f"$F_{axis}$", colour, xytext=(4, 4 if axis == "y" else -4))
    force.set_ylabel("force (mN)")
    margin.plot(time, rows["stability_margin"], color=look.INK)
    margin.axhline(0, color=WARNING, lw=1, ls="--")
    look.label(margin, end, 0, "fold", WARNING)
    margin.set(ylabel="margin", xlabel="time (s)")
    for axes, words in zip(
        panels, (touching(rows, parts), "Magnetic force on the device", stability(rows)), strict=True
    ):
        for index, colour in zip(instants, colours, strict=True):
            axes.axvline(time[index], color=colour, lw=1.4, alpha=0.8, zorder=0)
        axes.set_xlim(time[0], max(end, time[0] + 1e-3))
        axes.set_title(words)
        axes.grid(axis="x", visible=False)
    for axes in panels[:-1]:
        axes.tick_params(labelbottom=False)


def touching(rows: np.ndarray, parts: Parts) -> str:
    """Whether windings touch, in words."""
    if not np.isfinite(parts.boundary):
        return "Bending"
    touch = np.count_nonzero(rows["largest_core_angle_deg"] >= parts.boundary)
    return f"Windings touch in {touch} of {len(rows)} rows" if touch else "No windings touch"


def stability(rows: np.ndarray) -> str:
    """Whether the shape stays, in words."""
    last = rows["time_s"][-1]
    if last < STOP:
        return f"No shape is found after {last:.2f} s"
    snaps, unstable = int(rows["snaps"][-1]), np.count_nonzero(rows["stability_margin"] <= 0)
    if snaps:
        return f"The shape snaps {'once' if snaps == 1 else f'{snaps} times'}"
    return f"Not stable in {unstable} of {len(rows)} rows" if unstable else "The shape stays stable"


def finding(rows: np.ndarray, parts: Parts) -> str:
    """What the pass shows, in a line."""
    angle = max(rows["tip_angle_deg"])
    if not parts.magnet:
        return f"Without a magnet, a {parts.device} is bent by {angle:.0f}°"
    return f"A {parts.magnet} that passes at {-rows['magnet_y_mm'][0]:.0f} mm bends a {parts.device} to {angle:.0f}°"


def draw(table: Path, picture: Path) -> None:
    """Reads the table and writes the picture."""
    rows = read(table)
    parts = Parts.read(rows)
    shown = [time for time in SHOWN if time <= rows["time_s"][-1]]
    instants = [int(np.argmin(abs(rows["time_s"] - time))) for time in shown]
    colours = plt.get_cmap("plasma")(np.linspace(0.0, 0.85, len(instants)))
    figure = plt.figure(figsize=(8.5, 9.0))
    grid = figure.add_gridspec(4, 2, height_ratios=(3.9, 1, 1, 1), width_ratios=(1, 1.25))
    draw_scene(figure.add_subplot(grid[0, :]), rows, parts, instants, colours)
    draw_shapes(figure.add_subplot(grid[1:, 0]), rows, parts, instants, colours)
    draw_histories([figure.add_subplot(grid[i, 1]) for i in (1, 2, 3)], rows, parts, instants, colours)
    look.title(figure, finding(rows, parts))
    figure.savefig(picture)
    plt.close(figure)


if __name__ == "__main__":
    draw(Path(sys.argv[1]), Path(sys.argv[2]))
