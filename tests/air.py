#!/usr/bin/env python3
"""Counts long functions without air: 25 lines or more, and neither a blank line nor a comment inside.

    tests/air.py            the share in each room of `src`, and in all of them
    tests/air.py --list     also which functions these are

A blank line separates the steps of a function, and a comment says why one is there. This counts; it is no limit.
"""

import argparse
import re
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent / "src"

# Lines from which on a function counts as long.
LONG = 25

# What braces must not be counted in: comments, raw strings, strings, characters (a lifetime has no closing quote).
LITERALS = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/)
    |b?r(?P<fence>\#*)".*?"(?P=fence)
    |b?"(?:\\.|[^"\\])*"
    |b?'(?:\\u\{[0-9a-fA-F]+\}|\\x[0-9a-fA-F]{2}|\\.|[^\\'\n])'""",
    re.VERBOSE | re.DOTALL,
)

COMMENT = "\x00"


@dataclass
class Function:
    """A function: where it begins, its lines, and whether a blank line or a comment is among them."""

    path: Path
    line: int
    name: str
    lines: int
    has_air: bool


def code(text: str) -> str:
    """The text line by line with marks in place of comments, and nothing that looks like code in its strings."""

    def plain(found: re.Match) -> str:
        mark = COMMENT if found["comment"] else "_"
        return "\n".join(mark for _ in found[0].split("\n"))

    return LITERALS.sub(plain, text)


def end_of(text: str, start: int, opening: str, closing: str) -> int:
    """The place after the bracket that closes the one at `start`."""
    depth = 0
    for place in range(start, len(text)):
        depth += (text[place] in opening) - (text[place] in closing)
        if depth == 0:
            return place + 1
    raise ValueError(f"a bracket is not closed: {text[start : start + 60]}")


def body_of(text: str, place: int) -> int | None:
    """Where the body begins of the function whose signature goes on at `place`; nothing if it is only declared."""
    while text[place] not in "{;":
        place = end_of(text, place, "([", ")]") if text[place] in "([" else place + 1
    return place if text[place] == "{" else None


def functions(path: Path) -> Iterator[Function]:
    """All functions of a file that have a body, also those within others."""
    text = code(path.read_text())
    for found in re.finditer(r"\bfn\s+(\w+)", text):
        body = body_of(text, found.end())
        if body is None:
            continue
        inside = text[body : end_of(text, body, "{", "}")]
        line = text.count("\n", 0, found.start()) + 1
        lines = text.count("\n", found.start(), body) + inside.count("\n") + 1
        has_air = COMMENT in inside or any(not row.strip() for row in inside.split("\n"))
        yield Function(path, line, found[1], lines, has_air)


def main() -> None:
    """Prints the table of rooms, and the list if asked for."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--list", action="store_true", help="also print the functions")
    listed = parser.parse_args().list

    rooms = defaultdict(list)
    for path in sorted(SOURCE.rglob("*.rs")):
        for one in functions(path):
            if one.lines >= LONG:
                rooms[path.relative_to(SOURCE).parts[0]].append(one)
    rooms["all"] = [one for found in list(rooms.values()) for one in found]

    print(f"{'room':16} {'long':>5} {'airless':>8}   share")
    for room, found in rooms.items():
        airless = [one for one in found if not one.has_air]
        print(f"{room:16} {len(found):5} {len(airless):8} {100 * len(airless) / len(found):5.1f} %")
        if listed and room != "all":
            for one in airless:
                print(f"    {one.path.relative_to(SOURCE.parent)}:{one.line} {one.name}, {one.lines} lines")


if __name__ == "__main__":
    main()
