import { Vector3 } from "three";
import type { Description, Part } from "../protocol";
import { type Triple, type ValuePlaces, valueAt, vectorAt } from "./places";
import { orientationAt } from "./shape";
import { SourcePlaces } from "./source_places";

/** A dipole in a magnet or coil: its place, m, and its moment times mu0 / 4 pi, T m3, where the strength is 1; in the world. */
interface Dipole {
    readonly place: Vector3;
    readonly moment: Vector3;
}

/** A magnet or coil as dipoles, where and as strong as the last inputs said. */
class DipoleSource {
    readonly dipoles: readonly Dipole[];
    factor = 0;

    constructor(
        private readonly parts: readonly Part[],
        private readonly places: SourcePlaces,
    ) {
        this.dipoles = parts.map(() => ({ place: new Vector3(), moment: new Vector3() }));
    }

    read(inputs: Float64Array): void {
        const centre = new Vector3(...vectorAt(inputs, this.places.position));
        const turn = orientationAt(inputs, this.places.orientation);
        for (const [k, { offset, remanence, volume }] of this.parts.entries()) {
            const { place, moment } = this.dipoles[k] as Dipole;
            place.set(0, 0, offset).applyQuaternion(turn).add(centre);
            moment
                .set(...remanence)
                .multiplyScalar(volume / (4 * Math.PI))
                .applyQuaternion(turn);
        }
        this.factor = valueAt(inputs, this.places.strength) || 0;
    }
}

/**
 * The field around the device as point dipoles tell it: one for each part of a magnet and for each coil, and the uniform field with
 * its gradient. Good enough for the direction and relative length of an arrow; the core computes with the exact fields.
 */
export class DipoleField {
    private readonly sources: DipoleSource[];
    private readonly uniform: Triple;
    private readonly gradient: readonly number[];
    private readonly distance = new Vector3();
    private readonly constant = new Vector3();
    private slopes = [0, 0, 0, 0, 0];

    constructor(description: Description, places: ValuePlaces) {
        const first = { name: "magnet", coil: false, parts: description.magnet };
        this.sources = [first, ...description.further].map((source) => {
            return new DipoleSource(source.parts, new SourcePlaces(places, source));
        });
        this.uniform = places.inputVector("field.uniform");
        this.gradient = [1, 2, 3, 4, 5].map((k) => places.input(`field.gradient[${k}]`));
    }

    /** Takes the poses of magnets and coils and the uniform field from inputs. */
    read(inputs: Float64Array): void {
        for (const source of this.sources) source.read(inputs);
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
        for (const { dipoles, factor } of this.sources) {
            for (const { place, moment } of factor === 0 ? [] : dipoles) {
                const { distance } = this;
                distance.set(x, y, z).sub(place);
                const square = distance.lengthSq();
                const size = factor / (square * Math.sqrt(square));
                field
                    .addScaledVector(distance, (3 * size * moment.dot(distance)) / square)
                    .addScaledVector(moment, -size);
            }
        }
        return field.toArray();
    }
}
