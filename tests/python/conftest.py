"""What the tests of the FMU share: the program, packed archives, and an instance that keeps its log."""

import json
import os
import subprocess
from collections.abc import Callable, Iterable, Iterator
from ctypes import byref
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE
from fmpy.logging import addLoggerProxy

PACKAGE = Path(__file__).resolve().parents[2]


def program() -> Path:
    """The command line program, absolute: `MCM_BIN`, or the release build."""
    return Path(os.environ.get("MCM_BIN", PACKAGE / "target" / "release" / "mcm")).absolute()


def run(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """Runs the program."""
    return subprocess.run([program(), *arguments], capture_output=True, text=True, check=False)


@dataclass
class Archive:
    """A packed FMU, unpacked."""

    path: Path
    folder: Path
    guid: str
    variables: dict[str, object] = field(repr=False)

    def __init__(self, path: Path, folder: Path) -> None:
        self.path = path
        self.folder = folder
        self.description = read_model_description(path, validate=True)
        self.guid = self.description.guid
        self.variables = {variable.name: variable for variable in self.description.modelVariables}
        extract(path, unzipdir=folder)


class Device:
    """An instance of an FMU: values by name, and what it has told its host."""

    def __init__(self, archive: Archive, name: str = "device", guid: str | None = None) -> None:
        self.archive = archive
        self.log: list[str] = []
        self.time = 0.0
        self.callbacks = fmi2CallbackFunctions()
        self.callbacks.logger = fmi2CallbackLoggerTYPE(self.tell)
        addLoggerProxy(byref(self.callbacks))
        self.slave = FMU2Slave(
            guid=guid or archive.guid,
            unzipDirectory=str(archive.folder),
            modelIdentifier=archive.description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        self.slave.instantiate(callbacks=self.callbacks)

    def tell(self, _environment: int, _name: bytes, _status: int, category: bytes, message: bytes) -> None:
        """Keeps a message."""
        self.log.append(f"{category.decode()}: {message.decode()}")

    def references(self, names: Iterable[str]) -> list[int]:
        """Value references of these variables."""
        return [self.archive.variables[name].valueReference for name in names]

    def set(self, values: dict[str, float]) -> None:
        """Sets reals."""
        self.slave.setReal(self.references(values), list(values.values()))

    def get(self, names: Iterable[str]) -> list[float]:
        """Reads reals."""
        return list(self.slave.getReal(self.references(names)))

    def status(self) -> int:
        """Reads `solver.status`."""
        return self.slave.getInteger(self.references(["solver.status"]))[0]

    def outcome(self) -> int:
        """Reads `solver.outcome`."""
        return self.slave.getInteger(self.references(["solver.outcome"]))[0]

    def start(self, values: dict[str, float] | None = None) -> "Device":
        """From instantiation to the first communication point."""
        self.slave.setupExperiment(startTime=0.0)
        self.slave.enterInitializationMode()
        self.set(values or {})
        self.slave.exitInitializationMode()
        self.time = 0.0
        return self

    def step(self, size: float, values: dict[str, float] | None = None) -> None:
        """Sets inputs and steps."""
        self.set(values or {})
        self.slave.doStep(self.time, size)
        self.time += size

    def reals(self) -> list[str]:
        """Names of all real outputs."""
        variables = self.archive.variables.values()
        return [v.name for v in variables if v.causality == "output" and v.type == "Real"]


@pytest.fixture(scope="session")
def pack(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Archive]:
    """Packs a scene's text (`None`: the default); unpacks it into a folder with blanks, percent sign and umlaut."""

    def packed(scene: str | None = None, *options: str) -> Archive:
        folder = tmp_path_factory.mktemp("100% packed für alle")
        arguments = list(options)
        if scene is not None:
            (folder / "scene.toml").write_text(scene)
            arguments += ["--scene", str(folder / "scene.toml")]
        done = run("pack", *arguments, "--out", folder / "mcm.fmu")
        assert done.returncode == 0, done.stderr
        return Archive(folder / "mcm.fmu", folder / "unpacked")

    return packed


@pytest.fixture(scope="session")
def default(pack: Callable[..., Archive]) -> Archive:
    """The default FMU."""
    return pack()


@pytest.fixture
def device(default: Archive) -> Iterator[Device]:
    """An instance of the default FMU, not yet initialised."""
    made = Device(default)
    yield made
    made.slave.freeInstance()


@pytest.fixture
def solve(tmp_path: Path) -> Callable[[str, int], dict]:
    """Solves a scene's text on the command line."""

    def solved(scene: str, shape_points: int = 21) -> dict:
        (tmp_path / "scene.toml").write_text(scene)
        done = run("solve", tmp_path / "scene.toml", "--json", "--shape-points", str(shape_points))
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)

    return solved


@pytest.fixture(scope="session")
def live_page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page, built by `fmu/live` from another folder."""
    folder = tmp_path_factory.mktemp("live page")
    done = subprocess.run(
        [PACKAGE / "fmu" / "live"], cwd=folder, capture_output=True, text=True, check=False, timeout=900
    )
    assert done.returncode == 0, done.stderr
    return folder / "mcm_live.html"


@pytest.fixture
def open_page(live_page: Path, tmp_path: Path) -> Iterator[Callable[..., object]]:
    """Opens the page; at the end no test may leave complaints in the console."""
    from page import LAPTOP, Page  # noqa: PLC0415  # needs a browser, and this module

    opened: list[Page] = []

    def made(size: tuple[int, int] = LAPTOP, more: str = "") -> Page:
        opened.append(Page(live_page, tmp_path, size, more))
        return opened[-1]

    yield made
    complaints = [page.complaints() for page in opened]
    for page in opened:
        page.browser.quit()
    assert complaints == [[] for _ in opened]
