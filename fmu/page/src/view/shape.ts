import { Quaternion, Vector3 } from "three";
import type { Answer, Description } from "../protocol";
import { Centreline, FRAME, NODE_DISTANCE, type Vector } from "./centreline";
import { type Triple, ValuePlaces, valueAt, vectorAt } from "./places";

/** mm in a metre: the scene is in mm, the protocol in m. */
export const MM = 1000;

/** Parts of the device's length at which its outline is told. */
const OUTLINE = Array.from({ length: 41 }, (_, k) => k / 40);

/** A ring as the outputs tell it: its faces on the arc length from the device's base, mm, and places of its centre and axis. */
interface RigidPlace {
    begin: number;
    length: number;
    position: Triple;
    axis: Triple;
}

/**
 * Reads the centreline from an answer. Rings are rigid and their poses are outputs, so that both faces of each are nodes with known
 * tangents; points of the shape fill in between. Base and tip have known tangents, too.
 */
export class ShapeReader {
    readonly centreline: Centreline;
    /** Arc length of the device's base, mm: the length of shaft inside the port. */
    base = 0;
    /** Length of the device, mm. */
    readonly length: number;
    private readonly arcs: number[];
    private readonly points: Triple[];
    private readonly rings: RigidPlace[] = [];
    private readonly feed: number;
    private readonly roll: number;
    private readonly port: Triple;
    private readonly orientation: readonly [number, number, number, number];
    private readonly tip: Triple;
    private readonly tipOrientation: readonly [number, number, number, number];

    constructor(description: Description, places: ValuePlaces) {
        const numbers = Array.from({ length: description.shapePoints }, (_, k) => k + 1);
        this.arcs = numbers.map((k) => places.output(`shape.arc_length[${k}]`));
        this.points = numbers.map((k) => {
            const component = (i: number) => places.output(`shape.position[${k},${i}]`);
            return [component(1), component(2), component(3)];
        });
        for (const body of description.bodies.filter((body) => body.kind === "ring")) {
            const name = `ring[${this.rings.length + 1}]`;
            this.rings.push({
                begin: MM * body.begin,
                length: MM * body.length,
                position: places.outputVector(`${name}.position`),
                axis: places.outputVector(`${name}.axis`),
            });
        }
        const last = description.bodies.at(-1);
        this.length = last ? MM * (last.begin + last.length) : 0;
        this.feed = description.shaft ? places.output("feed.length") : -1;
        this.roll = places.input("feed.roll");
        this.port = places.inputVector("base.position");
        this.orientation = places.inputQuaternion("base.orientation");
        this.tip = places.outputVector("tip.position");
        const tip = [1, 2, 3, 4].map((k) => places.output(`tip.orientation[${k}]`));
        this.tipOrientation = tip as [number, number, number, number];
        this.centreline = new Centreline(this.points.length + 2 * this.rings.length + 2);
    }

    /** Takes the shape of an answer; false where it has none, and then the centreline means nothing. */
    read(answer: Answer): boolean {
        const { inputs, outputs } = answer;
        const { centreline, rings } = this;
        this.base = this.feed < 0 ? 0 : MM * valueAt(outputs, this.feed);
        if (!Number.isFinite(this.base)) return false;
        centreline.clear();
        const base = orientationAt(inputs, this.orientation);
        centreline.add(0, scaled(vectorAt(inputs, this.port)), director(base, 0, 0, 1));
        let point = 0;
        for (const ring of rings) {
            const begin = this.base + ring.begin;
            const axis = vectorAt(outputs, ring.axis);
            const centre = scaled(vectorAt(outputs, ring.position));
            if (!Number.isFinite(axis[0] + centre[0])) continue;
            point = this.fill(outputs, point, begin - NODE_DISTANCE);
            centreline.add(begin, along(centre, axis, -ring.length / 2), axis);
            centreline.add(begin + ring.length, along(centre, axis, ring.length / 2), axis);
        }
        const end = this.base + this.length;
        this.fill(outputs, point, end - NODE_DISTANCE);
        const tip = director(orientationAt(outputs, this.tipOrientation), 0, 0, 1);
        centreline.add(end, scaled(vectorAt(outputs, this.tip)), tip);
        const roll = valueAt(inputs, this.roll);
        return centreline.finish(director(base, Math.cos(roll || 0), Math.sin(roll || 0), 0));
    }

    /** The straight device, as it is clamped or held in the port: what is known before the first answer. */
    straight(inputs: Float64Array): Vector3[] {
        const from = new Vector3(...scaled(vectorAt(inputs, this.port)));
        const axis = new Vector3(...director(orientationAt(inputs, this.orientation), 0, 0, 1));
        return [from, from.clone().addScaledVector(axis, this.length)];
    }

    /** Places along the device of the shape that was read. */
    outline(): Vector3[] {
        const frames = new Float32Array(OUTLINE.length * FRAME);
        this.centreline.sample(OUTLINE, this.base, this.length, frames);
        return OUTLINE.map((_, k) => new Vector3().fromArray(frames, k * FRAME));
    }

    /** Adds the points of the shape before an arc length; returns the number of the next one. */
    private fill(outputs: Float64Array, from: number, before: number): number {
        let point = from;
        for (; point < this.points.length; point++) {
            const arc = MM * valueAt(outputs, this.arcs[point]!);
            if (!(arc < before)) break;
            this.centreline.add(arc, scaled(vectorAt(outputs, this.points[point]!)));
        }
        return point;
    }
}

/** The rotation at four places, scalar first. */
export function orientationAt(values: ArrayLike<number>, places: readonly number[]): Quaternion {
    const [w, x, y, z] = places.map((place) => valueAt(values, place)) as [number, number, number, number];
    return new Quaternion(x, y, z, w).normalize();
}

/** A place in mm. */
export function scaled(metres: Vector): [number, number, number] {
    return [MM * metres[0], MM * metres[1], MM * metres[2]];
}

/** A vector of the body, seen in the world. */
function director(orientation: Quaternion, x: number, y: number, z: number): [number, number, number] {
    return new Vector3(x, y, z).applyQuaternion(orientation).toArray();
}

function along(from: Vector, axis: Vector, distance: number): [number, number, number] {
    return [from[0] + distance * axis[0], from[1] + distance * axis[1], from[2] + distance * axis[2]];
}
