"""The archive: valid, and sound where validators do not look."""

import re
import subprocess
import sys
import zipfile
from collections.abc import Callable

import pytest
from conftest import PACKAGE, Archive, Device, program
from fmpy.validation import validate_fmu
from lxml import etree

SCENES = {
    "default": None,
    "one segment": "[design]\nsegments = 1\nbase_magnet = false",
    "cylinder": '[design]\nkind = "cylinder"\nlength_mm = 20.0\nradius_mm = 1.0\nshore_a = 33.0',
    "sources": "[design]\nsegments = 1\n[[magnet]]\n[[magnet]]\nposition_mm = [150.0, 0.0, 0.0]\n"
    "[[coil]]\nposition_mm = [0.0, 90.0, 0.0]\ninner_radius_mm = 20.0\nouter_radius_mm = 40.0\nlength_mm = 60.0\n"
    "turns = 600\ncurrent_a = 1.0\n[model]\nmutual_wrenches = true",
    "backbone": "[design]\nsegments = 2\n[design.backbone]\nouter_radius_mm = 0.7\ninner_radius_mm = 0.25\n"
    "shore_a = 50.0\npoisson = 0.4",
}


# What the command `fmutool` does; its exit code says nothing, so its words are read.
FMUTOOL = "from fmu_manipulation_toolbox.cli.fmutool import fmutool; fmutool()"

LIBRARY = "binaries/linux64/mcm.so"


def tree(archive: Archive) -> etree._Element:
    """The model description."""
    return etree.parse(archive.folder / "modelDescription.xml").getroot()


@pytest.mark.parametrize("name", SCENES)
def test_validator_finds_nothing(pack: Callable[..., Archive], name: str) -> None:
    assert validate_fmu(str(pack(SCENES[name]).path)) == []


@pytest.mark.parametrize("name", SCENES)
def test_schema_of_the_standard_is_kept(pack: Callable[..., Archive], name: str) -> None:
    schema = etree.XMLSchema(etree.parse(PACKAGE / "fmu" / "schema" / "fmi2ModelDescription.xsd"))
    description = etree.parse(pack(SCENES[name]).folder / "modelDescription.xml")
    schema.assertValid(description)
    description.getroot().find("CoSimulation").set("canFly", "true")
    assert not schema.validate(description)


@pytest.mark.parametrize("name", SCENES)
def test_terminals_are_what_has_inputs(pack: Callable[..., Archive], name: str) -> None:
    """Every input belongs to one terminal, beside the outputs of the same part."""
    archive = pack(SCENES[name])
    schema = etree.XMLSchema(etree.parse(PACKAGE / "fmu" / "schema" / "fmi3TerminalsAndIcons.xsd"))
    terminals = etree.parse(archive.folder / "terminalsAndIcons" / "terminalsAndIcons.xml")
    schema.assertValid(terminals)
    members = [member.attrib for member in terminals.iter("TerminalMemberVariable")]
    found = [member["variableName"] for member in members]
    assert len(found) == len(set(found))
    assert set(found) <= set(archive.variables)
    inputs = {name for name, variable in archive.variables.items() if variable.causality == "input"}
    assert inputs <= set(found)
    for terminal in terminals.iter("Terminal"):
        part = terminal.get("name")
        outputs = {
            n for n, v in archive.variables.items() if v.causality == "output" and n.startswith(f"{part}.")
        }
        mine = {member.get("variableName") for member in terminal}
        assert outputs <= mine and mine & inputs, part
        assert all(m.get("variableName") == f"{part}.{m.get('memberName')}" for m in terminal)


@pytest.mark.parametrize("name", SCENES)
def test_fmutool_finds_nothing(pack: Callable[..., Archive], name: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", FMUTOOL, "-input", pack(SCENES[name]).path, "-check"],
        capture_output=True,
        text=True,
        check=True,
    )
    said = done.stdout + done.stderr
    assert "This FMU seems to be compliant with FMI-2.0." in said
    assert "No semantic error" in said
    assert "ERROR" not in said and "WARNING" not in said


@pytest.mark.parametrize("name", SCENES)
def test_variables_are_grouped_on_the_page(pack: Callable[..., Archive], name: str) -> None:
    archive = pack(SCENES[name])
    page = (archive.folder / "documentation" / "index.html").read_text(encoding="utf-8")
    of_group = {}
    for block in page.split('<h3 id="')[1:]:
        group, title = re.match(r'(\w+)">(.*)</h3>', block).groups()
        assert title != group, "every group has a title"
        of_group[group] = re.findall(r"<td><code>(\w+)[^<]*</code></td>", block)
    assert all(set(first_words) == {group} for group, first_words in of_group.items())
    assert sum(map(len, of_group.values())) == len(archive.variables)


@pytest.mark.parametrize("name", SCENES)
def test_guid_fits_the_library(pack: Callable[..., Archive], name: str) -> None:
    device = Device(pack(SCENES[name])).start()
    assert device.status() == 0
    device.slave.freeInstance()


def test_library_is_named_after_the_model_identifier(default: Archive) -> None:
    (identifier,) = {
        tree(default).find(of).get("modelIdentifier") for of in ("ModelExchange", "CoSimulation")
    }
    with zipfile.ZipFile(default.path) as archive:
        libraries = [name for name in archive.namelist() if name.startswith("binaries/")]
    assert libraries == [f"binaries/linux64/{identifier}.so"]


def test_licences_of_all_linked_crates_are_inside(default: Archive) -> None:
    command = ["cargo", "tree", "--locked", "--edges", "normal", "--prefix", "none"]
    done = subprocess.run(command, cwd=PACKAGE, capture_output=True, text=True, check=True)
    crates = {" ".join(line.split()[:2]).replace(" v", " ") for line in done.stdout.splitlines() if line}
    crates = {crate for crate in crates if not crate.startswith("mcm ")}
    assert len(crates) > 50
    text = (default.folder / "documentation" / "licenses" / "crates.txt").read_text(encoding="utf-8")
    listed, *blocks = text.split("=" * 100)
    holders = {line for block in blocks for line in block.partition("-" * 100)[0].split("\n") if line}
    missing = {crate for crate in crates if crate not in holders or f"\n{crate}: " not in listed}
    assert not missing, "python3 fmu/licenses/collect.py writes them anew"


def test_serialisation_is_only_promised_with_saved_states(default: Archive) -> None:
    flags = tree(default).find("CoSimulation").attrib
    assert flags["canGetAndSetFMUstate"] == "true" or flags["canSerializeFMUstate"] == "false"


def test_unknowns_are_sorted(default: Archive) -> None:
    for group in tree(default).find("ModelStructure"):
        indices = [int(unknown.get("index")) for unknown in group]
        assert indices == sorted(set(indices))
        for unknown in group:
            known = [int(index) for index in unknown.get("dependencies").split()]
            assert known == sorted(set(known))


@pytest.mark.parametrize("name", SCENES)
def test_start_values_are_those_of_the_library(pack: Callable[..., Archive], name: str) -> None:
    device = Device(pack(SCENES[name]))
    device.slave.setupExperiment(startTime=0.0)
    device.slave.enterInitializationMode()
    read = {
        "Real": (device.slave.getReal, float),
        "Integer": (device.slave.getInteger, int),
        "Enumeration": (device.slave.getInteger, int),
        "Boolean": (device.slave.getBoolean, lambda text: text == "true"),
    }
    started = [v for v in device.archive.variables.values() if v.start is not None]
    assert len(started) > 50
    for variable in started:
        getter, parse = read[variable.type]
        assert getter([variable.valueReference])[0] == parse(variable.start), variable.name
    device.slave.freeInstance()


def test_only_the_functions_of_the_standard_are_exported(default: Archive) -> None:
    library = default.folder / LIBRARY
    listed = subprocess.run(
        ["nm", "-D", "--defined-only", library], capture_output=True, text=True, check=True
    )
    symbols = sorted(line.split()[-1] for line in listed.stdout.splitlines())
    headers = (PACKAGE / "fmu" / "headers" / "fmi2Functions.h").read_text()
    common = headers[headers.index("FMI2_Export fmi2GetTypesPlatformTYPE") :]
    promised = {
        line.split()[2].rstrip(";") for line in common.splitlines() if line.strip().startswith("FMI2_Export")
    }
    assert set(symbols) == promised
    assert len(symbols) == 44


@pytest.mark.parametrize("file", ["library", "program"])
def test_a_plain_build_loads_where_glibc_is_that_of_rhel_9(default: Archive, file: str) -> None:
    """The versions of the C library that it needs, as `fmu/portable` reads them."""
    path = default.folder / LIBRARY if file == "library" else program()
    read = ["readelf", "--wide", "--version-info", path]
    said = subprocess.run(read, capture_output=True, text=True, check=True).stdout
    needed = {tuple(map(int, found.split("."))) for found in re.findall(r"GLIBC_([0-9.]+)", said)}
    assert needed and max(needed) <= (2, 34), sorted(needed)


def test_terminals_can_be_left_out(pack: Callable[..., Archive], default: Archive) -> None:
    """Some versions of FMI Library refuse the file; the FMU is the same without."""
    bare = pack(None, "--no-terminals")
    with zipfile.ZipFile(bare.path) as archive:
        names = set(archive.namelist())
    with zipfile.ZipFile(default.path) as archive:
        left_out = set(archive.namelist()) - names
    assert left_out == {"terminalsAndIcons/terminalsAndIcons.xml", "terminalsAndIcons/icon.png"}
    assert bare.guid == default.guid
    assert validate_fmu(str(bare.path)) == []


def test_library_is_stripped(default: Archive) -> None:
    listed = subprocess.run(
        ["readelf", "--section-headers", "--wide", default.folder / LIBRARY],
        capture_output=True,
        text=True,
        check=True,
    )
    assert ".dynsym" in listed.stdout
    assert ".symtab" not in listed.stdout and ".debug" not in listed.stdout


def test_archive_is_plain_deflate_with_licences_and_documentation(default: Archive) -> None:
    with zipfile.ZipFile(default.path) as archive:
        assert archive.testzip() is None
        entries = archive.infolist()
        page = archive.read("documentation/index.html").decode()
    assert {entry.compress_type for entry in entries} <= {zipfile.ZIP_DEFLATED, zipfile.ZIP_STORED}
    assert all(entry.extract_version <= 20 and "\\" not in entry.filename for entry in entries)
    names = {entry.filename for entry in entries}
    assert "src=" not in page and "http" not in page, "the page stands alone"
    assert {"documentation/licenses/license.txt", "model.png", "resources/scene.toml"} <= names
    assert all(f"<code>{name}</code>" in page for name in default.variables)


def test_description_says_what_hosts_ask_for(default: Archive) -> None:
    root = tree(default)
    assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", root.get("generationDateAndTime"))
    for name in ("version", "copyright", "license", "generationTool", "author", "description"):
        assert root.get(name), name
    assert set(root.find("DefaultExperiment").attrib) == {"startTime", "stopTime", "stepSize", "tolerance"}
    units = {unit.get("name") for unit in root.find("UnitDefinitions")}
    types = {kind.get("name") for kind in root.find("TypeDefinitions")}
    for variable in root.find("ModelVariables"):
        (kind,) = variable
        assert variable.get("description")
        if kind.tag == "Real":
            assert kind.get("unit") in units and kind.get("declaredType") in types
    for items in root.iterfind("TypeDefinitions/SimpleType/Enumeration"):
        assert all(item.get("description") for item in items)


SHAFT = """[design]
segments = 2
[model]
interaction = "rings"
[feed]
mode = "insertion"
insertion_mm = 4.0
[feed.shaft]
outer_radius_mm = 0.75
inner_radius_mm = 0.25
elastic_modulus_mpa = 1.0
poisson = 0.45
"""


@pytest.mark.parametrize("scene", [None, SHAFT], ids=["clamped", "on a shaft"])
def test_dependencies_are_honest(pack: Callable[..., Archive], scene: str | None) -> None:
    """What the description calls independent has no derivative, and a constant factor is one."""
    archive = pack(scene)
    device = Device(archive).start()
    device.set({"field.uniform[1]": 0.002, "tip.load_force[3]": 0.001})
    variables = list(archive.variables.values())
    inputs = [v.name for v in variables if v.causality == "input"]
    outputs = [v.name for v in variables if v.causality == "output"]
    columns = {}
    for name in inputs:
        arguments = device.references(outputs), device.references([name]), [1.0]
        columns[name] = dict(zip(outputs, device.slave.getDirectionalDerivative(*arguments), strict=True))
    checked = constant = 0
    for unknown in tree(archive).find("ModelStructure/Outputs"):
        output = variables[int(unknown.get("index")) - 1].name
        known = [variables[int(index) - 1].name for index in unknown.get("dependencies").split()]
        kinds = dict(zip(known, (unknown.get("dependenciesKind") or "").split(), strict=False))
        for name in inputs:
            derivative = columns[name][output]
            if name not in known:
                checked += 1
                assert derivative == 0.0, (output, name)
            elif kinds.get(name) == "constant":
                # The clamp bears the force on a clamped ring; all other constant factors are those of places.
                factor = -1.0 if output.startswith("base.reaction_force") else 1.0
                assert derivative == pytest.approx(factor, abs=1e-12), (output, name)
                constant += 1
    # Of the first point, and of the centre and the clamp's force of the first ring, three each. On a shaft nothing is
    # clamped, and all outputs depend on all inputs.
    assert constant == (0 if scene else 9)
    assert (checked > 1000) == (scene is None)
    device.slave.freeInstance()


def test_the_shape_of_a_shaft_moves_with_the_insertion(pack: Callable[..., Archive]) -> None:
    """Its points stand at equal parts of a length that grows, and derivatives say so."""
    device = Device(pack(SHAFT)).start()
    outputs = [f"shape.arc_length[{k}]" for k in (1, 5, 21)] + [f"shape.position[{k},3]" for k in (5, 21)]
    arguments = device.references(outputs), device.references(["feed.insertion"]), [1.0]
    derivatives = device.slave.getDirectionalDerivative(*arguments)
    sides = []
    for insertion in (0.0039, 0.0041):
        device.set({"feed.insertion": insertion})
        sides.append(device.get(outputs))
    differences = [(after - before) / 0.0002 for before, after in zip(*sides, strict=True)]
    assert differences[1] == pytest.approx(0.2, abs=1e-9)
    assert derivatives == pytest.approx(differences, abs=1e-6)
    device.slave.freeInstance()


def test_checked_in_description_is_the_packed_one(default: Archive) -> None:
    packed = (default.folder / "modelDescription.xml").read_text()
    kept = (PACKAGE / "modelDescription" / "modelDescription.xml").read_text()
    date = tree(default).get("generationDateAndTime")
    assert packed.replace(f' generationDateAndTime="{date}"', "") == kept
