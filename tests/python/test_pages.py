"""The pages are true: every block runs or is checked, what it is said to print is printed, and every command exists."""

import re
from pathlib import Path

import pytest
from commands import faults
from conftest import PACKAGE
from markdown_pages import Block, Command, blocks, commands, lines_of, pages
from scratch import Scratch

LANGUAGES = {"bash", "python", "toml", "rust", "text"}

# Command lines of blocks that are only checked for what they name, with the reason; by how they begin.
NOT_RUN = {
    "fmu/venv": "tests/check runs it before these tests",
    "cargo build": "tests/check runs it before these tests",
    "cargo test": "tests/check runs all tests",
    "cargo install": "compiles everything once more",
    "fmu/demo": "a minute; tests/python/test_pass.py has its parts",
    "tests/check": "runs these tests",
    "mcm study": "half a minute; tests/cli/study.rs runs it",
    ".venv/bin/python fmu/examples/pack_arm.py": "compiles the partner; tests/python/test_examples.py runs it",
    ".venv/bin/python fmu/examples/coupled_": "needs the partner; tests/python/test_examples.py runs it",
}

ids = [str(page.relative_to(PACKAGE)) for page in pages()]
every_page = pytest.mark.parametrize("page", pages(), ids=ids)


def reason_not_to_run(command: Command) -> str | None:
    """Why a command line is not run; nothing if it is."""
    return next((begin for begin in NOT_RUN if command.text.startswith(begin)), None)


def shows(printed: str, block: Block) -> bool:
    """Whether the lines of a block are printed, in this order; `...` stands for any lines."""
    rest = (line.rstrip() for line in printed.splitlines())
    return all(line.rstrip() in rest for line in block.text.splitlines() if line != "...")


@every_page
def test_blocks_are_of_known_languages(page: Path) -> None:
    for block in blocks(page):
        assert block.language in LANGUAGES, f"{block}: nothing checks a block of `{block.language}`"


@every_page
def test_command_lines_run_and_print_what_the_page_shows(page: Path, tmp_path: Path) -> None:
    scratch = Scratch(page, tmp_path)
    printed: list[str] = []
    for block in blocks(page):
        if block.language == "bash":
            printed = []
            for command in lines_of(block):
                if reason_not_to_run(command):
                    continue
                scratch.bring(command)
                done = scratch.run(command.text)
                assert done.returncode == 0, f"{command}\n{done.stdout}{done.stderr}"
                printed.append(done.stdout)
        elif block.language == "python":
            done = scratch.python(block.text)
            assert done.returncode == 0, f"{block}\n{done.stdout}{done.stderr}"
            printed = [done.stdout]
        elif block.language == "text":
            assert any(shows(output, block) for output in printed), (
                f"{block} shows\n{block.text}\nand printed is\n" + "\n".join(printed)
            )


@every_page
def test_scenes_are_solved(page: Path, tmp_path: Path) -> None:
    scratch = Scratch(page, tmp_path)
    for block in blocks(page):
        if block.language == "toml":
            done = scratch.solve(block.text)
            assert done.returncode == 0, f"{block}\n{done.stdout}{done.stderr}"


@every_page
def test_commands_exist(page: Path) -> None:
    found = [fault for command in commands(page) for fault in faults(command)]
    assert not found, "\n".join(found)


def test_picture_of_the_fit_is_that_of_its_page(tmp_path: Path) -> None:
    page = PACKAGE / "src" / "fit" / "README.md"
    scratch = Scratch(page, tmp_path)
    fit = lines_of(blocks(page)[0])[0]
    scratch.bring(fit)
    assert scratch.run(fit.text).returncode == 0
    drawn, kept = ((folder / "fit.svg").read_text() for folder in (tmp_path, PACKAGE / "tests" / "charts"))
    # Coordinates differ by what the end of a solve leaves.
    number = re.compile(r"\d+(\.\d+)?")
    assert number.sub("0", drawn) == number.sub("0", kept)


def test_rust_of_every_page_is_a_doctest() -> None:
    library = PACKAGE / "src" / "lib.rs"
    included = re.findall(r'^#\[doc = include_str!\("(.*)"\)\]$', library.read_text(), re.MULTILINE)
    tested = {(library.parent / name).resolve() for name in included}
    shown = {block.page for page in pages() for block in blocks(page) if block.language == "rust"}
    assert shown == tested


def test_every_reason_not_to_run_a_line_is_needed() -> None:
    lines = [
        line
        for page in pages()
        for block in blocks(page)
        if block.language == "bash"
        for line in lines_of(block)
    ]
    used = {reason_not_to_run(line) for line in lines}
    assert used - {None} == set(NOT_RUN)
    assert sum(reason_not_to_run(line) is None for line in lines) > 20


@pytest.mark.parametrize(
    "text",
    [
        "mcm solv scene.toml",
        "mcm solve scene.toml --jason",
        "mcm study fig6 --out figures",
        "mcm init --vessel vein",
        "cargo tests",
        "cargo test --release --test mcm no_such_test",
        "cargo test --test mcm -- --capture-none",
        "cargo run --release --example shapes",
        "cargo run --release --example fit coverages 1000",
        "cargo bench --bench solve -- targets",
        "fmu/demonstration",
        "fmu/live --scenes scene.toml",
        "fmu/venv tests/requirement.txt",
        ".venv/bin/python fmu/examples/push_in.py aorta.fmu --upto 150",
        ".venv/bin/python -m pytest tests/python/test_example.py",
        "push_out.py mcm.fmu",
        "npm run check",
    ],
)
def test_a_command_that_does_not_exist_is_seen(text: str) -> None:
    assert len(faults(Command(PACKAGE / "README.md", 1, text, in_block=False))) == 1


def test_lines_that_are_not_printed_are_seen() -> None:
    page = PACKAGE / "README.md"
    printed = "one\ntwo\nthree\n"
    for text, shown in [("one\n...\nthree\n", True), ("three\none\n", False), ("tw\n", False)]:
        assert shows(printed, Block(page, 1, "text", text)) is shown
