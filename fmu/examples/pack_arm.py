"""Builds the partner FMU `arm.fmu`, the robot arm that carries the magnet, from the Cargo project `arm`.

.venv/bin/python fmu/examples/pack_arm.py --out arm.fmu
"""

import argparse
import os
import subprocess
import zipfile
from pathlib import Path

PROJECT = Path(__file__).parent / "arm"
# The crate `fmu_from_struct` leaves the model description behind this mark in the library.
MARK = b"fmu_from_struct::model_description::begin\n"


def build() -> bytes:
    """The library of the arm, built by cargo."""
    target = Path(os.environ.get("CARGO_TARGET_DIR", PROJECT.parents[2] / "target")).resolve() / "arm"
    subprocess.run(
        ["cargo", "build", "--quiet", "--locked", "--release"],
        cwd=PROJECT,
        env={**os.environ, "CARGO_TARGET_DIR": str(target)},
        check=True,
    )
    return (target / "release" / "libarm.so").read_bytes()


def pack(out: Path) -> None:
    """Writes the FMU."""
    library = build()
    _, found, rest = library.partition(MARK)
    if not found:
        raise SystemExit("the library of the arm holds no model description")
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("modelDescription.xml", rest[: rest.index(b"\0")])
        archive.writestr("binaries/linux64/Arm.so", library)


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--out", type=Path, default=Path("arm.fmu"), help="the FMU to write")
    arguments = parser.parse_args()
    pack(arguments.out)
    print(f"wrote {arguments.out}")


if __name__ == "__main__":
    main()
