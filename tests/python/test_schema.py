"""The JSON schema of scenes accepts and refuses what the program accepts and refuses."""

import json
import re
import tomllib
from pathlib import Path

import pytest
from conftest import PACKAGE, program, run
from jsonschema import Draft7Validator

TUBE = "outer_radius_mm = 0.7\ninner_radius_mm = 0.3\npoisson = 0.45\n"
BACKBONE = f"[design.backbone]\n{TUBE}shore_a = 40.0\n"
COIL = (
    "[[coil]]\nposition_mm = [0.0, 200.0, 0.0]\n"
    "inner_radius_mm = 20.0\nouter_radius_mm = 40.0\nlength_mm = 60.0\nturns = 100\n"
)
ROD = '[design]\nkind = "cylinder"\nlength_mm = 40.0\nradius_mm = 2.0\n'
BRANCH = '[[vessel.branch]]\nname = "a"\npoints_mm = [[0, 0, -30], [0, 0, 60]]\nradius_mm = 8\n'
CYLINDER = "{ radius_mm = 20.0, length_mm = 30.0, remanence_t = 1.0 }"

GOOD = {
    "nothing": "",
    "whole numbers": "[field]\nuniform_mt = [0, 1, 0]\n",
    "a rod of rubber": ROD + "shore_a = 30\n",
    "a rod of known stiffness": ROD + "elastic_modulus_mpa = 1.0\nremanence_t = 0.1\n",
    "a backbone by its modulus": f"[design.backbone]\n{TUBE}elastic_modulus_mpa = 1.0\n",
    "starts of spirals": "[design]\nsegments = 2\nspiral_start_deg = [0, 90.0]\n",
    "one magnet": "[magnet]\n",
    "a cuboid": '[magnet]\nshape = "cuboid"\nsize_mm = [10, 20, 10]\ndirection = [0, 0.6, 0.8]\nremanence_t = -1.2\n',
    "a grade": '[magnet]\nshape = "sphere"\nradius_mm = 12.5\ngrade = "N42"\n',
    "a ring": '[magnet]\nshape = "cylinder"\nradius_mm = 12.5\ninner_radius_mm = 5\nlength_mm = 9\ngrade = "N35"\n',
    "two magnets": f"[[magnet]]\n[[magnet]]\nposition_mm = [150.0, 0, 0]\ncylinders = [{CYLINDER}]\n",
    "a coil": COIL,
    "a coil with iron": COIL + "multipoles = [1e-7]\nreach_mm = 50.0\n",
    "a vessel": "[vessel]\n" + BRANCH,
    "a vessel of two radii": "[vessel]\n" + BRANCH.replace("= 8", "= [8.0, 9]"),
    "a push": BACKBONE + '[feed]\nmode = "force"\nforce_n = 0.01\n',
    "a shaft": f'[feed]\nmode = "insertion"\ninsertion_mm = 10.0\n[feed.shaft]\n{TUBE}shore_a = 40.0\n',
    "a guidewire": "[guidewire]\nradius_mm = 0.2\nelastic_modulus_mpa = 75000.0\n",
    "loads": "[design]\nsegments = 1\n[load]\nring_force_n = [[0, 0, 0], [0, 0, 1e-3]]\n",
    "uncertainty": '[uncertainty]\n"design.helix.shore_a" = 1\n',
}

BAD = {
    "an unknown table": "[desing]\n",
    "an unknown key": "[design.helix]\nlenght_mm = 4.0\n",
    "an unknown key of a list": f"[magnet]\ncylinders = [{CYLINDER.replace('length', 'height')}]\n",
    "a text for a number": '[design.helix]\nlength_mm = "4.0"\n',
    "a number for a text": "[design]\nkind = 1\n",
    "a number for a truth": "[design]\ntip_magnet = 1\n",
    "a broken count": "[design]\nsegments = 2.5\n",
    "a list that is too short": "[field]\nuniform_mt = [0.0, 1.0]\n",
    "a list that is too long": "[field]\nuniform_mt = [0.0, 1.0, 0.0, 0.0]\n",
    "a number for a list": "[base]\nposition_mm = 1.0\n",
    "a table for a list": "[coil]\ncurrent_a = 1.0\n",
    "too many segments": "[design]\nsegments = 65\n",
    "no segments": "[design]\nsegments = 0\n",
    "too long a helix": "[design.helix]\nlength_mm = 1000.1\n",
    "no length": "[design.ring]\nlength_mm = 0.0\n",
    "an incompressible helix": "[design.helix]\npoisson = 0.5\n",
    "an unknown choice": '[design]\nspiral = "left"\n',
    "an unknown level": '[model]\ninteraction = "some"\n',
    "an unknown method": '[model]\nmethod = "guess"\n',
    "an unknown mode": '[feed]\nmode = "pulled"\n',
    "a rod without length": '[design]\nkind = "cylinder"\nradius_mm = 2.0\n',
    "a rod of segments": ROD + "segments = 2\n",
    "a chain with a rod's radius": "[design]\nradius_mm = 2.0\n",
    "a rod of half a material": ROD + "elastic_modulus_mpa = 1.0\n",
    "a rod of two materials": ROD + "elastic_modulus_mpa = 1.0\nremanence_t = 0.1\nshore_a = 30.0\n",
    "a backbone without stiffness": f"[design.backbone]\n{TUBE}",
    "a backbone of two stiffnesses": BACKBONE + "elastic_modulus_mpa = 1.0\n",
    "a backbone without radius": BACKBONE.replace("inner_radius_mm = 0.3\n", ""),
    "another shape": '[magnet]\nshape = "prism"\nsize_mm = [10, 20, 10]\nremanence_t = 1.2\n',
    "a cuboid without size": '[magnet]\nshape = "cuboid"\nremanence_t = 1.2\n',
    "a cuboid in m": '[magnet]\nshape = "cuboid"\nsize_mm = [0.01, 0.02, 0.01]\nremanence_t = 1.2\n',
    "a cuboid with a radius": '[magnet]\nshape = "cuboid"\nsize_mm = [9, 9, 9]\nradius_mm = 3\nremanence_t = 1.2\n',
    "a cuboid with cylinders": '[magnet]\nshape = "cuboid"\nsize_mm = [9, 9, 9]\nremanence_t = 1\n'
    f"cylinders = [{CYLINDER}]\n",
    "a shape without remanence": '[magnet]\nshape = "sphere"\nradius_mm = 3\n',
    "a grade beside its remanence": '[magnet]\nshape = "sphere"\nradius_mm = 3\ngrade = "N52"\nremanence_t = 1.4\n',
    "an unknown grade": '[magnet]\nshape = "sphere"\nradius_mm = 3\ngrade = "N53"\n',
    "more than a magnet has": '[magnet]\nshape = "sphere"\nradius_mm = 3\nremanence_t = 2.5\n',
    "a size without a shape": "[magnet]\nsize_mm = [9, 9, 9]\n",
    "a magnet without cylinders": "[magnet]\ncylinders = []\n",
    "a second magnet nowhere": "[[magnet]]\n[[magnet]]\n",
    "a coil without turns": COIL.replace("turns = 100\n", ""),
    "a core said twice": COIL + 'multipoles = [1e-7]\nmultipoles_csv = "core.csv"\n',
    "a reach without a core": COIL + "reach_mm = 50.0\n",
    "too many multipoles": COIL + f"multipoles = {[1e-7] * 18}\n",
    "a vessel without branches": "[vessel]\n",
    "a vessel said twice": '[vessel]\nmesh_stl = "a.stl"\n' + BRANCH,
    "a branch of one point": "[vessel]\n" + BRANCH.replace(", [0, 0, 60]", ""),
    "a clamped device pushed in": "[feed]\ninsertion_mm = 10.0\n",
    "a push without its mode": BACKBONE + '[feed]\nmode = "insertion"\nforce_n = 0.01\n',
    "no shaft to push": '[feed]\nmode = "insertion"\n',
    "a clamped shaft": f"[feed.shaft]\n{TUBE}shore_a = 40.0\n",
    "a deviation of nothing": '[uncertainty]\n"design.helix.shore_a" = 0.0\n',
    "no time": "[model]\ntime_budget_s = 0.0\n",
}


@pytest.fixture(scope="module")
def schema() -> Draft7Validator:
    printed = run("init", "--schema")
    assert printed.returncode == 0, printed.stderr
    told = json.loads(printed.stdout)
    Draft7Validator.check_schema(told)
    return Draft7Validator(told)


def faults(schema: Draft7Validator, text: str) -> list[str]:
    return [f"{fault.json_path}: {fault.message}" for fault in schema.iter_errors(tomllib.loads(text))]


def solve(scene: str, folder: Path) -> tuple[int, str]:
    """Exit status and messages of the program; it reads all of the scene before it solves."""
    path = folder / "scene.toml"
    path.write_text(scene, encoding="utf-8")
    done = run("solve", path, "--json")
    return done.returncode, done.stderr


def scenes() -> list[Path]:
    """All scene files of the project."""
    files = [
        path for folder in ("fmu", "tests", "src") for path in sorted((PACKAGE / folder).rglob("*.toml"))
    ]
    own = [path for path in files if path.name != "Cargo.toml"]
    return [path for path in own if not {"target", "node_modules"} & set(path.parts)]


def test_scenes_of_the_project_obey_the_schema(schema: Draft7Validator) -> None:
    files = scenes()
    assert len(files) > 2
    for path in files:
        assert faults(schema, path.read_text(encoding="utf-8")) == [], path


def test_scenes_in_documents_obey_the_schema(schema: Draft7Validator) -> None:
    pages = [PACKAGE / "README.md", *sorted((PACKAGE / "src").rglob("*.md"))]
    shown = [
        (page, text)
        for page in pages
        for text in re.findall(r"```toml\n(.*?)```", page.read_text(), re.DOTALL)
    ]
    assert len(shown) > 5
    for page, text in shown:
        assert faults(schema, text) == [], page


@pytest.mark.parametrize("arguments", [[], ["--vessel", "aorta"], ["--vessel", "aorta-spatial"]])
def test_scenes_to_begin_with_obey_the_schema(schema: Draft7Validator, arguments: list[str]) -> None:
    printed = run("init", *arguments).stdout
    assert "[design]" in printed
    assert faults(schema, printed) == []


@pytest.mark.parametrize("name", GOOD)
def test_both_accept(schema: Draft7Validator, name: str, tmp_path: Path) -> None:
    status, told = solve(GOOD[name], tmp_path)
    assert status != 1, told
    assert faults(schema, GOOD[name]) == []


@pytest.mark.parametrize("name", BAD)
def test_both_refuse(schema: Draft7Validator, name: str, tmp_path: Path) -> None:
    status, told = solve(BAD[name], tmp_path)
    assert status == 1, f"accepted by {program()}"
    assert "scene.toml" in told
    assert faults(schema, BAD[name])


def test_what_is_wrong_is_told_in_the_words_of_the_reference(tmp_path: Path) -> None:
    page = (PACKAGE / "src/manipulator/scene/README.md").read_text(encoding="utf-8")
    told = re.findall(r"^- line (\d+): (`+)(.*)\2$", page, re.MULTILINE)
    assert told
    scene = "[design]\nsegments = 99\n[design.helix]\nlenght_mm = 4.0\npoisson = 0.5\n"
    path = tmp_path / "scene.toml"
    path.write_text(scene, encoding="utf-8")
    expected = "".join(f"error: scene.toml, line {line}: {words}\n" for line, _, words in told)
    assert run("solve", path).stderr.replace(str(path), path.name) == expected


def test_the_example_of_the_reference_is_solved(tmp_path: Path) -> None:
    page = (PACKAGE / "src/manipulator/scene/README.md").read_text(encoding="utf-8")
    status, told = solve(page.split("```toml\n")[1].split("```")[0], tmp_path)
    assert status == 0, told
