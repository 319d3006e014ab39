/** The way that inputs have gone of late, and how far on it the device snaps. */

import type { Variable } from "../protocol";
import { distanceToFold, type Passed } from "./fold";

/** A fold ahead. */
export interface Ahead {
    margin: number;
    /** How far the inputs may still go. */
    distance: number;
    unit: string;
}

/** Inputs that move together, their unit in the page, and how many of these an SI unit is. */
interface Measure {
    inputs: string;
    unit: string;
    factor: number;
}

const MEASURES: Measure[] = [
    { inputs: "magnet.position", unit: "mm", factor: 1e3 },
    { inputs: "magnet.orientation", unit: "deg", factor: 360 / Math.PI }, // a quaternion changes by half the angle
    { inputs: "magnet.strength", unit: "% of the magnet's strength", factor: 1e2 },
    { inputs: "field.uniform", unit: "mT", factor: 1e3 },
    { inputs: "feed.insertion", unit: "mm of insertion", factor: 1e3 },
    { inputs: "feed.roll", unit: "deg of roll", factor: 180 / Math.PI },
    { inputs: "feed.force", unit: "mN of push", factor: 1e3 },
    { inputs: "guidewire.insertion", unit: "mm of guidewire", factor: 1e3 },
    { inputs: "tip.load_force", unit: "mN on the tip", factor: 1e3 },
];

/** Least way between shapes that are compared: the margins of closer ones differ too little. */
const SPACING = 0.5;

/** Cosine between steps below which the way has turned, so that what was before says nothing of it. */
const STRAIGHT = 0.5;

/** Farther away than this, nothing is said. */
const FARTHEST = 100;

interface Shape extends Passed {
    inputs: Float64Array;
}

/** Follows one model's answers. */
export class Approach {
    private shapes: Shape[] = [];
    private step: number[] = [];
    private measure: Measure | null = null;
    private ahead: Ahead | null = null;
    private readonly factors: number[];
    private readonly measures: (Measure | null)[];

    constructor(inputs: Variable[]) {
        this.measures = inputs.map(
            ({ name }) => MEASURES.find((measure) => name.startsWith(measure.inputs)) ?? null,
        );
        this.factors = this.measures.map((measure) => measure?.factor ?? 0);
    }

    /** Forgets the way: the device has snapped or was not solved. */
    clear(): void {
        this.shapes = [];
        this.step = [];
        this.ahead = null;
    }

    /** Notes a solved shape; the fold that lies ahead, if one is foretold. */
    add(inputs: Float64Array, margin: number): Ahead | null {
        const last = this.shapes.at(-1);
        if (last === undefined) {
            this.shapes = [{ inputs, margin, gone: 0 }];
            return null;
        }
        const step = this.factors.map((factor, place) => factor * (inputs[place]! - last.inputs[place]!));
        const [measure, length] = this.longest(step);
        if (length < SPACING) {
            return this.ahead;
        }
        if (measure !== this.measure || cosine(step, this.step) < STRAIGHT) {
            this.shapes = [last];
        }
        this.shapes = [...this.shapes.slice(-2), { inputs, margin, gone: last.gone + length }];
        [this.step, this.measure] = [step, measure];
        const distance = distanceToFold(this.shapes);
        const told = distance !== null && distance < FARTHEST && measure !== null;
        this.ahead = told ? { margin, distance, unit: measure.unit } : null;
        return this.ahead;
    }

    /** What has moved most, and how far. */
    private longest(step: number[]): [Measure | null, number] {
        let longest: [Measure | null, number] = [null, 0];
        for (const measure of MEASURES) {
            const length = Math.hypot(...step.filter((_, place) => this.measures[place] === measure));
            if (length > longest[1]) {
                longest = [measure, length];
            }
        }
        return longest;
    }
}

function cosine(one: number[], other: number[]): number {
    const product = one.reduce((sum, value, place) => sum + value * (other[place] ?? 0), 0);
    return product / (Math.hypot(...one) * Math.hypot(...other) || 1);
}

/** A fold ahead in words. */
export function inWords({ margin, distance, unit }: Ahead): string {
    return `Margin ${margin.toFixed(2)}: snaps within about ${Number(distance.toPrecision(2))} ${unit} on this way.`;
}
