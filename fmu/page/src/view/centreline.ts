/** Numbers of a frame among samples: position, first, second and third director. */
export const FRAME = 12;

/** Least distance between nodes, mm of arc length: differences between nearer ones would be noise. */
export const NODE_DISTANCE = 0.01;

/** A unit vector or place, mm. */
export type Vector = readonly [number, number, number];

/**
 * The centreline as cubic Hermite pieces between nodes, with a frame carried along it, in mm.
 *
 * Frames begin with the base's first director and are transported parallel: they turn about nothing but the bending. Torsion of the
 * device is small beside its bending, is not among the outputs along the arc length, and is not drawn.
 */
export class Centreline {
    private count = 0;
    private readonly arc: Float64Array;
    private readonly position: Float64Array;
    private readonly tangent: Float64Array;
    private readonly first: Float64Array;
    private readonly directed: Uint8Array;
    /** Position, unit tangent and first director at the place asked for last. */
    private readonly here = new Float64Array(9);

    constructor(capacity: number) {
        this.arc = new Float64Array(capacity);
        this.position = new Float64Array(3 * capacity);
        this.tangent = new Float64Array(3 * capacity);
        this.first = new Float64Array(3 * capacity);
        this.directed = new Uint8Array(capacity);
    }

    /** Arc length of the last node; not a number without nodes. */
    get end(): number {
        return this.arc[this.count - 1] ?? NaN;
    }

    /** Takes all nodes away. */
    clear(): void {
        this.count = 0;
    }

    /** Adds a node, unless it is hardly behind the last one. Its tangent is the one given, or found from the nodes beside it. */
    add(arc: number, position: Vector, tangent?: Vector): void {
        if (this.count > 0 && arc < this.end + NODE_DISTANCE) return;
        const k = this.count++;
        this.arc[k] = arc;
        this.position.set(position, 3 * k);
        this.directed[k] = tangent ? 1 : 0;
        if (tangent) this.tangent.set(tangent, 3 * k);
    }

    /** Finds the tangents that were not given and carries the first director along; false where a number is missing. */
    finish(first: Vector): boolean {
        const { count, here } = this;
        if (count < 2) return false;
        for (let k = 0; k < count; k++) {
            if (!this.directed[k]) this.differentiate(k);
        }
        this.first.set(first, 0);
        for (let k = 1; k < count; k++) {
            this.turn(k - 1, this.tangent[3 * k]!, this.tangent[3 * k + 1]!, this.tangent[3 * k + 2]!);
            for (let i = 0; i < 3; i++) this.first[3 * k + i] = here[6 + i]!;
        }
        // A number that is missing anywhere comes through to the end by the frames, or by the last place.
        let sum = 0;
        for (let i = 0; i < 3 * count; i++) sum += this.position[i]! + this.first[i]!;
        return Number.isFinite(sum);
    }

    /**
     * Writes the frames at arc lengths `offset + scale * stations[i]`, which must ascend. Before the first node and behind the last
     * one the centreline goes on straight.
     */
    sample(stations: ArrayLike<number>, offset: number, scale: number, frames: Float32Array): void {
        const { arc, here } = this;
        let k = 0;
        for (let i = 0, f = 0; i < stations.length; i++, f += FRAME) {
            const s = offset + scale * stations[i]!;
            while (k < this.count - 2 && s > arc[k + 1]!) k++;
            this.interpolate(k, s);
            const [tx, ty, tz] = [here[3]!, here[4]!, here[5]!];
            const [ax, ay, az] = [here[6]!, here[7]!, here[8]!];
            frames[f] = here[0]!;
            frames[f + 1] = here[1]!;
            frames[f + 2] = here[2]!;
            frames[f + 3] = ax;
            frames[f + 4] = ay;
            frames[f + 5] = az;
            frames[f + 6] = ty * az - tz * ay;
            frames[f + 7] = tz * ax - tx * az;
            frames[f + 8] = tx * ay - ty * ax;
            frames[f + 9] = tx;
            frames[f + 10] = ty;
            frames[f + 11] = tz;
        }
    }

    /** Tangent at a node from the parabola through it and its neighbours, or from the line through two. */
    private differentiate(k: number): void {
        const last = this.count - 1;
        const middle = Math.max(1, Math.min(k, last - 1));
        const [a, b, c] = [middle - 1, middle, Math.min(middle + 1, last)];
        const [s, sa, sb, sc] = [this.arc[k]!, this.arc[a]!, this.arc[b]!, this.arc[c]!];
        for (let i = 0; i < 3; i++) {
            const [pa, pb, pc] = [
                this.position[3 * a + i]!,
                this.position[3 * b + i]!,
                this.position[3 * c + i]!,
            ];
            const slope = (pb - pa) / (sb - sa);
            const bend = c === b ? 0 : ((pc - pb) / (sc - sb) - slope) / (sc - sa);
            this.tangent[3 * k + i] = slope + bend * (2 * s - sa - sb);
        }
    }

    /** Finds position, tangent and first director at an arc length on the piece behind node `k`, or straight on from its ends. */
    private interpolate(k: number, s: number): void {
        const { here, position, tangent } = this;
        const from = this.arc[k]!;
        const length = this.arc[k + 1]! - from;
        const u = (s - from) / length;
        const p = 3 * k;
        if (u < 0 || u > 1) {
            const end = u < 0 ? p : p + 3;
            const beyond = u < 0 ? s - from : s - from - length;
            for (let i = 0; i < 3; i++) {
                here[i] = position[end + i]! + beyond * tangent[end + i]!;
                here[3 + i] = tangent[end + i]!;
            }
        } else {
            const v = 1 - u;
            const p0 = (1 + 2 * u) * v * v;
            const t0 = u * v * v * length;
            const t1 = -u * u * v * length;
            const d = (6 * u * v) / length;
            const d0 = v * (1 - 3 * u);
            const d1 = u * (3 * u - 2);
            for (let i = 0; i < 3; i++) {
                const a = position[p + i]!;
                const b = position[p + 3 + i]!;
                const ta = tangent[p + i]!;
                const tb = tangent[p + 3 + i]!;
                here[i] = p0 * a + t0 * ta + (1 - p0) * b + t1 * tb;
                here[3 + i] = d * (b - a) + d0 * ta + d1 * tb;
            }
        }
        this.turn(k, here[3]!, here[4]!, here[5]!);
    }

    /** Turns the first director of node `k` by the smallest rotation onto the direction given, and keeps both. */
    private turn(k: number, x: number, y: number, z: number): void {
        const { here, tangent, first } = this;
        const p = 3 * k;
        const size = 1 / Math.sqrt(x * x + y * y + z * z);
        let [bx, by, bz] = [tangent[p]!, tangent[p + 1]!, tangent[p + 2]!];
        const unit = 1 / Math.sqrt(bx * bx + by * by + bz * bz);
        bx = bx * unit + x * size;
        by = by * unit + y * size;
        bz = bz * unit + z * size;
        const ax = first[p]!;
        const ay = first[p + 1]!;
        const az = first[p + 2]!;
        // |b + t|^2 / 2 is 1 + b.t of the unit vectors.
        const factor = (2 * size * (ax * x + ay * y + az * z)) / (bx * bx + by * by + bz * bz);
        here[3] = x * size;
        here[4] = y * size;
        here[5] = z * size;
        here[6] = ax - factor * bx;
        here[7] = ay - factor * by;
        here[8] = az - factor * bz;
    }
}
