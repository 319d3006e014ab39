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
from demo_parts import Parts
from demo_picture import WARNING
from matplotlib.patches import FancyArrow, Polygon, Rectangle
from PIL import Image

WIDTH, HEIGHT = 940, 588  # pixels
STRIDE = 4  # rows of the table from frame to frame
PAUSE = 70  # ms from frame to frame
COLOURS = 64
NEARLY_WHITE = 240  # of 255
TRAIL = 3.0  # s for which the way of the tip is seen
ROOM = 0.06  # around all that is seen, in parts of its size
FIELD = 0.2  # the longest arrow of the field, in parts of the larger view's width
LETTER = 9  # least length of a pole for its letter, pixels
LEAST_ANGLE = 5.0  # the tip angles that are shown go to this at least, deg


def axes_at(figure, left: float, bottom: float, width: float, height: float):
    """Axes at a place in pixels from the lower left corner."""
    return figure.add_axes((left / WIDTH, bottom / HEIGHT, width / WIDTH, height / HEIGHT))


def bare(axes, limits: tuple[float, float, float, float]) -> None:
    """To scale, without frame, ticks or grid."""
    axes.set(xlim=limits[:2], ylim=limits[2:], aspect="equal", xticks=[], yticks=[])
    axes.grid(visible=False)
    axes.spines[:].set_visible(False)


def framed(axes, low: np.ndarray, high: np.ndarray) -> tuple[float, ...]:
    """Limits of z and y around what is seen, in the proportions of the axes."""
    place = axes.get_position()
    shape = np.array([place.width * WIDTH, place.height * HEIGHT])
    middle, size = (low + high) / 2, (1 + 2 * ROOM) * (high - low)
    size = shape * (size / shape).max()
    return tuple(np.stack([middle - size / 2, middle + size / 2], axis=1).ravel())


class Film:
    """The figure: what stays, and what a frame adds."""

    def __init__(self, rows: np.ndarray) -> None:
        self.rows, self.time, self.parts = rows, rows["time_s"], Parts.read(rows)
        self.figure = plt.figure(figsize=(WIDTH / 100, HEIGHT / 100), dpi=100, layout="none")
        self.larger = axes_at(self.figure, 12, 14, 359, 528)
        self.scene = axes_at(self.figure, 388, 253, 541, 297)
        self.angle = axes_at(self.figure, 450, 154, 425, 70)
        self.margin = axes_at(self.figure, 450, 46, 425, 70)
        self.tips = np.array([demo_picture.centreline(row)[:, -1] for row in rows])
        field = np.hypot(rows["tip_field_y_mt"], rows["tip_field_z_mt"]).max()
        self.field = 0.0 if field == 0 else FIELD / field
        self.curves = {
            self.angle: ("tip angle", demo_picture.signed_angle(rows), "{:+.0f}°"),
            self.margin: ("stability margin", rows["stability_margin"], "{:.2f}"),
        }
        self.lay()
        self.figure.canvas.draw()
        self.still = self.figure.canvas.copy_from_bbox(self.figure.bbox)

    def lay(self) -> None:
        """What stays."""
        words = demo_picture.finding(self.rows, self.parts)
        self.figure.text(0.018, 0.985, words, va="top", fontsize=14, fontweight="bold")
        near, far = self.limits()
        bare(self.scene, far)
        demo_picture.clamp(self.scene, 0.06 * (far[3] - far[2]))
        self.lay_distance(far)
        where = {"facecolor": "none", "edgecolor": look.LIGHT, "lw": 1.5, "zorder": 0}
        z, y = np.reshape(near, (2, 2))
        self.scene.add_patch(Rectangle((z[0], y[0]), np.ptp(z), np.ptp(y), **where))
        name = "rod" if self.parts.segments == 0 else "catheter"
        self.scene.text(z[1] + 0.01 * (far[1] - far[0]), y[0] + 0.86 * np.ptp(y), name, va="center")
        bare(self.larger, near)
        self.larger.add_patch(
            Rectangle(
                (0, 0), 1, 1, transform=self.larger.transAxes, facecolor="white", edgecolor=look.LIGHT, lw=1.5
            )
        )
        demo_picture.clamp(self.larger, 0.1 * (near[3] - near[2]))
        sizes = (axes.get_position().width / np.ptp(axes.get_xlim()) for axes in (self.larger, self.scene))
        ratio = np.divide(*sizes)
        words = f"{name}, {ratio:.1f} times as large as on the right"
        self.larger.text(0.04, 0.965, words, transform=self.larger.transAxes, va="top")
        self.lay_scale(near)
        for axes, (name, values, _) in self.curves.items():
            axes.set_title(name, fontsize=11)
            axes.plot(self.time, values, color=look.LIGHT, lw=2)
            axes.set_xlim(self.time[0], self.time[-1])
            axes.grid(axis="x", visible=False)
        self.angle.yaxis.set_major_formatter("{x:.0f}°")
        low, high = self.angle.get_ylim()
        self.angle.set_ylim(min(low, -LEAST_ANGLE), max(high, LEAST_ANGLE))
        self.margin.axhline(0, color=WARNING, lw=1, ls="--")
        look.label(self.margin, self.time[-1], 0, "fold", WARNING)
        self.margin.set(ylim=(-0.05, None), xlabel="time (s)")
        self.angle.tick_params(labelbottom=False)

    def limits(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Limits of z and y of the larger view and of the whole scene, in the proportions of their axes."""
        lines = np.concatenate([demo_picture.centreline(row).T for row in self.rows])
        room = max(self.parts.width, FIELD * np.ptp(lines, axis=0).max())
        lines = np.concatenate([lines - room, lines + room])
        every = range(0, len(self.rows), STRIDE)
        low, high = demo_picture.extent(self.rows, self.parts, list(every))
        near = framed(self.larger, np.minimum(lines.min(axis=0), 0), np.maximum(lines.max(axis=0), 0))
        corners = np.reshape(near, (2, 2))
        far = framed(self.scene, np.minimum(low, corners[:, 0]), np.maximum(high, corners[:, 1]))
        return near, far

    def lay_distance(self, limits: tuple[float, ...]) -> None:
        """The way of the magnet's axis from the device's, at the right."""
        if not self.parts.magnet:
            return
        away, right = -self.rows["magnet_y_mm"][0], limits[1] - 0.02 * (limits[1] - limits[0])
        self.scene.plot([0, right], [0, 0], color=look.LIGHT, lw=1, zorder=0)
        arrow = {"arrowstyle": "<->", "color": look.GREY, "lw": 1}
        self.scene.annotate("", (right, 0), (right, -away), arrowprops=arrow)
        words = f"{away:.0f} mm "
        self.scene.text(right, -away / 2, words, color=look.GREY, ha="right", va="center")

    def lay_scale(self, limits: tuple[float, ...]) -> None:
        """A bar of a round length."""
        wide, high = limits[1] - limits[0], limits[3] - limits[2]
        power = 10.0 ** np.floor(np.log10(0.25 * wide))
        length = power * max(step for step in (1, 2, 5) if step * power <= 0.25 * wide)
        left, y = limits[1] - 0.05 * wide - length, limits[2] + 0.03 * high
        self.larger.plot([left, left + length], [y, y], color=look.INK, lw=2, solid_capstyle="butt")
        words = f"{length:g} mm"
        self.larger.text(left + length / 2, y + 0.01 * high, words, ha="center", va="bottom", fontsize=9)

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
        scale = self.scene.get_position().width * WIDTH / np.ptp(self.scene.get_xlim())
        for pole, (z, y), corners in demo_picture.halves(row, self.parts):
            length = scale * np.hypot(*(corners[3] - corners[0]))
            tint = look.NORTH if pole == "N" else look.SOUTH
            self.draw(self.scene, Polygon(corners, facecolor=tint, edgecolor="white", lw=1.5))
            if length < LETTER:
                continue
            self.write(
                self.scene, z, y, pole, "white", ha="center", va="center", fontsize=10, fontweight="bold"
            )

    def draw_device(self, index: int) -> None:
        """The manipulator in both views; in the larger one the way of its tip and the field there."""
        row = self.rows[index]
        for axes in (self.scene, self.larger):
            if axes is self.larger:
                first = np.searchsorted(self.time, self.time[index] - TRAIL)
                z, y = self.tips[first : index + 1].T
                self.draw(axes, plt.Line2D(z, y, color=look.BLUE, alpha=0.35, lw=2))
            for patch in demo_picture.manipulator(row, self.parts, look.INK, core=0.45):
                self.draw(axes, patch)
        z, y = self.tips[index]
        field = np.array([row[f"tip_field_{axis}_mt"] for axis in "zy"])
        wide = np.ptp(self.larger.get_xlim())
        if self.field * np.hypot(*field) > 0.02 * FIELD:
            size = {"width": 0.009 * wide, "head_width": 0.038 * wide, "length_includes_head": True}
            arrow = FancyArrow(z, y, *(self.field * wide * field), **size, color=look.GREEN, zorder=30)
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
    frames = [film.frame(index) for index in range(0, max(len(rows) - 1, 1), STRIDE)]
    plt.close(film.figure)
    # The colours of one frame of the middle, where all are seen, so that what stays has the same ones in each.
    palette = frames[len(frames) // 2].quantize(COLOURS, dither=Image.Dither.NONE)
    palette.putpalette([255 if value > NEARLY_WHITE else value for value in palette.getpalette()])
    frames = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    frames[0].save(picture, save_all=True, append_images=frames[1:], duration=PAUSE, loop=0, optimize=False)


if __name__ == "__main__":
    draw(Path(sys.argv[1]), Path(sys.argv[2]))
