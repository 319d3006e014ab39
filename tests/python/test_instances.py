"""Instances, resets and saved states repeat themselves bit for bit."""

import math
import os
from collections.abc import Callable
from pathlib import Path

from conftest import Archive, Device

# What an instance or a step may leave behind at most, in bytes: an instance holds some 100 kB and a step's answers
# 1 kB, of which nothing stays; what is measured is the host's own log and the allocator's rounding.
CYCLE = 10_000
STEP = 200


def drive(device: Device, sign: float = 1.0) -> list[list[float]]:
    """A short run and all that it answers."""
    rows = []
    for index in range(4):
        device.step(
            0.1, {"magnet.position[1]": sign * 0.01 * index, "magnet.position[2]": -0.125 + 0.002 * index}
        )
        rows.append(device.get(device.reals()))
    return rows


def test_two_instances_do_not_disturb_each_other(default: Archive) -> None:
    alone = drive(Device(default, "alone").start())
    first, second = Device(default, "first").start(), Device(default, "second").start()
    together = []
    for index in range(4):
        first.step(0.1, {"magnet.position[1]": 0.01 * index, "magnet.position[2]": -0.125 + 0.002 * index})
        second.step(0.3, {"magnet.strength": 0.5 + 0.1 * index})
        together.append(first.get(first.reals()))
    assert together == alone
    second.slave.freeInstance()
    assert first.get(first.reals()) == alone[-1]
    first.slave.freeInstance()


def test_reset_repeats_the_run(device: Device) -> None:
    first = drive(device.start())
    device.slave.reset()
    assert drive(device.start()) == first
    device.slave.terminate()
    device.slave.reset()
    assert drive(device.start()) == first


def test_saved_state_repeats_the_run(device: Device) -> None:
    device.start()
    drive(device)
    state, time = device.slave.getFMUstate(), device.time
    first = drive(device, -1.0)
    for _ in range(2):
        device.slave.setFMUstate(state)
        device.time = time
        assert drive(device, -1.0) == first
    device.slave.freeFMUstate(state)


def test_reading_between_steps_changes_nothing(default: Archive) -> None:
    def run(*, reads: bool) -> list[float]:
        device = Device(default).start()
        for index in range(5):
            device.set({"magnet.position[3]": 0.02 + 0.002 * index})
            if reads:
                device.get(["tip.angle"])
            device.step(0.1)
        return device.get(device.reals())

    assert run(reads=True) == run(reads=False)


def memory() -> int:
    """Bytes of this process that are in memory."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_many_instances_come_and_go_in_constant_memory(pack: Callable[..., Archive]) -> None:
    archive = pack("[design]\nsegments = 1")

    def cycle() -> None:
        device = Device(archive).start()
        device.step(0.1)
        device.slave.fmi2FreeInstance(device.slave.component)
        device.slave.fmi2FreeInstance(device.slave.component)

    for _ in range(30):
        cycle()
    before = memory()
    for _ in range(100):
        cycle()
    assert memory() - before < 100 * CYCLE


def test_many_steps_in_constant_memory(pack: Callable[..., Archive]) -> None:
    device = Device(pack("[design]\nsegments = 1")).start()
    for index in range(2000):
        device.step(1e-3, {"magnet.position[1]": 0.01 * math.sin(0.01 * index)})
        if index == 200:
            before = memory()
    assert memory() - before < 1800 * STEP
    device.slave.freeInstance()


def test_a_run_leaves_the_unpacked_archive_as_it_was(pack: Callable[..., Archive]) -> None:
    archive = pack("[design]\nsegments = 1")
    paths = sorted(archive.folder.rglob("*"))
    for path in paths:
        path.chmod(path.stat().st_mode & ~0o222)
    before, here = [path.stat().st_mtime_ns for path in paths], Path.cwd()
    device = Device(archive).start()
    drive(device)
    device.slave.freeInstance()
    assert [path.stat().st_mtime_ns for path in paths] == before
    assert sorted(archive.folder.rglob("*")) == paths
    assert Path.cwd() == here
