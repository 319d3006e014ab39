import { BufferAttribute, BufferGeometry, Color, DynamicDrawUsage } from "three";
import { type Centreline, FRAME } from "./centreline";

/** Numbers of a vertex in the section: along the first and second director; then its normal along all three. */
const SECTION = 5;

/**
 * Gathers the surfaces of a straight body: vertices in (arc length, radius, angle) coordinates, with normals along the radius, the
 * angle and the arc length, and triangles between them.
 */
export class SweepBuilder {
    private readonly arcs: number[] = [];
    private readonly sections: number[] = [];
    private readonly colours: number[] = [];
    private readonly triangles: number[] = [];
    private readonly parts: { first: number; end: number }[] = [];
    private colour = new Color(1, 1, 1);

    /** Number of vertices so far: that of the next one. */
    get next(): number {
        return this.arcs.length;
    }

    /** The colour of what follows. */
    paint(colour: Color): void {
        this.colour = colour;
    }

    /** Adds a vertex; the normal is of unit length. */
    vertex(arc: number, radius: number, angle: number, normal: readonly [number, number, number]): void {
        const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
        const [outward, around, forward] = normal;
        this.arcs.push(arc);
        this.sections.push(radius * cos, radius * sin);
        this.sections.push(outward * cos - around * sin, outward * sin + around * cos, forward);
        this.colours.push(this.colour.r, this.colour.g, this.colour.b);
    }

    /**
     * Adds the triangles of a grid of vertices that was added row by row from `first` on. Seen from outside they turn left where
     * rows go forward along the device and columns go round it in the positive sense; `flip` is for the other way.
     */
    grid(first: number, rows: number, columns: number, flip = false): void {
        for (let row = 0; row + 1 < rows; row++) {
            for (let column = 0; column + 1 < columns; column++) {
                const a = first + row * columns + column;
                const [b, c, d] = [a + 1, a + columns + 1, a + columns];
                if (flip) this.triangles.push(a, d, b, b, d, c);
                else this.triangles.push(a, b, d, b, c, d);
            }
        }
    }

    /** Ends a part that can be painted on its own; what was added since the last call belongs to it. */
    part(): void {
        this.parts.push({ first: this.parts.at(-1)?.end ?? 0, end: this.next });
    }

    /** The surfaces, ready to be bent. */
    build(): Sweep {
        // Vertices share frames: a frame costs ten times what a vertex does.
        const stations = [...new Set(this.arcs.map((arc) => Math.round(arc * 1e5) / 1e5))].sort(
            (a, b) => a - b,
        );
        const number = new Map(stations.map((arc, k) => [arc, k]));
        const station = Uint32Array.from(this.arcs, (arc) => number.get(Math.round(arc * 1e5) / 1e5)!);
        return new Sweep(
            Float64Array.from(stations),
            station,
            Float32Array.from(this.sections),
            Float32Array.from(this.colours),
            this.triangles,
            this.parts,
        );
    }
}

/** Surfaces along the centreline in one geometry. Its arrays are kept and written anew for each shape. */
export class Sweep {
    readonly geometry = new BufferGeometry();
    private readonly frames: Float32Array;
    private readonly positions: BufferAttribute;
    private readonly normals: BufferAttribute;
    private readonly colours: BufferAttribute;
    private readonly glow: BufferAttribute;
    private readonly unpainted: Float32Array;

    constructor(
        private readonly stations: Float64Array,
        private readonly station: Uint32Array,
        private readonly sections: Float32Array,
        colours: Float32Array,
        triangles: number[],
        private readonly parts: { first: number; end: number }[],
    ) {
        const count = station.length;
        const changing = (size: number) =>
            new BufferAttribute(new Float32Array(size * count), size).setUsage(DynamicDrawUsage);
        this.frames = new Float32Array(FRAME * stations.length);
        this.positions = changing(3);
        this.normals = changing(3);
        this.colours = changing(3);
        this.glow = changing(1);
        this.unpainted = colours;
        this.colours.array.set(colours);
        this.geometry.setIndex(triangles);
        this.geometry.setAttribute("position", this.positions);
        this.geometry.setAttribute("normal", this.normals);
        this.geometry.setAttribute("color", this.colours);
        this.geometry.setAttribute("glow", this.glow);
    }

    /** Bends the surfaces: arc lengths become `offset + scale * arc`. */
    bend(centreline: Centreline, offset: number, scale = 1): void {
        const { frames, sections, station } = this;
        centreline.sample(this.stations, offset, scale, frames);
        const positions = this.positions.array as Float32Array;
        const normals = this.normals.array as Float32Array;
        for (let i = 0, p = 0, q = 0; i < station.length; i++, p += 3, q += SECTION) {
            const f = FRAME * station[i]!;
            const a = sections[q]!;
            const b = sections[q + 1]!;
            const na = sections[q + 2]!;
            const nb = sections[q + 3]!;
            const nc = sections[q + 4]!;
            for (let k = 0; k < 3; k++) {
                const d1 = frames[f + 3 + k]!;
                const d2 = frames[f + 6 + k]!;
                positions[p + k] = frames[f + k]! + a * d1 + b * d2;
                normals[p + k] = na * d1 + nb * d2 + nc * frames[f + 9 + k]!;
            }
        }
        this.positions.needsUpdate = true;
        this.normals.needsUpdate = true;
    }

    /** Paints a part in a colour, or as it was built; `glow` from 0 to 1 makes it shine. */
    paint(part: number, colour: Color | null, glow: number): void {
        const range = this.parts[part];
        if (!range) return;
        const { first, end } = range;
        const colours = this.colours.array as Float32Array;
        if (!colour) colours.set(this.unpainted.subarray(3 * first, 3 * end), 3 * first);
        else for (let i = first; i < end; i++) colours.set([colour.r, colour.g, colour.b], 3 * i);
        (this.glow.array as Float32Array).fill(glow, first, end);
        this.colours.needsUpdate = true;
        this.glow.needsUpdate = true;
    }

    /** Frees what the graphics card holds. */
    dispose(): void {
        this.geometry.dispose();
    }
}
