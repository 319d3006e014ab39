/** Which way leads a new device of a scene to where the device of the page is. */

import { type Core, Refusal } from "./core";
import { type Carried, type Description, Places, type Request } from "./protocol";

/** Number of the device that tries, beside those of the schedule. */
const TRIED = 2;

/** Largest distance of two shapes of one branch, m: several times the tolerance of the model, and far less than branches lie apart. */
export const SAME_BRANCH = 2e-4;

/** Tries the ways in turn until one leads to the same shape. */
export function carried(core: Core, grid: Uint8Array, asked: Request & { kind: "carry" }): Carried {
    let [found, apart] = [0, NaN];
    for (const [number, { text }] of asked.ways.entries()) {
        [found, apart] = [number, distance(core, grid, asked, text)];
        if (apart <= SAME_BRANCH) {
            break;
        }
    }
    core.close(TRIED);
    const points = asked.ways[found]?.points ?? [];
    return { way: found, apart, scene: core.sceneAt(0, asked.inputs, points) };
}

/** How far the shape to which this way leads is from the one wanted, m; not a number where there is none. */
function distance(core: Core, grid: Uint8Array, asked: Request & { kind: "carry" }, text: string): number {
    try {
        const description = core.open(TRIED, asked.scene + text, grid);
        const { solved, outputs } = core.load(TRIED, asked.inputs);
        return solved ? apart(description, outputs, asked.outputs) : NaN;
    } catch (error) {
        if (error instanceof Refusal) {
            return NaN;
        }
        throw error;
    }
}

function apart(description: Description, one: Float64Array, other: Float64Array): number {
    const places = new Places(description);
    const points = Array.from({ length: description.shapePoints }, (_, point) => {
        const at = [1, 2, 3].map((k) => places.outputPlace(`shape.position[${point + 1},${k}]`) ?? -1);
        return Math.hypot(...at.map((place) => (one[place] ?? NaN) - (other[place] ?? NaN)));
    });
    return Math.max(...points);
}
