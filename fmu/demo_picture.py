"""Draws the table of the demonstration: shapes with rings and magnet to scale, and what happens over time."""

import sys
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.patches import Polygon

mpl.use("Agg")
import matplotlib.pyplot as plt

RING = (4.0, 1.0)  # diameter and length of a ring, mm
MAGNET = (45.0, 30.0)  # diameter and length of one of the pair's cylinders, mm
OFFSET = 20.0  # their centres from the pair's centre, mm
CORE = 1.9  # diameter of the core, mm
INK, GRID = "#22252a", "#d9dce1"
NORTH, SOUTH = "#c8553d", "#4f7cac"


def box(y: float, z: float, axis: tuple[float, float], diameter: float, length: float) -> np.ndarray:
    """Corners (z, y) of a cylinder seen from the side; `axis` is (y, z)."""
    along = np.array([axis[1], axis[0]]) / np.hypot(*axis)
    across = np.array([-along[1], along[0]])
    signs = ((-1, -1), (-1, 1), (1, 1), (1, -1))
    return np.array([[z, y] + a * length / 2 * along + b * diameter / 2 * across for a, b in signs])


def draw_manipulator(axes, row, colour, alpha=1.0) -> None:
    """Core as a ribbon of its own width, rings as boxes."""
    points = sum(name.startswith("shape_") and name.endswith("_y_mm") for name in row.dtype.names)
    y = np.array([row[f"shape_{i}_y_mm"] for i in range(1, points + 1)])
    z = np.array([row[f"shape_{i}_z_mm"] for i in range(1, points + 1)])
    across = np.array([-np.gradient(y), np.gradient(z)])
    across *= CORE / 2 / np.hypot(*across)
    left, right = np.array([z, y]) + across, np.array([z, y]) - across
    ribbon = np.concatenate([left.T, right.T[::-1]])
    axes.add_patch(Polygon(ribbon, facecolor=colour, alpha=0.35 * alpha, lw=0, zorder=20))
    rings = sum(name.startswith("ring_") and name.endswith("_axis_y") for name in row.dtype.names)
    for k in range(1, rings + 1):
        axis = (row[f"ring_{k}_axis_y"], row[f"ring_{k}_axis_z"])
        corners = box(row[f"ring_{k}_y_mm"], row[f"ring_{k}_z_mm"], axis, *RING)
        axes.add_patch(Polygon(corners, facecolor=colour, edgecolor="none", alpha=alpha, zorder=21))


def draw_magnet(axes, row, colour, label, floor) -> None:
    """The pair, each cylinder half north, half south; it hides what has a lower `floor`."""
    turn = np.pi + np.radians(row["magnet_turn_deg"])
    axis = (-np.sin(turn), np.cos(turn))  # (y, z) of the third axis, turned about x
    y, z = row["magnet_y_mm"], row["magnet_z_mm"]
    for offset in (-OFFSET, OFFSET):
        for half, pole in ((-1, SOUTH), (1, NORTH)):
            shift = offset + half * MAGNET[1] / 4
            corners = box(y + shift * axis[0], z + shift * axis[1], axis, MAGNET[0], MAGNET[1] / 2)
            axes.add_patch(Polygon(corners, facecolor=pole, alpha=0.16, lw=0, zorder=floor + 0.1))
            name = "N" if half > 0 else "S"
            at = (z + shift * axis[1], y + shift * axis[0])
            axes.text(*at, name, color=pole, ha="center", va="center", fontsize=8, zorder=floor + 0.2)
        corners = box(y + offset * axis[0], z + offset * axis[1], axis, *MAGNET)
        axes.add_patch(Polygon(corners, facecolor="white", edgecolor=colour, lw=1.6, zorder=floor))
    # Under the left end of a magnet that lies along the manipulator, above the middle of one that is turned.
    if row["magnet_turn_deg"] > 1:
        axes.text(z - 9, y + 44, label, color=colour, ha="center", va="bottom", fontweight="bold", zorder=22)
    else:
        axes.text(z - 35, y - 25, label, color=colour, ha="left", va="top", fontweight="bold", zorder=22)


def draw_clamp(axes, size: float) -> None:
    """The wall that holds the base, `size` mm high."""
    axes.plot([0, 0], [-size / 2, size / 2], color=INK, lw=1.6, zorder=22)
    for y in np.linspace(-size / 2, size / 2, 6):
        axes.plot([0, -size / 6], [y, y - size / 6], color=INK, lw=0.8, zorder=22)


def tidy(axes) -> None:
    """Light frame and grid."""
    axes.spines[["top", "right"]].set_visible(False)
    axes.grid(color=GRID, lw=0.6)
    axes.set_axisbelow(True)


def draw_scene(axes, rows, instants, colours) -> None:
    """The whole scene to scale."""
    for floor, (index, colour) in enumerate(zip(instants, colours, strict=True), start=1):
        row = rows[index]
        draw_manipulator(axes, row, colour)
        draw_magnet(axes, row, colour, f"{row['time_s']:.0f} s", floor)
    draw_clamp(axes, 14)
    axes.text(-4, 9, "clamped base", ha="right", va="bottom", fontsize=8)
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.margins(0.02)
    axes.set(xlabel="z (mm), along the straight manipulator", ylabel="y (mm)", ylim=(-195, None))
    axes.set_title("Magnet pair and manipulator, to scale", loc="left")
    tidy(axes)


def draw_shapes(axes, rows, instants, colours) -> None:
    """The manipulator alone, larger."""
    for index, colour in zip(instants, colours, strict=True):
        draw_manipulator(axes, rows[index], colour)
        axes.plot([], [], color=colour, lw=5, label=f"{rows['time_s'][index]:.0f} s")
    axes.set_aspect("equal")
    axes.autoscale_view()
    draw_clamp(axes, 8)
    axes.set(xlabel="z (mm)", ylabel="y (mm)")
    axes.set_title("Shapes: rings, and cores between them", loc="left")
    axes.legend(frameon=False, fontsize=8, loc="best", handlelength=1.2)
    tidy(axes)


def draw_histories(panels, rows, instants, colours) -> None:
    """Tip angle, forces and stability margin against time."""
    time = rows["time_s"]
    angle, force, margin = panels
    angle.plot(time, rows["tip_angle_deg"], color=INK, label="tip")
    angle.plot(time, rows["largest_core_angle_deg"], color=SOUTH, label="most bent core")
    boundary = rows["boundary_angle_deg"][0]
    angle.axhline(boundary, color=NORTH, lw=1, ls="--")
    angle.text(10, boundary, "windings touch", color=NORTH, ha="center", va="bottom", fontsize=8)
    angle.set_ylabel("angle (deg)")
    angle.legend(frameon=False, ncols=2, fontsize=8, loc="upper right")
    for axis, colour in (("y", NORTH), ("z", SOUTH)):
        force.plot(time, rows[f"magnetic_force_{axis}_mn"], color=colour, label=f"$F_{axis}$")
    force.set_ylabel("magnetic\nforce (mN)")
    force.legend(frameon=False, ncols=2, fontsize=8, loc="best")
    margin.plot(time, rows["stability_margin"], color=INK)
    margin.axhline(0, color=NORTH, lw=1, ls="--")
    margin.text(time[-1], 0, "fold ", color=NORTH, ha="right", va="bottom", fontsize=8)
    margin.set(ylabel="stability\nmargin (1)", xlabel="time (s)")
    for axes in panels:
        for index, colour in zip(instants, colours, strict=True):
            axes.axvline(time[index], color=colour, lw=1.4, alpha=0.8, zorder=0)
        axes.set_xlim(time[0], time[-1])
        tidy(axes)
    for axes in panels[:-1]:
        axes.tick_params(labelbottom=False)


def draw(table: Path, picture: Path) -> None:
    """Reads the table and writes the picture."""
    rows = np.genfromtxt(table, delimiter=",", names=True)
    stop = rows["time_s"][-1]
    instants = [
        int(np.argmin(abs(rows["time_s"] - share * stop))) for share in (0, 1 / 6, 1 / 4, 1 / 3, 1 / 2, 1)
    ]
    colours = plt.get_cmap("plasma")(np.linspace(0.0, 0.85, len(instants)))
    plt.rcParams.update(
        {"font.size": 9, "axes.edgecolor": INK, "text.color": INK, "axes.titleweight": "bold"}
    )
    figure = plt.figure(figsize=(10.5, 9.5), layout="constrained")
    grid = figure.add_gridspec(4, 2, height_ratios=(3.6, 1, 1, 1), width_ratios=(1, 1.15))
    draw_scene(figure.add_subplot(grid[0, :]), rows, instants, colours)
    draw_shapes(figure.add_subplot(grid[1:, 0]), rows, instants, colours)
    draw_histories([figure.add_subplot(grid[i, 1]) for i in (1, 2, 3)], rows, instants, colours)
    figure.savefig(picture, dpi=160)
    plt.close(figure)


if __name__ == "__main__":
    draw(Path(sys.argv[1]), Path(sys.argv[2]))
