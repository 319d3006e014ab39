"""Whether a call of cargo exists: its subcommand and options, its target, and what a filter or an argument names."""

import functools
import itertools
import re
import subprocess
import tomllib
from collections.abc import Iterator
from pathlib import Path

from conftest import PACKAGE

OPTION = re.compile(r"(?<![\w-])--?[a-zA-Z][\w-]*")

# Subcommands that are programs of their own, with the script that calls them.
CALLED_BY = {"fuzz": "tests/hostile/fuzz/run"}


def unknown(options: list[str], known: str, where: str) -> Iterator[str]:
    """Options that do not stand in a text."""
    for option in (word.partition("=")[0] for word in options if word.startswith("-") and word != "--"):
        if not re.match(r"-\d", option) and option not in OPTION.findall(known):
            yield f"{where} has no option {option}"


@functools.cache
def help_of(subcommand: str) -> str:
    """What cargo says of a subcommand."""
    done = subprocess.run(["cargo", subcommand, "-h"], capture_output=True, text=True, check=False)
    return done.stdout if done.returncode == 0 else ""


@functools.cache
def targets() -> dict[str, dict[str, Path]]:
    """Benches, examples and tests of the package, with their files."""
    manifest = tomllib.loads((PACKAGE / "Cargo.toml").read_text())
    return {
        kind: {target["name"]: PACKAGE / target["path"] for target in manifest[kind]}
        for kind in ("bench", "example", "test")
    }


@functools.cache
def listed(*options: str) -> subprocess.CompletedProcess[str]:
    """The test program's list of tests, asked for with these options too; it is built as `tests/check` builds it."""
    command = ["cargo", "test", "--quiet", "--locked", "--release", "--test", "mcm", "--", "--list", *options]
    return subprocess.run(command, cwd=PACKAGE, capture_output=True, text=True, check=False)


def names_of_tests() -> list[str]:
    """All tests of the test program."""
    names = re.findall(r"^(\S+): test$", listed().stdout, re.MULTILINE)
    assert len(names) > 100, listed().stderr
    return names


def without_values(words: list[str], help_: str) -> list[str]:
    """The words that are neither options nor their values."""
    takes_value = {word for word in words if re.search(rf"{re.escape(word)} \[?<", help_)}
    return [
        word
        for before, word in zip(["", *words], words, strict=False)
        if not word.startswith("-") and before not in takes_value
    ]


def unknown_to(target: Path, words: list[str]) -> Iterator[str]:
    """Words that an example or a bench does not know: arguments, and parts of names of benches. Numbers are free."""
    said = " ".join(re.findall(r'"([^"\n]*)"', target.read_text()))
    for word in " ".join(words).split():
        if not re.fullmatch(r"[\d.]+", word) and word not in said:
            yield f"{target.relative_to(PACKAGE)} does not know {word}"


def cargo_faults(words: list[str]) -> Iterator[str]:
    """What is wrong with a call of cargo."""
    subcommand, *rest = words
    if subcommand in CALLED_BY:
        script = (PACKAGE / CALLED_BY[subcommand]).read_text()
        if not re.search(rf"cargo (\+\w+ )?{subcommand}", script):
            yield f"{CALLED_BY[subcommand]} does not call cargo {subcommand}"
        return
    help_ = help_of(subcommand)
    if not help_:
        yield f"cargo has no subcommand {subcommand}"
        return
    split = rest.index("--") if "--" in rest else len(rest)
    own, handed_on = rest[:split], rest[split + 1 :]
    yield from unknown(own, help_, f"cargo {subcommand}")
    named = [
        (kind, name)
        for kind in targets()
        for option, name in itertools.pairwise(own)
        if option == f"--{kind}"
    ]
    lost = [f"there is no {kind} {name}" for kind, name in named if name not in targets()[kind]]
    yield from lost
    filters = without_values(own, help_) + [word for word in handed_on if not word.startswith("-")]
    if subcommand == "test":
        for option in (word for word in handed_on if word.startswith("-")):
            if listed(option).returncode != 0:
                yield f"a test program has no option {option}"
        for part in filters:
            if not any(part in test for test in names_of_tests()):
                yield f"no test has {part} in its name"
    elif not lost:
        for kind, name in named:
            yield from unknown_to(targets()[kind][name], filters)
