"""Draws the table of the demonstration: shapes with rings and magnet to scale, and what happens over time."""

import sys
from pathlib import Path

import look
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Polygon

RING = (4.0, 1.0)  # diameter and length of a ring, mm
MAGNET = (45.0, 30.0)  # diameter and length of one of the pair's cylinders, mm
OFFSET = 20.0  # their centres from the pair's centre, mm
CORE = 1.9  # diameter of the core, mm
SHOWN = (0, 4, 6, 8, 12, 24)  # s
FORCE = {"y": look.NORTH, "z": look.SOUTH}
WARNING = look.VERMILION


def read(table: Path) -> np.ndarray:
    """The rows of the table by the names of its columns."""
    return np.genfromtxt(table, delimiter=",", names=True)


def signed_angle(rows: np.ndarray) -> np.ndarray:
    """Tip angle, deg, negative where the tip points to the magnet's side."""
    last = count(rows, "ring_")
    return np.copysign(rows["tip_angle_deg"], rows[f"ring_{last}_axis_y"])


def count(rows: np.ndarray, name: str) -> int:
    """Number of rings or points of the centreline in the table."""
    return sum(column.startswith(name) and column.endswith("_y_mm") for column in rows.dtype.names)


def box(y: float, z: float, axis: tuple[float, float], diameter: float, length: float) -> np.ndarray:
    """Corners (z, y) of a cylinder seen from the side; `axis` is (y, z)."""
    along = np.array([axis[1], axis[0]]) / np.hypot(*axis)
    across = np.array([-along[1], along[0]])
    signs = ((-1, -1), (-1, 1), (1, 1), (1, -1))
    return np.array([[z, y] + a * length / 2 * along + b * diameter / 2 * across for a, b in signs])


def manipulator(row: np.ndarray, colour: str, core: float = 0.35) -> list[Polygon]:
    """Core as a ribbon of its own width, so opaque, and rings as boxes."""
    points = count(row, "shape_")
    z, y = np.array([[row[f"shape_{i}_{axis}_mm"] for i in range(1, points + 1)] for axis in "zy"])
    across = np.array([-np.gradient(y), np.gradient(z)])
    across *= CORE / 2 / np.hypot(*across)
    left, right = np.array([z, y]) + across, np.array([z, y]) - across
    drawn = [Polygon(np.concatenate([left.T, right.T[::-1]]), facecolor=colour, alpha=core, lw=0, zorder=20)]
    for k in range(1, count(row, "ring_") + 1):
        axis = (row[f"ring_{k}_axis_y"], row[f"ring_{k}_axis_z"])
        corners = box(row[f"ring_{k}_y_mm"], row[f"ring_{k}_z_mm"], axis, *RING)
        drawn.append(Polygon(corners, facecolor=colour, lw=0, zorder=21))
    return drawn


def halves(row: np.ndarray) -> list[tuple[str, np.ndarray, np.ndarray]]:
    """Pole, middle (z, y) and corners of each half of both cylinders of the pair."""
    turn = np.pi + np.radians(row["magnet_turn_deg"])
    axis = np.array([-np.sin(turn), np.cos(turn)])  # (y, z) of the third axis, turned about x
    found = []
    for offset in (-OFFSET, OFFSET):
        for half, pole in ((-1, "S"), (1, "N")):
            shift = (offset + half * MAGNET[1] / 4) * axis
            y, z = row["magnet_y_mm"] + shift[0], row["magnet_z_mm"] + shift[1]
            found.append((pole, np.array([z, y]), box(y, z, axis, MAGNET[0], MAGNET[1] / 2)))
    return found


def clamp(axes, size: float) -> None:
    """The wall that holds the base, `size` mm high."""
    axes.plot([0, 0], [-size / 2, size / 2], color=look.INK, lw=1.6, zorder=22)
    for y in np.linspace(-size / 2, size / 2, 6):
        axes.plot([0, -size / 6], [y, y - size / 6], color=look.INK, lw=0.8, zorder=22)


def draw_scene(axes, rows, instants, colours) -> None:
    """The whole scene to scale; a later magnet hides an earlier one."""
    for floor, (index, colour) in enumerate(zip(instants, colours, strict=True), start=1):
        row = rows[index]
        for patch in manipulator(row, colour):
            axes.add_patch(patch)
        corners = []
        for pole, (z, y), half in halves(row):
            tint = look.NORTH if pole == "N" else look.SOUTH
            axes.add_patch(Polygon(half, facecolor="white", lw=0, zorder=floor))
            axes.add_patch(Polygon(half, facecolor=tint, alpha=0.25, edgecolor=tint, zorder=floor + 0.1))
            axes.text(z, y, pole, color=tint, ha="center", va="center", fontsize=8, zorder=floor + 0.2)
            corners.extend(half)
        lowest = np.array(corners)[:, 1].min()
        if row["magnet_turn_deg"] > 1:
            place, how = (row["magnet_z_mm"], lowest), {"va": "top", "ha": "center"}
        else:
            place, how = (np.array(corners)[:, 0].min(), lowest), {"va": "top", "ha": "left"}
        axes.annotate(
            f"{row['time_s']:.0f} s",
            place,
            (0, -2),
            textcoords="offset points",
            color=colour,
            fontweight="bold",
            **how,
        )
    clamp(axes, 14)
    axes.text(-6, 6, "clamped base", ha="right", fontsize=9)
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.margins(0.02)
    axes.set(xlabel="z (mm), along the straight manipulator", ylabel="y (mm)", ylim=(-200, 45))
    axes.set_title("Magnet pair and manipulator, to scale")


def draw_shapes(axes, rows, instants, colours) -> None:
    """The manipulator alone, larger."""
    last = count(rows, "ring_")
    for index, colour in zip(instants, colours, strict=True):
        row = rows[index]
        for patch in manipulator(row, colour):
            axes.add_patch(patch)
        axis = np.array([row[f"ring_{last}_axis_z"], row[f"ring_{last}_axis_y"]])
        z, y = np.array([row[f"ring_{last}_z_mm"], row[f"ring_{last}_y_mm"]]) + 3.2 * axis
        axes.text(z, y, f"{row['time_s']:.0f}", color=colour, ha="center", va="center", fontsize=9)
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.margins(0.08)
    clamp(axes, 8)
    axes.set(xlabel="z (mm)", ylabel="y (mm)")
    axes.set_title("Shapes by time (s)")


def draw_histories(panels, rows, instants, colours) -> None:
    """Tip angle, forces and stability margin against time."""
    time, end = rows["time_s"], rows["time_s"][-1]
    angle, force, margin = panels
    boundary = rows["boundary_angle_deg"][0]
    angle.plot(time, rows["tip_angle_deg"], color=look.INK)
    angle.plot(time, rows["largest_core_angle_deg"], color=look.BLUE)
    angle.axhline(boundary, color=WARNING, lw=1, ls="--")
    look.label(angle, end, boundary, "windings touch", WARNING)
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
        panels, ("No windings touch", "Magnetic force on the device", "The shape stays stable"), strict=True
    ):
        for index, colour in zip(instants, colours, strict=True):
            axes.axvline(time[index], color=colour, lw=1.4, alpha=0.8, zorder=0)
        axes.set_xlim(time[0], end)
        axes.set_title(words)
        axes.grid(axis="x", visible=False)
    for axes in panels[:-1]:
        axes.tick_params(labelbottom=False)


def finding(rows: np.ndarray) -> str:
    """What the pass shows, in a line."""
    segments = count(rows, "ring_") - 1
    return (
        f"A magnet pair that passes at {-rows['magnet_y_mm'][0]:.0f} mm bends a catheter of {segments} segments "
        f"to {max(rows['tip_angle_deg']):.0f}°"
    )


def draw(table: Path, picture: Path) -> None:
    """Reads the table and writes the picture."""
    rows = read(table)
    instants = [int(np.argmin(abs(rows["time_s"] - time))) for time in SHOWN]
    colours = plt.get_cmap("plasma")(np.linspace(0.0, 0.85, len(instants)))
    figure = plt.figure(figsize=(8.5, 9.0))
    grid = figure.add_gridspec(4, 2, height_ratios=(3.9, 1, 1, 1), width_ratios=(1, 1.25))
    draw_scene(figure.add_subplot(grid[0, :]), rows, instants, colours)
    draw_shapes(figure.add_subplot(grid[1:, 0]), rows, instants, colours)
    draw_histories([figure.add_subplot(grid[i, 1]) for i in (1, 2, 3)], rows, instants, colours)
    look.title(figure, finding(rows))
    figure.savefig(picture)
    plt.close(figure)


if __name__ == "__main__":
    draw(Path(sys.argv[1]), Path(sys.argv[2]))
