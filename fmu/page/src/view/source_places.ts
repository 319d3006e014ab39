import type { Triple, ValuePlaces } from "./places";

/** Places of a source's pose and strength among the inputs. */
export class SourcePlaces {
    readonly position: Triple;
    readonly orientation: readonly [number, number, number, number];
    readonly strength: number;

    /** `name` begins the names of its inputs, and `strength` is the last word of that for its strength or current. */
    constructor(places: ValuePlaces, name: string, strength: "strength" | "current") {
        this.position = places.inputVector(`${name}.position`);
        this.orientation = places.inputQuaternion(`${name}.orientation`);
        this.strength = places.input(`${name}.${strength}`);
    }
}
