import { type Color, DynamicDrawUsage, InstancedInterleavedBuffer, InterleavedBufferAttribute } from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import type { Vector } from "./centreline";

/** Pieces that are kept; then new ones take the place of the oldest. */
const PIECES = 8192;

/** The tip must move by this before a piece is added, mm. */
const STEP = 0.1;

/** The line that the tip has gone. */
export class Trace {
    readonly line: LineSegments2;
    private readonly places = new Float32Array(6 * PIECES);
    private readonly buffer = new InstancedInterleavedBuffer(this.places, 6, 1);
    private last: Vector | null = null;
    private count = 0;

    constructor(colour: Color) {
        const geometry = new LineSegmentsGeometry();
        this.buffer.setUsage(DynamicDrawUsage);
        geometry.setAttribute("instanceStart", new InterleavedBufferAttribute(this.buffer, 3, 0));
        geometry.setAttribute("instanceEnd", new InterleavedBufferAttribute(this.buffer, 3, 3));
        geometry.instanceCount = 0;
        this.line = new LineSegments2(geometry, new LineMaterial({ color: colour.getHex(), linewidth: 2.2 }));
        this.line.frustumCulled = false;
        this.line.visible = false;
    }

    /** Goes on to a place, mm. */
    add(place: Vector): void {
        if (!Number.isFinite(place[0] + place[1] + place[2])) return;
        const { last } = this;
        if (!last) {
            this.last = place;
            return;
        }
        if (Math.hypot(place[0] - last[0], place[1] - last[1], place[2] - last[2]) < STEP) return;
        this.places.set([...last, ...place], 6 * (this.count % PIECES));
        this.buffer.needsUpdate = true;
        this.count++;
        this.line.geometry.instanceCount = Math.min(this.count, PIECES);
        this.last = place;
    }

    /** Lifts the pen: the next place is not joined with the last one. */
    lift(): void {
        this.last = null;
    }

    /** Takes the line away. */
    clear(): void {
        this.lift();
        this.count = 0;
        this.line.geometry.instanceCount = 0;
    }

    /** Draws it in another colour. */
    setColour(colour: Color): void {
        this.line.material.color.copy(colour);
    }
}
