"""Draws the table of the demonstration as an animation that loops: magnet and manipulator to scale, tip angle, margin.

    .venv/bin/python fmu/demo_animation.py mcm_demo.csv mcm_demo.gif

What stays is drawn once; the rest of each frame is drawn upon it, so that a frame takes hundredths of a second.
"""

import sys
from pathlib import Path

import demo_picture
import look
import matplotlib.pyplot as plt
import numpy as np
from demo_picture import WARNING
from matplotlib.patches import FancyArrow, Polygon, Rectangle
from PIL import Image

WIDTH, HEIGHT = 940, 588  # pixels
STRIDE = 4  # rows of the table from frame to frame
PAUSE = 70  # ms from frame to frame
COLOURS = 64
NEARLY_WHITE = 240  # of 255
TRAIL = 3.0  # s for which the way of the tip is seen
SCENE = (-197, 243, -184, 58)  # limits of z and y, mm
LARGER = (-16, 52, -56, 44)  # the same of the view that is larger
FIELD = 2.0  # mm an mT that the arrow of the field is long


def axes_at(figure, left: float, bottom: float, width: float, height: float):
    """Axes at a place in pixels from the lower left corner."""
    return figure.add_axes((left / WIDTH, bottom / HEIGHT, width / WIDTH, height / HEIGHT))


def bare(axes, limits: tuple[float, float, float, float]) -> None:
    """To scale, without frame, ticks or grid."""
    axes.set(xlim=limits[:2], ylim=limits[2:], aspect="equal", xticks=[], yticks=[])
    axes.grid(visible=False)
    axes.spines[:].set_visible(False)


class Film:
    """The figure: what stays, and what a frame adds."""

    def __init__(self, rows: np.ndarray) -> None:
        self.rows, self.time = rows, rows["time_s"]
        self.figure = plt.figure(figsize=(WIDTH / 100, HEIGHT / 100), dpi=100, layout="none")
        self.larger = axes_at(self.figure, 12, 14, 359, 528)
        self.scene = axes_at(self.figure, 388, 253, 541, 297)
        self.angle = axes_at(self.figure, 450, 154, 425, 70)
        self.margin = axes_at(self.figure, 450, 46, 425, 70)
        self.tip = demo_picture.count(rows, "ring_")
        self.curves = {
            self.angle: ("tip angle", demo_picture.signed_angle(rows), "{:+.0f}°"),
            self.margin: ("stability margin", rows["stability_margin"], "{:.2f}"),
        }
        self.lay()
        self.figure.canvas.draw()
        self.still = self.figure.canvas.copy_from_bbox(self.figure.bbox)

    def lay(self) -> None:
        """What stays."""
        self.figure.text(
            0.018, 0.985, demo_picture.finding(self.rows), va="top", fontsize=14, fontweight="bold"
        )
        away = -self.rows["magnet_y_mm"][0]
        bare(self.scene, SCENE)
        demo_picture.clamp(self.scene, 14)
        self.scene.plot([0, 238], [0, 0], color=look.LIGHT, lw=1, zorder=0)
        arrow = {"arrowstyle": "<->", "color": look.GREY, "lw": 1}
        self.scene.annotate("", (235, 0), (235, -away), arrowprops=arrow)
        where = {"facecolor": "none", "edgecolor": look.LIGHT, "lw": 1.5, "zorder": 0}
        z, y = np.reshape(LARGER, (2, 2))
        self.scene.add_patch(Rectangle((z[0], y[0]), np.ptp(z), np.ptp(y), **where))
        self.scene.text(z[1] + 4, 30, "catheter", va="center")
        self.scene.text(232, -70, f"{away:.0f} mm", color=look.GREY, ha="right", va="center")
        bare(self.larger, LARGER)
        self.larger.add_patch(
            Rectangle(
                (0, 0), 1, 1, transform=self.larger.transAxes, facecolor="white", edgecolor=look.LIGHT, lw=1.5
            )
        )
        demo_picture.clamp(self.larger, 10)
        sizes = (axes.get_position().width / np.ptp(axes.get_xlim()) for axes in (self.larger, self.scene))
        ratio = np.divide(*sizes)
        words = f"catheter, {ratio:.0f} times as large as on the right"
        self.larger.text(0.04, 0.965, words, transform=self.larger.transAxes, va="top")
        self.larger.plot([38, 48], [-53, -53], color=look.INK, lw=2, solid_capstyle="butt")
        self.larger.text(43, -52, "10 mm", ha="center", va="bottom", fontsize=9)
        for axes, (name, values, _) in self.curves.items():
            axes.set_title(name, fontsize=11)
            axes.plot(self.time, values, color=look.LIGHT, lw=2)
            axes.set_xlim(self.time[0], self.time[-1])
            axes.grid(axis="x", visible=False)
        self.angle.set_yticks([-90, 0, 90])
        self.angle.yaxis.set_major_formatter("{x:.0f}°")
        self.margin.axhline(0, color=WARNING, lw=1, ls="--")
        look.label(self.margin, self.time[-1], 0, "fold", WARNING)
        self.margin.set(ylim=(-0.05, None), xlabel="time (s)")
        self.angle.tick_params(labelbottom=False)

    def draw(self, axes, artist) -> None:
        """Draws an artist upon what stays, for this frame only."""
        axes.add_artist(artist)
        axes.draw_artist(artist)
        artist.remove()

    def write(self, axes, x: float, y: float, text: str, colour: str, **how) -> None:
        """Writes for this frame only."""
        written = axes.text(x, y, text, color=colour, **how)
        axes.draw_artist(written)
        written.remove()

    def draw_magnet(self, row: np.ndarray) -> None:
        """Both cylinders with their poles."""
        for pole, (z, y), corners in demo_picture.halves(row):
            tint = look.NORTH if pole == "N" else look.SOUTH
            self.draw(self.scene, Polygon(corners, facecolor=tint, edgecolor="white", lw=1.5))
            self.write(
                self.scene, z, y, pole, "white", ha="center", va="center", fontsize=10, fontweight="bold"
            )

    def draw_device(self, index: int) -> None:
        """The manipulator in both views; in the larger one the way of its tip and the field there."""
        row = self.rows[index]
        for axes in (self.scene, self.larger):
            if axes is self.larger:
                first = np.searchsorted(self.time, self.time[index] - TRAIL)
                z, y = (self.rows[f"ring_{self.tip}_{axis}_mm"][first : index + 1] for axis in "zy")
                self.draw(axes, plt.Line2D(z, y, color=look.BLUE, alpha=0.35, lw=2))
            for patch in demo_picture.manipulator(row, look.INK, core=0.45):
                self.draw(axes, patch)
        z, y = (row[f"ring_{self.tip}_{axis}_mm"] for axis in "zy")
        field = np.array([row[f"tip_field_{axis}_mt"] for axis in "zy"])
        size = {"width": 0.6, "head_width": 2.6, "length_includes_head": True}
        arrow = FancyArrow(z, y, *(FIELD * field), **size, color=look.GREEN, zorder=30)
        self.draw(self.larger, arrow)
        words = f"field at the tip {np.hypot(*field):.1f} mT"
        self.write(self.larger, 0.04, 0.925, words, look.GREEN, transform=self.larger.transAxes, va="top")

    def draw_curves(self, index: int) -> None:
        """What the curves have been so far, and their values now."""
        for axes, (_, values, form) in self.curves.items():
            self.draw(axes, plt.Line2D(self.time[: index + 1], values[: index + 1], color=look.BLUE, lw=2))
            self.draw(
                axes, plt.Line2D([self.time[index]], [values[index]], marker="o", ms=8, color=look.BLUE)
            )
            now = form.format(values[index]).replace("-", "\N{MINUS SIGN}")
            where = {"transform": axes.transAxes, "ha": "right", "va": "bottom", "fontsize": 12}
            self.write(axes, 1.0, 1.06, now, look.BLUE, fontweight="bold", **where)

    def frame(self, index: int) -> Image.Image:
        """The picture at a row of the table."""
        canvas = self.figure.canvas
        canvas.restore_region(self.still)
        self.draw_magnet(self.rows[index])
        self.draw_device(index)
        self.draw_curves(index)
        return Image.fromarray(np.asarray(canvas.buffer_rgba())[..., :3].copy())


def draw(table: Path, picture: Path) -> None:
    """Reads the table and writes the animation; the row at the end is the first frame again."""
    rows = demo_picture.read(table)
    film = Film(rows)
    frames = [film.frame(index) for index in range(0, len(rows) - 1, STRIDE)]
    plt.close(film.figure)
    # The colours of one frame of the middle, where all are seen, so that what stays has the same ones in each.
    palette = frames[len(frames) // 2].quantize(COLOURS, dither=Image.Dither.NONE)
    palette.putpalette([255 if value > NEARLY_WHITE else value for value in palette.getpalette()])
    frames = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    frames[0].save(picture, save_all=True, append_images=frames[1:], duration=PAUSE, loop=0, optimize=False)


if __name__ == "__main__":
    draw(Path(sys.argv[1]), Path(sys.argv[2]))
