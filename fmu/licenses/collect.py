"""Writes fmu/licenses/crates.txt: the licence texts of all crates that the library is linked from.

    python3 fmu/licenses/collect.py

Texts that several crates share stand once. `tests/python/test_archive.py` fails where a crate of Cargo.lock is missing.
"""

import json
import subprocess
from collections import defaultdict
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
OUT = Path(__file__).with_name("crates.txt")
NAMES = ("license", "licence", "copying", "unlicense", "notice", "copyright", "ofl", "ufl")
PLATFORM = "x86_64-unknown-linux-gnu"


def linked() -> set[str]:
    """The crates that are linked, as `name version`."""
    command = ["cargo", "tree", "--locked", "--edges", "normal", "--prefix", "none", "--target", PLATFORM]
    lines = subprocess.run(command, cwd=PROJECT, capture_output=True, text=True, check=True).stdout
    crates = {" ".join(line.split()[:2]).replace(" v", " ") for line in lines.splitlines() if line}
    return {crate for crate in crates if not crate.startswith("mcm ")}


def texts(folder: Path) -> list[str]:
    """The texts of a crate's licence files; of a crate with a choice that ships none, nothing."""
    files = sorted(path for path in folder.rglob("*") if path.name.lower().startswith(NAMES))
    files = [path for path in files if path.is_file() and path.suffix not in (".rs", ".toml", ".json")]
    return [
        "\n".join(line.rstrip() for line in path.read_text(errors="replace").splitlines()).strip()
        for path in files
    ]


def main() -> None:
    """Writes the file."""
    command = ["cargo", "metadata", "--locked", "--format-version", "1", "--filter-platform", PLATFORM]
    told = subprocess.run(command, cwd=PROJECT, capture_output=True, text=True, check=True).stdout
    packages = {f"{own['name']} {own['version']}": own for own in json.loads(told)["packages"]}
    holders = defaultdict(list)
    lines = ["The library is linked from these crates:", ""]
    for crate in sorted(linked()):
        package = packages[crate]
        lines.append(
            f"{crate}: {package['license'] or 'see its text'} {package['repository'] or ''}".rstrip()
        )
        for text in texts(Path(package["manifest_path"]).parent):
            holders[text].append(crate)
    for text, crates in sorted(holders.items(), key=lambda item: item[1]):
        lines += ["", "=" * 100, "\n".join(sorted(set(crates))), "-" * 100, text]
    OUT.write_text("\n".join(lines) + "\n", encoding="utf-8")
    missing = sorted(linked() - {crate for crates in holders.values() for crate in crates})
    print(
        f"{OUT.relative_to(PROJECT)}: {len(holders)} texts; without a text of their own: {', '.join(missing)}"
    )


if __name__ == "__main__":
    main()
