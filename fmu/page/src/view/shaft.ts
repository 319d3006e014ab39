import { Group, Mesh } from "three";
import type { Description } from "../protocol";
import { revolve, tube } from "./bodies";
import type { Centreline } from "./centreline";
import type { Palette } from "./colours";
import { MM } from "./shape";
import { type Sweep, SweepBuilder } from "./sweep";
import type { Tint } from "./tint";

/** Length of shaft that is drawn behind the port, mm, to show where it comes from. */
const BEHIND = 25;

/** Slices of the shaft inside the port: as many for any length, so that its geometry can stay. */
const SLICES = 240;

/** Parts of a full circle of the shaft. */
const AROUND = 20;

/** What holds the device: the shaft from the port to its base, or a clamp at its base; and a collar at port or clamp. */
export class Shaft {
    readonly group = new Group();
    private readonly collar: Sweep;
    private readonly behind: Sweep | null = null;
    private readonly inside: Sweep | null = null;
    private readonly insideMesh: Mesh | null = null;

    constructor(description: Description, palette: Palette, tint: Tint) {
        const widest = Math.max(...description.bodies.map((body) => MM * body.outerRadius), 0.5);
        const { shaft } = description;
        const inner = shaft ? MM * shaft.outerRadius * 1.02 : 0;
        this.collar = build(palette.clamp, (builder) => {
            const [radius, edge] = [1.35 * widest, 0.12 * widest];
            // A port is a thin collar about the shaft; a clamp is a block that the device stands on.
            const length = shaft ? 0.5 * widest : widest;
            const ends = [
                [-length, inner],
                [-length, radius - edge],
                [edge - length, radius],
            ] as const;
            revolve(builder, [...ends, [-edge, radius], [0, radius - edge], [0, inner]], 48);
        });
        this.add(this.collar, tint, { metalness: 0.2, roughness: 0.4 });
        if (!shaft) return;
        const radii = { innerRadius: MM * shaft.innerRadius, outerRadius: MM * shaft.outerRadius };
        this.behind = build(palette.shaft, (builder) => {
            tube(builder, { begin: -BEHIND, length: BEHIND, ...radii }, 1, AROUND);
        });
        this.inside = build(palette.shaft, (builder) => {
            tube(builder, { begin: 0, length: 1, ...radii }, SLICES, AROUND);
        });
        this.add(this.behind, tint, { roughness: 0.5 });
        this.insideMesh = this.add(this.inside, tint, { roughness: 0.5 });
    }

    /** Bends the shaft; `base` is the arc length of the device's base, mm. */
    bend(centreline: Centreline, base: number): void {
        this.collar.bend(centreline, 0);
        this.behind?.bend(centreline, 0);
        this.inside?.bend(centreline, 0, Math.max(base, 1e-3));
        if (this.insideMesh) this.insideMesh.visible = base > 1e-3;
    }

    /** Frees what the graphics card holds. */
    dispose(): void {
        for (const sweep of [this.collar, this.behind, this.inside]) sweep?.dispose();
    }

    private add(sweep: Sweep, tint: Tint, look: { metalness?: number; roughness: number }): Mesh {
        const mesh = new Mesh(sweep.geometry, tint.material({ metalness: 0, ...look }));
        mesh.name = "shaft";
        mesh.frustumCulled = false;
        this.group.add(mesh);
        return mesh;
    }
}

/** The surfaces that `draw` adds, in one colour. */
function build(colour: Palette["shaft"], draw: (builder: SweepBuilder) => void): Sweep {
    const builder = new SweepBuilder();
    builder.paint(colour);
    draw(builder);
    builder.part();
    return builder.build();
}
