"""CITATION.cff is in the citation file format 1.2.0, and says of software and paper what the project says elsewhere."""

import re
import tomllib

import jsonschema
import pytest
import yaml
from conftest import PACKAGE

TEXT = {"type": "string", "minLength": 1}
PERSON = {
    "type": "object",
    "required": ["family-names", "given-names"],
    "properties": dict.fromkeys(("family-names", "given-names", "name-particle", "affiliation"), TEXT)
    | {"orcid": {"type": "string", "pattern": r"^https://orcid\.org/[0-9]{4}(-[0-9]{4}){2}-[0-9]{3}[0-9X]$"}},
    "additionalProperties": False,
}
ENTITY = {
    "type": "object",
    "required": ["name"],
    "properties": {"name": TEXT, "website": TEXT},
    "additionalProperties": False,
}
AUTHORS = {"type": "array", "minItems": 1, "uniqueItems": True, "items": {"anyOf": [PERSON, ENTITY]}}
DOI = {"type": "string", "pattern": r"^10\.\d{4,9}(\.\d+)?/[A-Za-z0-9:/_;\-\.\(\)\[\]\\]+$"}

# Of the format (https://doi.org/10.5281/zenodo.5171937) what the file uses; other keys are faults here.
ARTICLE = {
    "type": "object",
    "required": ["authors", "title", "type", "journal", "year", "doi"],
    "properties": {
        "type": {"const": "article"},
        "title": TEXT,
        "authors": AUTHORS,
        "journal": TEXT,
        "year": {"type": "integer"},
        "volume": {"type": ["integer", "string"]},
        "start": {"type": ["integer", "string"]},
        "doi": DOI,
    },
    "additionalProperties": False,
}
FORMAT = {
    "type": "object",
    "required": ["cff-version", "message", "title", "authors"],
    "properties": {
        "cff-version": {"const": "1.2.0"},
        "message": TEXT,
        "type": {"enum": ["software", "dataset"]},
        "title": TEXT,
        "abstract": TEXT,
        "authors": AUTHORS,
        "version": {"type": ["string", "number"]},
        "license": TEXT,
        "keywords": {"type": "array", "minItems": 1, "items": TEXT},
        "preferred-citation": ARTICLE,
    },
    "additionalProperties": False,
}


@pytest.fixture
def citation() -> dict:
    """The file."""
    return yaml.safe_load((PACKAGE / "CITATION.cff").read_text())


def test_it_is_in_the_format(citation: dict) -> None:
    jsonschema.validate(citation, FORMAT)
    for key in ("title", "authors", "message"):
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate({name: value for name, value in citation.items() if name != key}, FORMAT)


def test_the_software_is_the_package(citation: dict) -> None:
    package = tomllib.loads((PACKAGE / "Cargo.toml").read_text())["package"]
    assert (citation["version"], citation["license"]) == (package["version"], package["license"])
    assert citation["title"].startswith(f"{package['name']}: ")


def test_the_paper_is_that_of_the_first_page(citation: dict) -> None:
    page = " ".join((PACKAGE / "README.md").read_text().split())
    paper = citation["preferred-citation"]
    names = ", ".join(f"{author['given-names']} {author['family-names']}" for author in paper["authors"])
    place = rf"{paper['journal']} {paper['volume']} ({paper['year']}), {paper['start']}"
    said = f"{names}, [*{paper['title']}*](https://doi.org/{paper['doi']}), {place}"
    assert re.search(re.escape(said), page), said
