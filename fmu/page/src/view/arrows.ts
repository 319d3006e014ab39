import {
    type Color,
    ConeGeometry,
    CylinderGeometry,
    DynamicDrawUsage,
    Group,
    InstancedMesh,
    Matrix4,
    MeshLambertMaterial,
    Quaternion,
    Vector3,
} from "three";
import type { Description } from "../protocol";
import type { Vector } from "./centreline";
import { MM } from "./shape";

/** Length that no arrow exceeds, mm. */
const LONGEST = 25;

/** Arrows shorter than this part of the longest are not drawn: their values are as good as nothing. */
const SHORTEST = 0.032;

/** Size of arrows beside a device: those of a short one must not dwarf it. */
export function arrowSize(description: Description): number {
    const last = description.bodies.at(-1);
    return last ? Math.min(1, Math.max(0.2, (1.4 * MM * (last.begin + last.length)) / LONGEST)) : 1;
}

/** Arrows of one colour. Their lengths grow with the root of the value, so that small ones are still seen, and saturate. */
export class Arrows {
    readonly group = new Group();
    private readonly stems: InstancedMesh;
    private readonly heads: InstancedMesh;
    private count = 0;
    private readonly matrix = new Matrix4();
    private readonly turn = new Quaternion();
    private readonly way = new Vector3();
    private readonly from = new Vector3();
    private readonly size = new Vector3();

    /** At most `capacity` arrows; one of the value `typical` has seven tenths of the greatest length, which `scale` makes smaller. */
    constructor(
        capacity: number,
        colour: Color,
        private readonly typical: number,
        private readonly scale: number,
        private readonly thickness = 1,
    ) {
        const material = new MeshLambertMaterial({
            color: colour,
            emissive: colour,
            emissiveIntensity: 0.35,
        });
        // Both stand on their bases, with unit height and radius.
        this.stems = new InstancedMesh(
            new CylinderGeometry(1, 1, 1, 12).translate(0, 0.5, 0),
            material,
            capacity,
        );
        this.heads = new InstancedMesh(new ConeGeometry(1, 1, 20).translate(0, 0.5, 0), material, capacity);
        for (const mesh of [this.stems, this.heads]) {
            mesh.instanceMatrix.setUsage(DynamicDrawUsage);
            mesh.frustumCulled = false;
            mesh.count = 0;
            this.group.add(mesh);
        }
    }

    /** Takes all arrows away. */
    clear(): void {
        this.count = 0;
        this.stems.count = this.heads.count = 0;
    }

    /** Draws a value at a place, mm. What is not a number, or tiny, is not drawn. */
    add(place: Vector, value: Vector): void {
        const size = Math.hypot(...value);
        const longest = this.scale * LONGEST;
        const length = longest * Math.sqrt(size / (size + this.typical));
        if (!(length >= SHORTEST * longest) || !Number.isFinite(place[0] + place[1] + place[2])) return;
        if (this.count >= this.stems.instanceMatrix.count) return;
        const head = Math.min(3.6 * this.scale * this.thickness, 0.45 * length);
        const stem = 0.16 * head;
        this.way.set(...value).divideScalar(size);
        this.from.set(...place);
        this.turn.setFromUnitVectors(UP, this.way);
        this.size.set(stem, length - head, stem);
        this.stems.setMatrixAt(this.count, this.matrix.compose(this.from, this.turn, this.size));
        this.from.addScaledVector(this.way, length - head);
        this.size.set(0.36 * head, head, 0.36 * head);
        this.heads.setMatrixAt(this.count, this.matrix.compose(this.from, this.turn, this.size));
        this.stems.count = this.heads.count = ++this.count;
        this.stems.instanceMatrix.needsUpdate = true;
        this.heads.instanceMatrix.needsUpdate = true;
    }

    /** Frees what the graphics card holds. */
    dispose(): void {
        for (const mesh of [this.stems, this.heads]) {
            mesh.geometry.dispose();
            mesh.dispose();
        }
        (this.stems.material as MeshLambertMaterial).dispose();
    }
}

const UP = new Vector3(0, 1, 0);
