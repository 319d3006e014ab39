"""Numbers that pages show and that a solve gives: they are computed again."""

import csv
import math
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import PACKAGE, program, run
from markdown_pages import table

LEVELS = ["none", "preceding", "rings", "full"]
MODELS = PACKAGE / "src" / "manipulator" / "README.md"
REST = PACKAGE / "src" / "design" / "README.md"

# Of the last digit that is printed: rounding, and what the end of a solve leaves.
LAST_DIGIT = 0.51

Angles = Callable[[str], tuple[float, list[float]]]


def assert_printed(number: str, value: float, where: object) -> None:
    """A printed number is this value, rounded."""
    decimals = len(number.partition(".")[2])
    assert abs(float(number) - value) <= LAST_DIGIT * 10**-decimals, f"{where}: {number} is {value}"


@pytest.fixture
def angles(solve: Callable[..., dict]) -> Angles:
    """Angles of the tip and of all cores of a scene, deg."""

    def found(scene: str) -> tuple[float, list[float]]:
        answer = solve(scene, 2)
        return math.degrees(answer["alpha_rad"]), [math.degrees(angle) for angle in answer["core_angles_rad"]]

    return found


def scene(segments: int, field: float, level: str, design: str = "", more: str = "") -> str:
    """A device in a field across it, mT."""
    return (
        f'[design]\nsegments = {segments}\n{design}\n[model]\ninteraction = "{level}"\n{more}\n'
        f"[field]\nuniform_mt = [0.0, {field}, 0.0]\n"
    )


@pytest.mark.parametrize("level", LEVELS)
def test_one_segment_in_a_perpendicular_field(level: str, angles: Angles) -> None:
    [cells] = [row for row in table(MODELS, "| level | 5 mT") if row[0] == f"`{level}`"]
    for field, cell in zip([5.0, 10.0, 20.0, 30.0], cells[1:5], strict=True):
        with_base, without = re.fullmatch(r"(\S+) \((\S+)\)", cell).groups()
        assert_printed(with_base, angles(scene(1, field, level))[0], f"{level}, {field} mT")
        assert_printed(
            without, angles(scene(1, field, level, "base_magnet = false"))[0], f"{level}, {field} mT"
        )


@pytest.mark.parametrize("level", ["none", "rings", "full"])
def test_three_segments_with_bending_stop(level: str, angles: Angles) -> None:
    [cells] = [row for row in table(MODELS, "| level | field at 90") if row[0] == f"`{level}`"]
    for turn, cell in zip([90, 130, 170], cells[1:4], strict=True):
        # From the base's axis towards +y, as `turn_deg` counts.
        turned = scene(3, 0.0, level, more="bending_stop = true").replace(
            "[0.0, 0.0, 0.0]", "[0.0, 0.0, 20.0]"
        )
        tip, cores = angles(turned + f"turn_deg = {turn}\n")
        assert_printed(cell, tip, f"{level}, {turn} deg")
    for number, core in zip(cells[4].split(", "), cores, strict=True):
        assert_printed(number, core, f"{level}, core")
    if level == "none":  # the others end on the way
        tip, _ = angles(turned.replace("bending_stop = true", "") + "turn_deg = 170\n")
        assert cells[5].endswith(" at 170")
        assert_printed(cells[5].split()[0], tip, "without stop")


# What pages repeat of the comparison with the paper, and how that says it.
REPEATED = [
    ("README.md", "(31 %) is met within 1 %", "| 0.31 | 0.252 | 0.312 | +0.6 % |"),
    ("src/README.md", "a dipole errs by 28 %", "a dipole +28 %"),
    (
        "src/magnetics/README.md",
        "11.3 mT in the worst direction and 19.5 mT in the best",
        "| 11.31 to 19.54 |",
    ),
    ("src/magnetics/README.md", "0.15 to 0.33 T/m without a field", "| 0.15 to 0.33 |"),
    ("src/manipulator/README.md", "ends at 117.9 |", "`rings` ends at 117.9 deg, `full` at 88.1"),
    ("src/manipulator/README.md", "ends at 88.1 |", "`rings` ends at 117.9 deg, `full` at 88.1"),
    ("src/uncertainty/README.md", "(0.31; 0.245 to 0.379)", "the band is 0.245 to 0.379"),
    ("src/uncertainty/README.md", "(119 deg; 125.8 to 128.6", "the band is 125.8 to 128.6"),
    ("src/uncertainty/README.md", "(16 deg; 8.3 to 9.9)", "the band is 8.3 to 9.9"),
    ("src/uncertainty/README.md", "(0.09 N; 0.100 to 0.106)", "the band is 0.1000 to 0.1055"),
]


@pytest.mark.parametrize(("page", "repeated", "said"), REPEATED)
def test_other_pages_repeat_the_comparison(page: str, repeated: str, said: str) -> None:
    # `tests/cli/study.rs` holds that the comparison is what `mcm study all` writes.
    assert said in (PACKAGE / "src" / "studies" / "README.md").read_text()
    assert repeated in " ".join((PACKAGE / page).read_text().split())


def test_size_of_the_library() -> None:
    [cells] = [
        row for row in table(PACKAGE / "fmu" / "README.md", "| build |") if row[0].startswith("`cargo")
    ]
    size = program().with_name("libmcm.so").stat().st_size / 1e6
    # Compilers differ by some percent.
    assert abs(float(cells[2].removesuffix(" MB")) / size - 1.0) < 0.05, f"{size} MB"


@pytest.mark.parametrize(("row", "segments", "stop"), [(0, 1, 40), (1, 3, 20), (2, 3, 170)])
def test_ends_of_branches(row: int, segments: int, stop: int, tmp_path: Path) -> None:
    name, here, independent, apart = table(MODELS, "| end of the branch")[row]
    turned = "turned" in name
    level = re.match("`(.*?)`, S = (.)", name)
    assert level[2] == str(segments)
    at_start = scene(segments, 0.0, level[1])
    if turned:
        at_start = at_start.replace("[0.0, 0.0, 0.0]", "[0.0, 0.0, 20.0]")
    (tmp_path / "scene.toml").write_text(at_start)
    key = "field.turn_deg" if turned else "field.uniform_mt[2]"
    vary = f"{key}=0:{stop}:{21 if not turned else 18}"
    folds, out = tmp_path / "folds.csv", tmp_path / "out.csv"
    run("sweep", tmp_path / "scene.toml", "--vary", vary, "--folds", folds, "--out", out)
    with folds.open() as file:
        [fold] = list(csv.DictReader(file))
    value = float(fold[key])
    assert_printed(here, value, name)
    difference, unit = apart.split()
    off = abs(value - float(independent))
    # The independent value has no more digits than are printed.
    own = 0.5 * 10 ** -len(independent.partition(".")[2])
    scale = 1.0 if unit == "deg" else 100.0 / float(independent)
    assert abs(off * scale - float(difference)) <= own * scale, f"{name}: {off * scale} {unit}"


def test_shapes_at_rest(angles: Angles) -> None:
    for cells in table(REST, "| S | `spiral"):
        segments, start = (
            int(cells[0]),
            re.match(r"`(\[.*?\])`(?: (three|four) times)?(?: \(`(.*)`\))?", cells[4]),
        )
        times = {None: 1, "three": 3, "four": 4}[start and start[2]]
        turned = [float(angle) for angle in start[1].strip("[]").split(",")] * times if start else 0.0
        designs = ["", 'spiral = "alternating"', f"spiral_start_deg = {turned}"]
        numbers = [*cells[1:3], cells[3].split()[0]]
        if start and start[3]:
            designs.append(f"spiral_start_deg = {start[3]}")
            numbers.append(cells[3].split()[1].strip("()"))
        for design, number in zip(designs, numbers, strict=True):
            tip, _ = angles(scene(segments, 0.0, "full", design))
            assert_printed(number, tip, f"{segments} segments, {design}")


def test_the_side_of_a_load_counts(angles: Angles) -> None:
    text = " ".join(REST.read_text().split())
    said = re.search(
        r"bend by (\S+) and (\S+) degrees as built, (\S+) and (\S+) alternating, (\S+) and (\S+) turned, (\S+) with",
        text,
    ).groups()
    designs = [
        "",
        'spiral = "alternating"',
        f"spiral_start_deg = {[0.0, 240.0, 120.0] * 3}",
        'spiral = "axisymmetric"',
    ]
    loads = [(design, field) for design in designs for field in (2.0, -2.0)][: len(said)]
    for number, (design, field) in zip(said, loads, strict=True):
        assert_printed(number, angles(scene(9, field, "full", design))[0], f"{design}, {field} mT")
