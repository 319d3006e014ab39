"""The view in a browser: it serves, shows what the FMU answers, follows who drags the magnet, and ends."""

import contextlib
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from collections.abc import Callable, Iterator
from pathlib import Path

import msgspec
import numpy as np
import viser
from conftest import PACKAGE, Archive, Device
from websockets.sync.client import connect

VIEW = PACKAGE / "fmu" / "examples" / "view_viser.py"
STEP = 0.05  # of the example, s
PLACE = [f"magnet.position[{k}]" for k in (1, 2, 3)]


def free_port() -> int:
    """A port of this machine on which nothing listens."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@contextlib.contextmanager
def viewing(fmu: Path, port: int, *options: str) -> Iterator[subprocess.Popen[str]]:
    """The example while it runs and serves."""
    command = [sys.executable, VIEW, fmu, "--port", str(port), *options]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        while True:
            assert process.poll() is None, process.communicate()
            with contextlib.suppress(urllib.error.URLError):
                assert urllib.request.urlopen(f"http://127.0.0.1:{port}", timeout=10).status == 200
                break
            time.sleep(0.02)
        yield process
    finally:
        process.kill()
        process.communicate()


def shown(line: str) -> float:
    """The tip angle in a line that the example prints, deg."""
    return float(line.partition("tip angle ")[2].partition(" deg")[0])


def angles(default: Archive, places: list[list[float]]) -> Iterator[float]:
    """Tip angles (deg) with the magnet at these places (mm) one after the other, by fmpy alone."""
    device = Device(default).start()
    for place in places:
        device.step(STEP, dict(zip(PLACE, [1e-3 * x for x in place], strict=True)))
        yield np.degrees(device.get(["tip.angle"])[0])
    device.slave.freeInstance()


def test_it_shows_what_the_fmu_answers_and_ends(default: Archive) -> None:
    with viewing(default.path, free_port(), "--drive", "40") as process:
        told, complaints = process.communicate(timeout=60)
    assert (process.returncode, complaints) == (0, "")
    lines = [line for line in told.splitlines() if "tip angle" in line]
    assert all(line.endswith(", solved") for line in lines)
    expected = list(angles(default, [[0.0, -120.0, 23.0 + moved] for moved in range(41)]))
    assert np.ptp(expected) > 10.0
    np.testing.assert_allclose([shown(line) for line in lines], expected, rtol=0, atol=1e-9)


def test_it_follows_who_drags_the_magnet(pack: Callable[..., Archive]) -> None:
    # The path to where bodies touch takes about as long as the default budget: on a slow machine it must not end first.
    archive = pack((PACKAGE / "fmu" / "default.toml").read_text() + "\n[model]\ntime_budget_s = 30.0\n")
    port, places = free_port(), [[0.0, -120.0, 23.0], [0.0, -120.0, 43.0], [0.0, -110.0, 43.0]]
    expected = list(angles(archive, places))
    touching = [0.0, -30.0, 43.0]  # the magnet's cylinders have a radius of 22.5 mm
    address, version = f"ws://127.0.0.1:{port}", f"viser-v{viser.__version__}"
    with (
        viewing(archive.path, port) as process,
        connect(address, subprotocols=[version], max_size=None) as browser,
    ):

        def next_line() -> str:
            return next(line.strip() for line in process.stdout if "tip angle" in line)

        def drag(place: list[float]) -> str:
            moved = {"type": "TransformControlsUpdateMessage", "name": "/gizmo", "owner": ""}
            pose = {"wxyz": [0.0, 1.0, 0.0, 0.0], "position": place}
            browser.send(msgspec.msgpack.encode(moved | pose))
            return next_line()

        lines = [next_line(), drag(places[1]), drag(touching), drag(places[2])]
    assert lines[2].endswith("not solved: bodies touch")
    got = [shown(line) for line in lines]
    assert got[2] == got[1], "the last good shape stays"
    np.testing.assert_allclose([got[0], got[1], got[3]], expected, rtol=0, atol=1e-9)


def test_it_says_how_to_pack_an_fmu(tmp_path: Path) -> None:
    command = [sys.executable, VIEW, tmp_path / "none.fmu"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "mcm pack --out" in done.stderr
    assert "Traceback" not in done.stderr
