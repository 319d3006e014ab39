"""What the pages of the project show: blocks between fences, and commands between backticks."""

import re
import shlex
from dataclasses import dataclass
from pathlib import Path

from conftest import PACKAGE

FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
BACKTICKS = re.compile(r"`([^`]+)`")
RUN_BY = {".py": "python", ".c": "c"}


@dataclass(frozen=True)
class Block:
    """A block between fences: its page, the line of its fence, its language and what is in it."""

    page: Path
    line: int
    language: str
    text: str

    def __str__(self) -> str:
        """Where it is."""
        return f"{self.page.relative_to(PACKAGE)}:{self.line}"


@dataclass(frozen=True)
class Command:
    """A command line of a page, and whether it stands in a block of its own."""

    page: Path
    line: int
    text: str
    in_block: bool

    def __str__(self) -> str:
        """Where it is, and what."""
        return f"{self.page.relative_to(PACKAGE)}:{self.line}: {self.text}"

    def words(self) -> list[str]:
        """Its words as a shell takes them, without comment, variables and the marks of what is optional."""
        text = re.sub(r"\[(--.*?)\](?= |$)", r"\1", self.text)
        words = shlex.split(text, comments=True)
        while words and re.match(r"[A-Z_]+=", words[0]):
            words.pop(0)
        return words


def pages() -> list[Path]:
    """The first page, and all pages below `src`, `fmu` and `tests`, but those of packages that others bring."""
    below = [path for folder in ("src", "fmu", "tests") for path in sorted((PACKAGE / folder).rglob("*.md"))]
    return [PACKAGE / "README.md", *(path for path in below if "node_modules" not in path.parts)]


def line(text: str, place: int) -> int:
    """The number of the line at a place of a text."""
    return text.count("\n", 0, place) + 1


def blocks(page: Path) -> list[Block]:
    """All blocks of a page."""
    text = page.read_text()
    found = [Block(page, line(text, m.start()), m[1], m[2]) for m in FENCE.finditer(text)]
    assert len(found) * 2 == len(re.findall(r"^ *```", text, re.MULTILINE)), (
        f"{page}: fences are not in pairs"
    )
    return found


def lines_of(block: Block) -> list[Command]:
    """The command lines of a block; what a backslash ends goes on in the next line."""
    out, number = [], block.line + 1
    for text in re.split(r"(?<!\\)\n", block.text):
        if text.strip() and not text.lstrip().startswith("#"):
            out.append(Command(block.page, number, re.sub(r"\\\n\s*", "", text), in_block=True))
        number += text.count("\n") + 1
    return out


def is_command(text: str) -> bool:
    """Whether words between backticks are a command or a file of the project, and not a name, a formula or a value."""
    words = text.split()
    while words and re.match(r"[A-Z_]+=", words[0]):
        words.pop(0)
    if not words or words[1:2] == ["="]:
        return False
    first = words[0]
    return (
        first in ("mcm", "cargo", "npm", ".venv/bin/python")
        or re.match(r"(fmu|tests|src|modelDescription)/\S", first) is not None
        or (Path(first).suffix in RUN_BY and len(Path(first).stem) > 1)
    )


def between_backticks(page: Path) -> list[Command]:
    """The commands in the prose and the tables of a page."""
    text = FENCE.sub(lambda fenced: "\n" * fenced[0].count("\n"), page.read_text())
    return [
        Command(page, line(text, m.start()), " ".join(m[1].split()), in_block=False)
        for m in BACKTICKS.finditer(text)
        if is_command(m[1])
    ]


def commands(page: Path) -> list[Command]:
    """All commands of a page."""
    in_blocks = [command for block in blocks(page) if block.language == "bash" for command in lines_of(block)]
    return in_blocks + between_backticks(page)


def table(page: Path, header: str) -> list[list[str]]:
    """The cells of the only table of a page whose header begins so, without that header."""
    tables = re.findall(r"^(\|.*\n)\|[ |-]*\n((?:\|.*\n)+)", page.read_text(), re.MULTILINE)
    found = [rows for head, rows in tables if head.startswith(header)]
    assert len(found) == 1, f"{page}: {len(found)} tables begin with {header}"
    return [[cell.strip() for cell in row.strip("|").split(" | ")] for row in found[0].splitlines()]
