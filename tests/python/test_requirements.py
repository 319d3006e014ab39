"""What the Python programs import is what their documentation says to install, and `fmu/venv` installs it."""

import ast
import os
import re
import shutil
import signal
import subprocess
import sys
import zipfile
from importlib import metadata
from pathlib import Path

import pytest
from conftest import PACKAGE

DEMO = "fmu/requirements.txt"
FILES = [
    DEMO,
    "fmu/examples/requirements.txt",
    "fmu/examples/casadi.txt",
    "tests/requirements.txt",
    "tests/bench/requirements.txt",
    "tests/bench/scipy.txt",
    "tests/bench/finite_elements.txt",
    "tests/bench/mujoco.txt",
]
FOLDERS = ["fmu", "fmu/examples", "tests/charts", "tests/bench", "tests/python"]
PROGRAMS = {path.stem: path for folder in FOLDERS for path in sorted((PACKAGE / folder).glob("*.py"))}

# Distributions that are named otherwise than what they let import, where the environment may not hold them.
DISTRIBUTIONS = {"elastica": "pyelastica", "skfem": "scikit-fem"}


def lines(file: Path) -> list[str]:
    """A requirements file without its comments."""
    return [
        line for line in (text.partition("#")[0].strip() for text in file.read_text().splitlines()) if line
    ]


def pins(file: Path) -> dict[str, str]:
    """Versions by package of a requirements file alone."""
    return dict(line.split("==") for line in lines(file) if not line.startswith("-r "))


def installed_by(file: Path) -> set[str]:
    """The packages that a file and those that it includes install, and as far as these are here, what they require."""
    found: set[str] = set()
    open_ = [name.lower() for name in pins(file)]
    for line in lines(file):
        if line.startswith("-r "):
            found |= installed_by(file.parent / line[3:])
    while open_:
        name = open_.pop()
        if name in found:
            continue
        found.add(name)
        try:
            required = metadata.requires(name) or []
        except metadata.PackageNotFoundError:
            continue
        open_ += [re.match(r"[\w.-]+", text)[0].lower() for text in required if "extra ==" not in text]
    return found


def imported(program: Path, seen: set[Path] | None = None) -> set[str]:
    """Distributions that a program imports, itself or through other programs here."""
    seen = set() if seen is None else seen
    seen.add(program)
    distributions = metadata.packages_distributions()
    names: set[str] = set()
    for node in ast.walk(ast.parse(program.read_text())):
        if isinstance(node, ast.Import):
            names |= {alias.name.partition(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            names.add(node.module.partition(".")[0])
    found: set[str] = set()
    for name in names - sys.stdlib_module_names:
        if name in PROGRAMS:
            if PROGRAMS[name] not in seen:
                found |= imported(PROGRAMS[name], seen)
        else:
            found.add(DISTRIBUTIONS.get(name) or distributions.get(name, [name])[0].lower())
    return found


def test_no_package_is_pinned_twice() -> None:
    pinned = [name for file in FILES for name in pins(PACKAGE / file)]
    assert sorted(pinned) == sorted(set(pinned))
    found = {str(path.relative_to(PACKAGE)) for path in PACKAGE.glob("[ft]*/**/requirements.txt")}
    assert found <= set(FILES), "every file is tested here"


def test_the_demo_needs_little() -> None:
    assert set(pins(PACKAGE / DEMO)) == {"fmpy", "numpy", "matplotlib", "tqdm"}


@pytest.mark.parametrize("name", PROGRAMS)
def test_documentation_names_what_is_imported(name: str) -> None:
    text = PROGRAMS[name].read_text()
    if PROGRAMS[name].parent.name == "python":
        file = "tests/requirements.txt"
    elif '__name__ == "__main__"' not in text:
        return  # what imports it names the file
    else:
        told = re.search(r"fmu/venv (\S+\.txt)", ast.get_docstring(ast.parse(text)))
        file = told[1] if told else DEMO
    assert file in FILES
    missing = imported(PROGRAMS[name]) - installed_by(PACKAGE / file)
    assert not missing, f"{name} imports what {file} does not install"


# Runs a program where a package is missing.
WITHOUT = (
    "import runpy, sys; sys.modules[sys.argv[1]] = None; runpy.run_path(sys.argv[2], run_name='__main__')"
)


@pytest.mark.parametrize(
    ("package", "program"),
    [
        ("libcosimpy", "fmu/examples/coupled_libcosim.py"),
        ("ecospy", "fmu/examples/coupled_ecos.py"),
        ("distributed", "fmu/examples/sweep_dask.py"),
        ("viser", "fmu/examples/view_viser.py"),
        ("magpylib", "tests/bench/table.py"),
    ],
)
def test_programs_say_what_installs_their_packages(package: str, program: str) -> None:
    path = PACKAGE / program
    done = subprocess.run(
        [sys.executable, "-c", WITHOUT, package, path],
        env={**os.environ, "PYTHONPATH": str(path.parent)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    assert f"fmu/venv {path.parent.relative_to(PACKAGE)}/requirements.txt" in done.stderr
    assert "Traceback" not in done.stderr


def wheel(folder: Path, name: str, version: str) -> None:
    """Writes a package that holds its version."""
    files = {
        f"{name}/__init__.py": f"version = {version!r}\n",
        f"{name}-{version}.dist-info/METADATA": f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n",
        f"{name}-{version}.dist-info/WHEEL": "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
    }
    record = f"{name}-{version}.dist-info/RECORD"
    files[record] = "".join(f"{path},,\n" for path in [*files, record])
    with zipfile.ZipFile(folder / f"{name}-{version}-py3-none-any.whl", "w") as archive:
        for path, text in files.items():
            archive.writestr(path, text)


class Environment:
    """A copy of `fmu/venv` that installs packages from a folder, without network."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.wheels = folder.parent / "wheels"  # pip takes no blank in its path
        (folder / "fmu").mkdir()
        (folder / "tests").mkdir()
        self.wheels.mkdir()
        shutil.copy(PACKAGE / "fmu" / "venv", folder / "fmu")
        for version in ("1.0", "2.0"):
            for name in ("demoed", "tested"):
                wheel(self.wheels, name, version)
        (folder / "fmu" / "requirements.txt").write_text("# the demo: 1 MB\ndemoed==1.0 # why\n")
        (folder / "tests" / "requirements.txt").write_text(
            "# tests: 2 MB\n-r ../fmu/requirements.txt\ntested==1.0\n"
        )
        self.variables = {**os.environ, "PIP_NO_INDEX": "1", "PIP_FIND_LINKS": str(self.wheels)}

    def start(self, *files: str) -> subprocess.Popen[str]:
        """Starts `fmu/venv` in a process group of its own."""
        return subprocess.Popen(
            [self.folder / "fmu" / "venv", *files],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env=self.variables,
            cwd=self.folder.parent,
            start_new_session=True,
        )

    def run(self, *files: str, status: int = 0) -> str:
        """Runs `fmu/venv`; what it says."""
        process = self.start(*files)
        told, complaints = process.communicate(timeout=120)
        assert (process.returncode, told) == (status, ""), complaints
        return complaints

    def holds(self) -> list[str]:
        """What can be imported from it."""
        found = []
        for name in ("demoed", "tested"):
            command = [
                self.folder / ".venv" / "bin" / "python",
                "-c",
                f"import {name}; print({name}.version)",
            ]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            if done.returncode == 0:
                found.append(f"{name} {done.stdout.strip()}")
        return found


@pytest.fixture
def environment(tmp_path: Path) -> Environment:
    """Nothing is installed yet."""
    (tmp_path / "a package").mkdir()
    return Environment(tmp_path / "a package")


def test_venv_does_what_is_left_to_do(environment: Environment) -> None:
    told = environment.run()
    assert "the demo: 1 MB" in told and "tests" not in told
    assert environment.holds() == ["demoed 1.0"]
    stamp = environment.folder / ".venv" / "requirements.txt"
    before = stamp.stat().st_mtime_ns
    assert environment.run() == ""
    assert stamp.stat().st_mtime_ns == before

    told = environment.run("tests/requirements.txt")
    assert "tests: 2 MB" in told and "the demo" not in told
    for files in ([], ["tests/requirements.txt"]):
        assert environment.run(*files) == ""
        assert environment.holds() == ["demoed 1.0", "tested 1.0"]

    demo = environment.folder / "fmu" / "requirements.txt"
    demo.write_text(demo.read_text().replace("1.0", "2.0"))
    assert "the demo" in environment.run()
    assert environment.holds() == ["demoed 2.0", "tested 1.0"], "what was added stays"

    assert "no file nowhere.txt" in environment.run("nowhere.txt", status=1)
    (environment.folder / "fmu" / "more.txt").write_text("# more\nmissing==1.0\n")
    told = environment.run("fmu/more.txt", status=1)
    assert "not all could be installed" in told and "can be used" in told
    assert environment.run() == "", "a refused addition leaves the rest as it was"


@pytest.mark.parametrize("part", ["Python", "packages"])
def test_venv_completes_what_was_cut_off(environment: Environment, part: str) -> None:
    if part == "packages":
        environment.run()
    process = environment.start("tests/requirements.txt")
    assert "installing" in process.stderr.readline()
    while not (environment.folder / ".venv" / "unfinished.txt").exists():
        assert process.poll() is None
    os.killpg(process.pid, signal.SIGKILL)
    process.communicate()
    assert "cut off" in environment.run()
    assert environment.holds() == ["demoed 1.0", "tested 1.0"]
    assert environment.run("tests/requirements.txt") == ""

    # A package of which a part is missing.
    (environment.folder / ".venv" / "requirements.txt").rename(
        environment.folder / ".venv" / "unfinished.txt"
    )
    next(environment.folder.glob(".venv/lib/*/site-packages/tested/__init__.py")).unlink()
    assert "cut off" in environment.run()
    assert environment.holds() == ["demoed 1.0", "tested 1.0"]
