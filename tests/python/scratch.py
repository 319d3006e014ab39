"""A folder in which the commands of a page run: it holds what the page says before them, and a user's own data."""

import csv
import itertools
import os
import re
import subprocess
import sys
import tomllib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import trimesh
from conftest import PACKAGE, program
from markdown_pages import Block, Command, blocks

# The helix of the device that was measured, in the scene of the page, and the standard deviations of its outputs.
TRUTH = "shore_a = 30.0\nlength_mm = 4.1\n"
NOISE = {"alpha_deg": 0.3, "tip_y_mm": 0.05, "tip_z_mm": 0.05}


def is_scene(text: str) -> bool:
    """Whether a table of a page is a scene, and not a part of one: it says what the device is or what acts on it."""
    return not {"design", "field", "magnet"}.isdisjoint(tomllib.loads(text))


def scenes(page: Path) -> list[Block]:
    """The scenes of a page."""
    return [block for block in blocks(page) if block.language == "toml" and is_scene(block.text)]


# What a part of a scene is put into.
WHOLE = {"design": "[design]\nsegments = 3", "model": '[model]\ninteraction = "rings"'}


class Scratch:
    """A folder for the commands of a page, which run in the order of the page."""

    def __init__(self, page: Path, folder: Path) -> None:
        self.folder = folder
        for name in ("fmu", "tests", "src"):
            (folder / name).symlink_to(PACKAGE / name)
        (folder / ".venv").symlink_to(sys.prefix)
        (folder / "target/release").mkdir(parents=True)
        (folder / "target/release/mcm").symlink_to(program())
        (folder / "bin").mkdir()
        (folder / "bin/mcm").symlink_to(program())
        of_page = scenes(page)
        scene = (of_page or scenes(PACKAGE / "README.md"))[0].text
        if "[uncertainty]" not in scene:
            scene += '\n[uncertainty]\n"design.helix.shore_a" = 1.0\n'
        self.write("scene.toml", scene)

    def write(self, name: str, text: str) -> None:
        """Writes a file that the page takes for granted."""
        (self.folder / name).write_text(text)

    def run(self, line: str, timeout: float = 300.0) -> subprocess.CompletedProcess[str]:
        """Runs a command line of the page as a shell does."""
        path = f"{self.folder / 'bin'}{os.pathsep}{os.environ['PATH']}"
        return subprocess.run(
            ["bash", "-euo", "pipefail", "-c", line],
            cwd=self.folder,
            env=os.environ | {"PATH": path},
            capture_output=True,
            text=True,
            check=False,
            timeout=timeout,
        )

    def python(self, text: str) -> subprocess.CompletedProcess[str]:
        """Runs a Python program of the page."""
        self.write("program.py", text)
        return self.run(".venv/bin/python program.py")

    def solve(self, text: str) -> subprocess.CompletedProcess[str]:
        """Solves a scene of the page, or a part of one in a scene of three segments."""
        told = tomllib.loads(text)
        lacking = {name: part for name, part in WHOLE.items() if name not in told}
        self.write("shown.toml", "\n".join([*lacking.values(), text]))
        if "multipoles_csv" in text:
            self.write("core.csv", "degree,t_m_per_a\n1,2e-6\n3,1e-9\n")
        if "phantom.stl" in text:
            tube = trimesh.creation.cylinder(radius=8.0, segment=[[0.0, 0.0, -10.0], [0.0, 0.0, 60.0]])
            tube.export(self.folder / "phantom.stl")
        bands = "--uncertainty" if "uncertainty" in told else ""
        return self.run(f"mcm solve shown.toml {bands}")

    def bring(self, command: Command) -> None:
        """Makes the files that a command reads and that are the user's own.

        The default FMU is made, too, where a page begins with that of the first page.
        """
        words = command.words()
        if words[0] == "mcm":
            for option, file in itertools.pairwise(words):
                if option in BROUGHT and not (self.folder / file).exists():
                    BROUGHT[option](self, file, words)
        elif "mcm.fmu" in words and not (self.folder / "mcm.fmu").exists():
            assert self.run("mcm pack --out mcm.fmu").returncode == 0

    def points(self, file: str, _words: list[str]) -> None:
        """Points of `mcm field`."""
        self.write(file, "x_m,y_m,z_m\n0,0,0.05\n0.01,0.02,0.06\n")

    def path(self, file: str, _words: list[str]) -> None:
        """A path of inputs, as a host of the FMU or the live page writes it."""
        self.write(file, "time,field.uniform[1],field.uniform[2]\n0,0,0.01\n0.5,0.001,0.009\n1,0.002,0.008\n")

    def targets(self, file: str, _words: list[str]) -> None:
        """Targets of `mcm steer`, on a way from the tip of its page's scene."""
        rows = ["-0.0001,-0.8156,15.7863", "0.0423,-1.1886,15.7569", "-0.0129,-0.4954,15.8028"]
        self.write(file, "\n".join(["tip_x_mm,tip_y_mm,tip_z_mm", *rows]) + "\n")

    def goal(self, file: str, _words: list[str]) -> None:
        """The scene with its magnet 10 mm further along the device."""
        scene = (self.folder / "scene.toml").read_text()
        place = re.search(r"position_mm = \[(.*), (.*), (.*)\]", scene)
        further = f"position_mm = [{place[1]}, {place[2]}, {float(place[3]) + 10.0}]"
        self.write(file, scene.replace(place[0], further))

    def measured(self, file: str, words: list[str]) -> None:
        """Forty rows of angle and place of the tip of a softer, longer device, with normal noise.

        A standard deviation stands beside the values for which the command says none.
        """
        scene = (self.folder / "scene.toml").read_text()
        self.write("truth.toml", f"{scene}\n[design.helix]\n{TRUTH}")
        done = self.run("mcm sweep truth.toml --vary 'field.uniform_mt[2]=0.25:10:40' --out truth.csv")
        assert done.returncode == 0, done.stderr
        noise = np.random.default_rng(1)
        said = {word.partition("=")[0] for option, word in itertools.pairwise(words) if option == "--sigma"}
        deviations = {name: sd for name, sd in NOISE.items() if name not in said}
        with (self.folder / "truth.csv").open() as swept, (self.folder / file).open("w") as out:
            print("field.uniform_mt[2]", *NOISE, *(f"sd_{name}" for name in deviations), sep=",", file=out)
            for row in csv.DictReader(swept):
                values = [float(row[name]) + sd * noise.standard_normal() for name, sd in NOISE.items()]
                cells = [f"{value:.3f}" for value in values]
                print(row["field.uniform_mt[2]"], *cells, *deviations.values(), sep=",", file=out)


# Options of `mcm` that name a file of the user's own, and what makes one.
BROUGHT: dict[str, Callable[[Scratch, str, list[str]], None]] = {
    "--at": Scratch.points,
    "--inputs": Scratch.path,
    "--measured": Scratch.measured,
    "--targets": Scratch.targets,
    "--to": Scratch.goal,
}
