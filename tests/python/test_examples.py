"""Every example of coupling runs, and all masters agree."""

import csv
import math
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from conftest import PACKAGE, Archive, program

EXAMPLES = PACKAGE / "fmu" / "examples"

# Relative to the largest value of a quantity. Masters differ in how they round times and interpolate inputs; the solver
# ends at 1e-11 of the elastic forces.
SLACK = 1e-9

Table = dict[str, np.ndarray]


def run(*command: str | Path) -> subprocess.CompletedProcess[str]:
    """Runs a program, which must end within five minutes: under valgrind some take more than one."""
    return subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)


def example(name: str, *arguments: str | Path) -> str:
    """Runs an example; what it prints."""
    done = run(sys.executable, EXAMPLES / name, *arguments)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def refused(name: str, *arguments: str | Path) -> str:
    """What an example says that must refuse its arguments."""
    done = run(sys.executable, EXAMPLES / name, *arguments)
    assert done.returncode == 1
    assert "Traceback" not in done.stderr
    return done.stderr


def quantity(column: str) -> str:
    """`tip.position[2]` and `arm.position_y` are parts of `tip.position` and `arm.position`."""
    array, bracket, _ = column.partition("[")
    return array if bracket else column.rpartition("_")[0] or column


def table(path: Path) -> Table:
    """Columns of a table by quantity, a column for each component."""
    names = path.read_text().partition("\n")[0].split(",")
    columns = np.loadtxt(path, delimiter=",", skiprows=1, unpack=True)
    quantities = [quantity(name) for name in names]
    return {
        q: np.array([c for c, of in zip(columns, quantities, strict=True) if of == q]) for q in quantities
    }


def difference(got: Table, expected: Table) -> float:
    """Largest difference of two tables, relative to the largest value of each quantity; says what it is."""
    assert got.keys() == expected.keys()
    assert all(np.ptp(values) > 0 for values in expected.values()), "something happens in every column"
    relative = {q: np.abs(got[q] - expected[q]).max() / np.abs(expected[q]).max() for q in expected}
    print({q: f"{value:.1e}" for q, value in relative.items()})
    return max(relative.values())


@pytest.fixture(scope="module")
def mcm(default: Archive, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The default FMU where a path has no blank: proxyfmu takes none."""
    return Path(shutil.copy(default.path, tmp_path_factory.mktemp("mcm")))


@pytest.fixture(scope="module")
def arm(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The partner FMU, built."""
    fmu = tmp_path_factory.mktemp("arm") / "arm.fmu"
    subprocess.run(
        [sys.executable, EXAMPLES / "pack_arm.py", "--out", fmu], check=True, timeout=300, capture_output=True
    )
    return fmu


@pytest.fixture(scope="module")
def driven(mcm: Path, tmp_path_factory: pytest.TempPathFactory) -> Table:
    """The magnet passes, by fmpy."""
    folder = tmp_path_factory.mktemp("driven")
    example("fmpy_plain.py", mcm, "--out", folder / "driven.csv", "--picture", folder / "driven.png")
    assert (folder / "driven.png").stat().st_size > 10_000
    return table(folder / "driven.csv")


@pytest.fixture(scope="module")
def coupled(mcm: Path, arm: Path, tmp_path_factory: pytest.TempPathFactory) -> Table:
    """The coupling, by the master of a few lines on fmpy."""
    out = tmp_path_factory.mktemp("coupled") / "coupled.csv"
    example("coupled_fmpy.py", mcm, arm, "--out", out)
    return table(out)


def one_step_ahead(expected: Table, got: Table) -> tuple[Table, Table]:
    """Rows of the master and of ecos that belong together: the manipulator's in ecos are one step ahead."""
    ahead = {q for q in expected if q.startswith("mcm.")}
    return (
        {q: values[:, 1:] if q in ahead else values[:, :-1] for q, values in expected.items()},
        {q: values[:, :-1] for q, values in got.items()},
    )


def test_force_deflects_the_arm(mcm: Path, arm: Path, coupled: Table, tmp_path: Path) -> None:
    example("coupled_fmpy.py", mcm, arm, "--stiffness", "1e5", "--out", tmp_path / "stiff.csv")
    stiff = table(tmp_path / "stiff.csv")
    force = coupled["mcm.magnet.reaction_force"][:, -1]
    np.testing.assert_allclose(coupled["arm.deflection"][:, -1], force / 10.0, rtol=2e-3)
    assert np.abs(stiff["arm.deflection"]).max() < 1e-6
    assert np.abs(stiff["mcm.tip.angle"] - coupled["mcm.tip.angle"]).max() > math.radians(0.5)


def test_libcosim(mcm: Path, arm: Path, coupled: Table, tmp_path: Path) -> None:
    example("coupled_libcosim.py", mcm, arm, "--out", tmp_path / "coupled.csv")
    assert difference(table(tmp_path / "coupled.csv"), coupled) < SLACK


@pytest.mark.parametrize("options", [[], ["--apart"]], ids=["together", "apart"])
def test_ecos(mcm: Path, arm: Path, coupled: Table, tmp_path: Path, options: list[str]) -> None:
    example("coupled_ecos.py", mcm, arm, "--out", tmp_path / "coupled.csv", *options)
    expected, got = one_step_ahead(coupled, table(tmp_path / "coupled.csv"))
    assert difference(got, expected) < SLACK


@pytest.mark.parametrize("master", ["fmpy", "libcosim", "ecos"])
def test_ssp(mcm: Path, arm: Path, coupled: Table, tmp_path: Path, master: str) -> None:
    example("make_ssp.py", mcm, arm, "--out", tmp_path / "coupling.ssp")
    out = tmp_path / "coupled.csv"
    example("coupled_ssp.py", tmp_path / "coupling.ssp", "--master", master, "--out", out)
    expected, got = coupled, table(out)
    if master == "ecos":
        expected, got = one_step_ahead(expected, got)
    assert difference(got, expected) < SLACK


@pytest.fixture(scope="module")
def compile_c(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Path]:
    """Compiles the C program with some options."""

    def compiled(*options: str) -> Path:
        program = tmp_path_factory.mktemp("c") / "drive"
        headers = f"-I{PACKAGE / 'fmu' / 'headers'}"
        source = EXAMPLES / "c" / "drive.c"
        strict = ["-std=c11", "-g", "-O1", "-Wall", "-Wextra", "-pedantic", "-Werror"]
        done = run("gcc", *strict, *options, headers, "-o", program, source, "-ldl")
        assert done.returncode == 0, done.stderr
        return program

    return compiled


def test_c_under_address_sanitizer(
    default: Archive, driven: Table, compile_c: Callable[..., Path], tmp_path: Path
) -> None:
    program = compile_c("-fsanitize=address,undefined", "-fno-sanitize-recover=all")
    done = run(program, default.folder, EXAMPLES / "magnet_pass.csv", tmp_path / "driven.csv")
    assert (done.returncode, done.stderr) == (0, "")
    assert difference(table(tmp_path / "driven.csv"), driven) < SLACK


def test_c_under_valgrind(
    pack: Callable[..., Archive], driven: Table, compile_c: Callable[..., Path], tmp_path: Path
) -> None:
    program = compile_c()
    # Every instruction takes many times as long.
    scene = (EXAMPLES.parent / "default.toml").read_text()
    assert "[model]" not in scene
    patient = pack(f"{scene}\n[model]\ntime_budget_s = 1000.0\n")
    inputs = (EXAMPLES / "magnet_pass.csv").read_text().splitlines()
    (tmp_path / "few.csv").write_text("\n".join(inputs[:12]) + "\n")
    done = run(
        "valgrind",
        "--leak-check=full",
        "--errors-for-leak-kinds=definite,indirect,possible",
        "--error-exitcode=9",
        *(program, patient.folder, tmp_path / "few.csv", tmp_path / "driven.csv"),
    )
    assert done.returncode == 0, done.stderr
    assert "ERROR SUMMARY: 0 errors" in done.stderr
    assert "definitely lost: 0 bytes" in done.stderr or "no leaks are possible" in done.stderr
    few = {q: values[:, :11] for q, values in driven.items()}
    assert difference(table(tmp_path / "driven.csv"), few) < SLACK


def test_c_from_a_relative_folder_with_a_scene_of_ones_own(
    pack: Callable[..., Archive], compile_c: Callable[..., Path], tmp_path: Path
) -> None:
    """As the first lines of the program say: `./drive unpacked ...`."""
    archive = pack('[design]\nsegments = 2\n[magnet]\n[model]\ninteraction = "none"')
    (tmp_path / "unpacked").symlink_to(archive.folder)
    (tmp_path / "drive").symlink_to(compile_c())
    command = ["./drive", "unpacked", EXAMPLES / "magnet_pass.csv", "driven.csv"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert np.ptp(table(tmp_path / "driven.csv")["tip.angle"]) > 0.1


def test_c_says_what_is_wrong(default: Archive, compile_c: Callable[..., Path], tmp_path: Path) -> None:
    program = compile_c()
    (tmp_path / "unknown.csv").write_text("time,magnet.colour\n0,1\n1,1\n")
    done = run(program, default.folder, tmp_path / "unknown.csv", tmp_path / "driven.csv")
    assert (done.returncode, done.stderr) == (1, "the FMU has no variable: magnet.colour\n")
    done = run(program, tmp_path, tmp_path / "unknown.csv", tmp_path / "driven.csv")
    assert done.returncode == 1
    assert "cannot load" in done.stderr


@pytest.fixture(scope="module")
def controlled(mcm: Path, tmp_path_factory: pytest.TempPathFactory) -> Table:
    """The controller with differences."""
    folder = tmp_path_factory.mktemp("controlled")
    arguments = ["--out", folder / "controlled.csv", "--picture", folder / "controlled.png"]
    example("fmpy_tip_angle.py", mcm, "--differences", *arguments)
    assert (folder / "controlled.png").stat().st_size > 10_000
    return table(folder / "controlled.csv")


def test_tip_angle_follows_its_target(controlled: Table) -> None:
    target, angle = controlled["target"][0], controlled["tip.angle"][0]
    before_change = np.append(np.flatnonzero(np.diff(target)), len(target) - 1)
    assert len(before_change) == 3
    np.testing.assert_allclose(angle[before_change], target[before_change], atol=math.radians(0.02))


def test_examples_say_what_is_wrong(mcm: Path, tmp_path: Path) -> None:
    out = tmp_path / "out.csv"
    vary = ["--out", out, "--vary"]
    assert "magnet.colour" in refused("sweep_dask.py", mcm, *vary, "magnet.colour=0:1:2")
    assert "tip.angle" in refused("sweep_dask.py", mcm, *vary, "tip.angle=0:1:2")
    inputs = tmp_path / "uneven.csv"
    inputs.write_text("time,magnet.strength\n0,1\n1,1\n1.5,1\n")
    assert "evenly" in refused("fmpy_plain.py", mcm, "--inputs", inputs, "--out", out)


def test_a_shaft_is_pushed_into_an_aorta(mcm: Path, tmp_path: Path) -> None:
    scene, fmu = tmp_path / "aorta.toml", tmp_path / "aorta.fmu"
    for command in [("init", "--vessel", "aorta", "--out", scene), ("pack", "--scene", scene, "--out", fmu)]:
        done = run(program(), *command)
        assert done.returncode == 0, done.stderr
    pushed = tmp_path / "pushed.csv"
    example("push_in.py", fmu, "--to", "20", "--out", pushed, "--picture", tmp_path / "pushed.png")
    assert (tmp_path / "pushed.png").stat().st_size > 10_000
    with pushed.open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 41
    depth, force = (
        np.array([float(row[name]) for row in rows])
        for name in ("contact.largest_indentation", "contact.largest_force")
    )
    assert depth.max() > 0
    # No deeper than Hertz has it for a ball of the rings' radius under the force of one contact.
    hertz = (force / (4 / 3 * 1e6 / 0.75 * math.sqrt(2e-3))) ** (2 / 3)
    assert (depth < 1.1 * hertz + 1e-6).all()
    assert "has no shaft in a vessel" in refused("push_in.py", mcm, "--out", pushed)


@pytest.fixture(scope="module")
def three_segments(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An FMU of a short device with the external magnet at its side."""
    folder = tmp_path_factory.mktemp("three")
    scene, fmu = folder / "three.toml", folder / "three.fmu"
    scene.write_text(
        '[design]\nsegments = 3\n[magnet]\nposition_mm = [0.0, -120.0, 9.0]\n[model]\ninteraction = "rings"\n'
    )
    done = run(program(), "pack", "--scene", scene, "--out", fmu)
    assert done.returncode == 0, done.stderr
    return fmu


def test_feedback_makes_up_for_a_wrong_model(three_segments: Path, tmp_path: Path) -> None:
    said = example(
        "steer_closed_loop.py",
        three_segments,
        "--out",
        tmp_path / "loop.csv",
        "--picture",
        tmp_path / "loop.png",
    )
    assert (tmp_path / "loop.png").stat().st_size > 10_000
    forward, closed = (float(line.split()[-2]) for line in said.splitlines() if "error" in line)
    # A Shore degree is 4 % of the stiffness; noise of 20 um is filtered to a quarter.
    assert 0.02 < forward < 0.2
    assert closed < 0.2 * forward
    rows = np.loadtxt(tmp_path / "loop.csv", delimiter=",", skiprows=1)
    late = rows[rows[:, 0] >= 0.5]
    off = np.sqrt(np.mean(np.sum((late[:, 1:3] - late[:, 3:5]) ** 2, axis=1)))
    np.testing.assert_allclose(1e3 * off, closed, atol=1e-4)


def test_eight_coils_make_the_wanted_field_at_the_tip(tmp_path: Path) -> None:
    fmu = tmp_path / "coils.fmu"
    done = run(program(), "pack", "--scene", EXAMPLES / "eight_coils.toml", "--out", fmu)
    assert done.returncode == 0, done.stderr
    said = example("coil_currents.py", fmu)
    field = next(line for line in said.splitlines() if line.startswith("field at the tip"))
    got = [float(part) for part in field.split(":")[1].split()[:3]]
    np.testing.assert_allclose(got, [0.0, 15.0, 0.0], atol=1e-4)
    currents = next(line for line in said.splitlines() if line.startswith("currents"))
    # The coils beyond the middle plane mirror those before it.
    amperes = [float(part) for part in currents.split(":")[1].split()[:8]]
    assert max(map(abs, amperes)) > 1.0
    np.testing.assert_allclose(amperes[0], amperes[2], atol=0.05 * max(map(abs, amperes)))


def test_a_stiff_arm_on_the_tip_needs_the_jacobian(mcm: Path) -> None:
    """Below a gain of 1 all schemes agree; beyond, Newton's method alone settles."""
    said = {
        stiffness: dict(
            line.split(": ", 1)
            for line in example("algebraic_loop.py", mcm, "--stiffness", stiffness).splitlines()
            if ": " in line
        )
        for stiffness in ("0.5", "20")
    }

    def force(line: str) -> np.ndarray:
        return np.array([float(part) for part in line.partition("(")[2].partition(")")[0].split(",")])

    def off(line: str) -> float:
        return float(line.partition("off by ")[2].split()[0])

    soft, stiff = said["0.5"], said["20"]
    np.testing.assert_allclose(force(soft["repetition"]), force(soft["Newton"]), atol=1e-4)
    assert off(soft["delay"]) > 1e3 * off(soft["Newton"])
    assert "diverges" in stiff["delay"] and "diverges" in stiff["repetition"]
    assert off(stiff["Newton"]) < 1e-5
    assert force(stiff["Newton"])[0] > 1.0


def test_ipopt_finds_a_pose_by_exact_derivatives(three_segments: Path) -> None:
    asked = ["--tip-position-mm", "0.04,-1.19,15.757", "--keep-away-mm"]
    found = {}
    for distance in (60.0, 125.0):
        said = example("magnet_pose_casadi.py", three_segments, *asked, str(distance)).splitlines()
        place = np.array([float(part) for part in said[0].partition("(")[2].partition(")")[0].split(",")])
        missed, snaps = float(said[2].split()[5]), int(said[2].split()[10])
        assert missed < 0.2 and snaps == 0, said
        # The device is 18 mm long and its rings lie near its axis.
        assert np.linalg.norm(place - [0.0, 0.0, np.clip(place[2], 0.0, 18.0)]) > distance - 3.0
        found[distance] = place
    assert np.linalg.norm(found[125.0] - found[60.0]) > 5.0, "the limit is felt"
