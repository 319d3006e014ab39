import type { Source } from "../protocol";
import type { Triple, ValuePlaces } from "./places";

/** Places of a source's pose and strength among the inputs. */
export class SourcePlaces {
    readonly position: Triple;
    readonly orientation: readonly [number, number, number, number];
    readonly strength: number;

    constructor(places: ValuePlaces, { name, coil }: Pick<Source, "name" | "coil">) {
        this.position = places.inputVector(`${name}.position`);
        this.orientation = places.inputQuaternion(`${name}.orientation`);
        this.strength = places.input(`${name}.${coil ? "current" : "strength"}`);
    }
}
