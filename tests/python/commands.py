"""Whether a command of a page exists: its program, subcommand and options, or its script and the files it names."""

import functools
import itertools
import re
from collections.abc import Iterator
from pathlib import Path

from cargo_commands import cargo_faults, unknown
from conftest import PACKAGE, run
from markdown_pages import Command

# Words of a page that stand for what the reader puts there.
PLACEHOLDER = re.compile(r"[A-Z][A-Z_.a-z]*$")

# Folders in which a page may name a script by its name alone.
SCRIPTS = ["fmu/examples", "fmu", "tests/bench", "tests/python", "tests/charts"]

# Scripts that hand their options on to another program.
HANDS_ON = ["tests/hostile/fuzz/run"]


@functools.cache
def help_of(subcommand: str | None) -> str:
    """What `mcm` or a subcommand says of itself."""
    done = run(*([subcommand] if subcommand else []), "--help")
    return done.stdout if done.returncode == 0 else ""


def mcm_faults(words: list[str]) -> Iterator[str]:
    """What is wrong with a call of `mcm`."""
    subcommand = words[0] if words and not words[0].startswith("-") else None
    help_ = help_of(subcommand)
    if not help_:
        yield f"mcm has no subcommand {subcommand}"
        return
    yield from unknown(words, help_, f"mcm {subcommand or ''}".strip())
    for word, choice in itertools.pairwise(words):
        if word not in ("study", "--vessel") or choice.startswith("-") or PLACEHOLDER.match(choice):
            continue
        if not re.search(rf"^ +- {re.escape(choice)}:", help_, re.MULTILINE):
            yield f"mcm {subcommand} does not know {choice}"


@functools.cache
def source(path: Path) -> str:
    """The text of a program, and of the modules beside it that a Python program imports."""
    text = path.read_text()
    if path.suffix == ".py":
        for name in re.findall(r"^(?:from|import) (\w+)", text, re.MULTILINE):
            beside = path.parent / f"{name}.py"
            text += beside.read_text() if beside.exists() else ""
    return text


def script(name: str, page: Path) -> Path | None:
    """The file of a script that a page names: from the package's folder, from the page's, or by its name alone."""
    for folder in [PACKAGE, page.parent, *(PACKAGE / folder for folder in SCRIPTS)]:
        found = sorted(folder.glob(name)) if "*" in name else [folder / name]
        if found and found[0].exists():
            return found[0]
    return None


def script_faults(words: list[str], page: Path) -> Iterator[str]:
    """What is wrong with a call of a script, or with the name of a file or folder."""
    name, *arguments = words
    path = script(name, page)
    if path is None:
        yield f"there is no {name}"
        return
    if arguments:
        text = source(path)
        if "__main__" not in text and not text.startswith("#!"):
            yield f"{name} is no program"
        if name not in HANDS_ON:
            yield from unknown(arguments, text, name)
    for word in arguments:
        of_project = re.match(r"(fmu|tests|src)/\S+\.(txt|py|toml|csv|json)$", word)
        if of_project and not (PACKAGE / word).exists():
            yield f"there is no {word}"


def python_faults(words: list[str], page: Path) -> Iterator[str]:
    """What is wrong with a call of Python."""
    if words[:2] != ["-m", "pytest"]:
        yield from script_faults(words, page)
        return
    for word in words[2:]:
        if not word.startswith("-") and not (PACKAGE / word.partition("::")[0]).exists():
            yield f"there is no {word}"


def npm_faults(words: list[str], page: Path) -> Iterator[str]:
    """What is wrong with a call of npm, which is said of the page's folder."""
    package = page.parent / "package.json"
    if words[:1] != ["run"] or not package.exists() or f'"{words[1]}":' not in package.read_text():
        yield f"{package} has no script {' '.join(words)}"


def faults(command: Command) -> list[str]:
    """What is wrong with a command; nothing if it exists."""
    first, *words = command.words()
    if first in ("mcm", "target/release/mcm"):
        found = mcm_faults(words)
    elif first == "cargo":
        found = cargo_faults(words)
    elif first == ".venv/bin/python":
        found = python_faults(words, command.page)
    elif first == "npm":
        found = npm_faults(words, command.page)
    else:
        found = script_faults([first, *words], command.page)
    return [f"{command}: {fault}" for fault in found]
