import { type BufferGeometry, Group, Mesh, MeshStandardMaterial, type Object3D } from "three";
import { GLTFExporter } from "three/examples/jsm/exporters/GLTFExporter.js";
import { MM } from "./shape";

/** Objects of the scene as binary glTF, in metres. What is hidden or empty is left out. */
export async function binaryGltf(objects: readonly Object3D[]): Promise<Blob> {
    const root = new Group();
    root.name = "manipulator";
    for (const object of objects) {
        object.updateMatrixWorld(true);
        object.traverseVisible((one) => {
            if (one instanceof Mesh) root.add(inMetres(one));
        });
    }
    const data = await new GLTFExporter().parseAsync(root, { binary: true });
    root.traverse((one) => {
        if (one instanceof Mesh) (one.geometry as BufferGeometry).dispose();
    });
    if (!(data instanceof ArrayBuffer)) throw new Error("The 3-D model could not be written.");
    return new Blob([data], { type: "model/gltf-binary" });
}

/** A copy in the world's frame. */
function inMetres(mesh: Mesh): Mesh {
    const geometry = (mesh.geometry as BufferGeometry).clone();
    geometry.deleteAttribute("glow");
    geometry.applyMatrix4(mesh.matrixWorld).scale(1 / MM, 1 / MM, 1 / MM);
    const copy = new Mesh(geometry, plain(mesh));
    copy.name = mesh.name;
    return copy;
}

/** The material without what only this page's shaders know. */
function plain(mesh: Mesh): Mesh["material"] {
    const { material } = mesh;
    if (!(material instanceof MeshStandardMaterial)) return material;
    const { metalness, roughness, color, vertexColors, map } = material;
    return new MeshStandardMaterial({ metalness, roughness, color, vertexColors, map });
}
