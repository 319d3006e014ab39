import { type Description, Places, startOf } from "../protocol";

/** Places of three numbers that belong together. */
export type Triple = readonly [number, number, number];

/**
 * Where the view finds what it draws in the arrays of an answer. Names are looked up once for each description, so that a frame
 * costs no strings. What a device does not have is at the place -1, which reads as not a number.
 */
export class ValuePlaces {
    private readonly places: Places;

    constructor(private readonly description: Description) {
        this.places = new Places(description);
    }

    /** Place of an input. */
    input(name: string): number {
        return this.places.input(name) ?? -1;
    }

    /** Place of an output. */
    output(name: string): number {
        return this.places.outputPlace(name) ?? -1;
    }

    /** Places of the inputs `name[1]`, `name[2]`, `name[3]`. */
    inputVector(name: string): Triple {
        return [this.input(`${name}[1]`), this.input(`${name}[2]`), this.input(`${name}[3]`)];
    }

    /** Places of the inputs `name[1]` to `name[4]`, a quaternion. */
    inputQuaternion(name: string): readonly [number, number, number, number] {
        return [...this.inputVector(name), this.input(`${name}[4]`)];
    }

    /** Places of the outputs `name[1]`, `name[2]`, `name[3]`. */
    outputVector(name: string): Triple {
        return [this.output(`${name}[1]`), this.output(`${name}[2]`), this.output(`${name}[3]`)];
    }

    /** Inputs at the start. */
    start(): Float64Array {
        return startOf(this.description);
    }
}

/** The value at a place; not a number where there is none. */
export function valueAt(values: ArrayLike<number>, place: number): number {
    return values[place] ?? NaN;
}

/** The vector at three places. */
export function vectorAt(values: ArrayLike<number>, places: Triple): [number, number, number] {
    return [valueAt(values, places[0]), valueAt(values, places[1]), valueAt(values, places[2])];
}
