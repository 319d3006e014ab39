"""Writes the coupling of `coupling.py` as a System Structure and Parameterization archive (SSP 1.0).

    .venv/bin/python fmu/examples/make_ssp.py mcm.fmu arm.fmu --out coupling.ssp

Connectors are those of the components only, since ecos knows none of the system. The communication step stands in the
annotation of OMSimulator, as SSP has no word for it.
"""

import argparse
import zipfile
from pathlib import Path

import coupling
from lxml import etree

SSP = "http://ssp-standard.org/SSP1"
SSD = f"{{{SSP}/SystemStructureDescription}}"
SSC = f"{{{SSP}/SystemStructureCommon}}"
OMS_SCHEMA = "https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd"
OMS = f"{{{OMS_SCHEMA}}}"


def ports(component: str) -> dict[str, str]:
    """The connected variables of a component and their kind."""
    outputs = [source for source, _ in coupling.CONNECTIONS] + coupling.RECORDED
    inputs = [sink for _, sink in coupling.CONNECTIONS]
    kinds = [(port, "output") for port in outputs] + [(port, "input") for port in inputs]
    return {variable: kind for (name, variable), kind in kinds if name == component}


def description() -> bytes:
    """`SystemStructure.ssd`."""
    root = etree.Element(
        f"{SSD}SystemStructureDescription",
        nsmap={"ssd": SSD[1:-1], "ssc": SSC[1:-1], "oms": OMS[1:-1]},
        name="coupling",
        version="1.0",
    )
    system = etree.SubElement(root, f"{SSD}System", name="coupling")
    elements = etree.SubElement(system, f"{SSD}Elements")
    for name in ("mcm", "arm"):
        component = etree.SubElement(
            elements,
            f"{SSD}Component",
            name=name,
            type="application/x-fmu-sharedlibrary",
            source=f"resources/{name}.fmu",
        )
        connectors = etree.SubElement(component, f"{SSD}Connectors")
        for variable, kind in ports(name).items():
            connector = etree.SubElement(connectors, f"{SSD}Connector", name=variable, kind=kind)
            etree.SubElement(connector, f"{SSC}Real")
    connections = etree.SubElement(system, f"{SSD}Connections")
    for (start, output), (end, input_) in coupling.CONNECTIONS:
        etree.SubElement(
            connections,
            f"{SSD}Connection",
            startElement=start,
            startConnector=output,
            endElement=end,
            endConnector=input_,
        )
    annotations = etree.SubElement(system, f"{SSD}Annotations")
    annotation = etree.SubElement(annotations, f"{SSC}Annotation", type="org.openmodelica")
    information = etree.SubElement(
        etree.SubElement(annotation, f"{OMS}Annotations"), f"{OMS}SimulationInformation"
    )
    etree.SubElement(
        information,
        f"{OMS}FixedStepMaster",
        description="oms-ma",
        stepSize=repr(coupling.STEP),
        absoluteTolerance="1e-4",
        relativeTolerance="1e-4",
    )
    stop = repr(coupling.STEP * coupling.STEPS)
    etree.SubElement(root, f"{SSD}DefaultExperiment", startTime="0.0", stopTime=stop)
    return etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True)


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("mcm", type=Path, help="the manipulator's FMU, as `mcm pack` writes it")
    parser.add_argument("arm", type=Path, help="the arm's FMU, as `pack_arm.py` writes it")
    parser.add_argument("--out", type=Path, default=Path("coupling.ssp"), help="the archive to write")
    arguments = parser.parse_args()
    with zipfile.ZipFile(arguments.out, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("SystemStructure.ssd", description())
        archive.write(arguments.mcm, "resources/mcm.fmu")
        archive.write(arguments.arm, "resources/arm.fmu")
    print(f"wrote {arguments.out}")


if __name__ == "__main__":
    main()
