/** The trail of the device: the inputs at which it was solved since it was loaded, and the rows of it that a link or a scene carries. */

import { type Answer, type Description, Status, type WayRow } from "../protocol";
import { scalesOf } from "../way";
import { same } from "./session";

/** The most rows that a scene's way can have. */
export const MOST_ROWS = 200;

/** The most points that are kept; beyond that, those on nearly straight ways are left out. */
const MOST_POINTS = 4_000;

/** Where the device was. */
export class Trail {
    private points: Float64Array[] = [];

    /** Takes an answer by the model asked for. */
    take(answer: Answer, description: Description): void {
        if (!answer.final || answer.measured) {
            return;
        }
        if (answer.first) {
            this.points = [];
        }
        const last = this.points.at(-1);
        if (answer.status !== Status.NotSolved && (last === undefined || !same(last, answer.inputs))) {
            this.points.push(answer.inputs);
        }
        if (this.points.length > MOST_POINTS) {
            this.points = thinned(this.points, description, MOST_POINTS / 2);
        }
    }

    /** Points of the way to these inputs, without these, at most so many; none where the device was loaded there. */
    to(inputs: Float64Array, description: Description, most: number): Float64Array[] {
        const before = this.points.filter((point, place) => place === 0 || !same(point, inputs));
        const way = thinned([...before, inputs], description, most + 1).slice(0, -1);
        return way.length === 1 && same(way[0]!, inputs) ? [] : way;
    }
}

/** Points by name: the inputs that differ anywhere from those at the end, orientations whole. */
export function rowsOf(points: Float64Array[], end: Float64Array, description: Description): WayRow[] {
    const groups = description.inputs.map(({ name }) => name.replace(/(\.orientation)\[\d\]$/, "$1"));
    const moved = new Set(groups.filter((_, place) => points.some((point) => point[place] !== end[place])));
    return points.map((point) => {
        const kept = description.inputs.map(({ name }, place) => [name, point[place]!] as const);
        return Object.fromEntries(kept.filter((_, place) => moved.has(groups[place]!)));
    });
}

/** Rows as a scene's text has them. */
export function textOf(rows: WayRow[]): string {
    const table = (row: WayRow) =>
        Object.entries(row).map(([name, value]) => `"${name}" = ${written(value)}\n`);
    return rows.map((row) => `\n[[start.way]]\n${table(row).join("")}`).join("");
}

/** A number as TOML writes it. */
function written(value: number): string {
    return Object.is(value, -0) ? "-0.0" : String(value);
}

/**
 * The ends and those points between them that deviate most from the straight way between their neighbours, at most so many: U. Ramer,
 * Comput. Graph. Image Process. 1 (1972) 244, in the order of deviations. What deviates by less than the way of a moving device may is left out.
 */
function thinned(points: Float64Array[], description: Description, most: number): Float64Array[] {
    const scales = scalesOf(description.inputs);
    const moving = scales.map((_, k) => k).filter((k) => points.some((point) => point[k] !== points[0]![k]));
    const aside = (from: number, at: number, to: number): number => {
        const [a, b, c] = [points[from]!, points[at]!, points[to]!];
        let [along, length] = [0, 0];
        for (const k of moving) {
            along += scales[k]! ** 2 * (c[k]! - a[k]!) * (b[k]! - a[k]!);
            length += (scales[k]! * (c[k]! - a[k]!)) ** 2;
        }
        const part = length > 0 ? Math.min(Math.max(along / length, 0), 1) : 0;
        return moving.reduce((sum, k) => {
            return sum + (scales[k]! * (b[k]! - a[k]! - part * (c[k]! - a[k]!))) ** 2;
        }, 0);
    };
    const furthest = (from: number, to: number): Piece => {
        let [at, deviation] = [from, 0];
        for (let between = from + 1; between < to; between += 1) {
            const found = aside(from, between, to);
            [at, deviation] = found > deviation ? [between, found] : [at, deviation];
        }
        return { from, to, at, deviation };
    };
    const kept = new Set([0, points.length - 1]);
    const pieces = [furthest(0, points.length - 1)];
    while (kept.size < most) {
        pieces.sort((a, b) => a.deviation - b.deviation);
        const worst = pieces.pop();
        if (worst === undefined || worst.deviation < 1) {
            break;
        }
        kept.add(worst.at);
        pieces.push(furthest(worst.from, worst.at), furthest(worst.at, worst.to));
    }
    return points.filter((_, place) => kept.has(place));
}

/** A piece of a way, and the point of it that deviates most. */
interface Piece {
    from: number;
    to: number;
    at: number;
    deviation: number;
}
