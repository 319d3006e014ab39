/** The way of inputs that a device has still to follow. */

import type { Variable } from "./protocol";

/** Deviation from a straight way, by unit, below which a point between two others is left out. */
const NEGLIGIBLE: Record<string, number> = {
    m: 1e-3,
    T: 5e-4,
    N: 2e-4,
    "N.m": 2e-6,
    rad: 0.02,
    "T/m": 1e-3,
    "1": 0.01,
};

/** Factors by which inputs are measured in such deviations. */
export function scalesOf(inputs: Variable[]): number[] {
    return inputs.map((input) => 1 / (NEGLIGIBLE[input.unit] ?? 1e-3));
}

/** The most points that wait; beyond that the oldest ones are left out. */
const MOST = 500;

/** Points that wait in order. Points on a nearly straight way are merged, so that the way does not grow while a hand moves fast. */
export class Way {
    private points: Float64Array[] = [];
    /** Points that were left out since the last but one point that waits. */
    private leftOut: Float64Array[] = [];
    private readonly scales: number[];

    constructor(inputs: Variable[]) {
        this.scales = scalesOf(inputs);
    }

    get length(): number {
        return this.points.length;
    }

    /** Adds a point at the end; where `every` is set, none is left out for it. */
    push(point: Float64Array, every: boolean): void {
        const [from, last] = this.points.slice(-2);
        if (!every && from !== undefined && last !== undefined) {
            const between = [...this.leftOut, last];
            if (between.every((passed) => this.isBetween(from, passed, point))) {
                this.points.pop();
                this.leftOut = between;
            } else {
                this.leftOut = [];
            }
        }
        this.points.push(point);
        if (this.points.length > MOST && !every) {
            this.points.splice(1, this.points.length - MOST);
        }
    }

    /** Takes the first point. */
    shift(): Float64Array | undefined {
        if (this.points.length <= 2) {
            this.leftOut = [];
        }
        return this.points.shift();
    }

    clear(): void {
        this.points = [];
        this.leftOut = [];
    }

    /** Whether `passed` lies nearly on the straight way between two points. */
    private isBetween(from: Float64Array, passed: Float64Array, to: Float64Array): boolean {
        let along = 0;
        let length = 0;
        this.scales.forEach((scale, k) => {
            const [way, gone] = [scale * (to[k]! - from[k]!), scale * (passed[k]! - from[k]!)];
            along += way * gone;
            length += way * way;
        });
        const fraction = length > 0 ? Math.min(Math.max(along / length, 0), 1) : 0;
        const aside = this.scales.reduce((sum, scale, k) => {
            const distance = scale * (passed[k]! - from[k]! - fraction * (to[k]! - from[k]!));
            return sum + distance * distance;
        }, 0);
        return aside < 1;
    }
}
