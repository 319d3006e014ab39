import { Quaternion, Vector3 } from "three";
import type { Cylinder, Description } from "../protocol";
import { type Triple, type ValuePlaces, valueAt, vectorAt } from "./places";
import { orientationAt } from "./shape";

/** A dipole on the magnet's axis: its place, m, and its moment times mu0 / 4 pi, T m3. */
interface Dipole {
    offset: number;
    strength: number;
}

/**
 * The field around the device as point dipoles tell it: one for each cylinder of the magnet, and the uniform field with its gradient.
 * Good enough for the direction and relative length of an arrow; the core computes with the exact field of the cylinders.
 */
export class DipoleField {
    private readonly dipoles: Dipole[];
    private readonly position: Triple;
    private readonly orientation: readonly number[];
    private readonly strength: number;
    private readonly uniform: Triple;
    private readonly gradient: readonly number[];
    private readonly centre = new Vector3();
    private readonly axis = new Vector3();
    private readonly distance = new Vector3();
    private readonly constant = new Vector3();
    private factor = 0;
    private slopes = [0, 0, 0, 0, 0];

    constructor(description: Description, places: ValuePlaces) {
        this.dipoles = description.magnet.map((cylinder) => ({
            offset: cylinder.offset,
            strength: (cylinder.remanence * volume(cylinder)) / (4 * Math.PI),
        }));
        this.position = places.inputVector("magnet.position");
        this.orientation = places.inputQuaternion("magnet.orientation");
        this.strength = places.input("magnet.strength");
        this.uniform = places.inputVector("field.uniform");
        this.gradient = [1, 2, 3, 4, 5].map((k) => places.input(`field.gradient[${k}]`));
    }

    /** Takes the magnet's pose and the uniform field from inputs. */
    read(inputs: Float64Array): void {
        this.centre.set(...vectorAt(inputs, this.position));
        const turn: Quaternion = orientationAt(inputs, this.orientation);
        this.axis.set(0, 0, 1).applyQuaternion(turn);
        this.factor = this.dipoles.length > 0 ? valueAt(inputs, this.strength) || 0 : 0;
        const [x, y, z] = vectorAt(inputs, this.uniform);
        this.constant.set(x || 0, y || 0, z || 0);
        this.slopes = this.gradient.map((place) => valueAt(inputs, place) || 0);
    }

    /** The field at a place, m; T. */
    at(x: number, y: number, z: number): [number, number, number] {
        const [xx, xy, xz, yy, yz] = this.slopes as [number, number, number, number, number];
        const field = new Vector3(
            this.constant.x + xx * x + xy * y + xz * z,
            this.constant.y + xy * x + yy * y + yz * z,
            this.constant.z + xz * x + yz * y - (xx + yy) * z,
        );
        for (const dipole of this.factor === 0 ? [] : this.dipoles) {
            const { axis, distance } = this;
            distance.set(x, y, z).sub(this.centre).addScaledVector(axis, -dipole.offset);
            const square = distance.lengthSq();
            const size = (this.factor * dipole.strength) / (square * Math.sqrt(square));
            field
                .addScaledVector(distance, (3 * size * axis.dot(distance)) / square)
                .addScaledVector(axis, -size);
        }
        return field.toArray();
    }
}

function volume(cylinder: Cylinder): number {
    return Math.PI * (cylinder.outerRadius ** 2 - cylinder.innerRadius ** 2) * cylinder.length;
}
