"""Instances, resets and saved states repeat themselves bit for bit."""

from conftest import Archive, Device


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


def test_many_instances_come_and_go(default: Archive) -> None:
    for _ in range(50):
        device = Device(default)
        device.slave.fmi2FreeInstance(device.slave.component)
        device.slave.fmi2FreeInstance(device.slave.component)
