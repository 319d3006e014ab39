import { Mesh, MeshBasicMaterial } from "three";
import { tube } from "./bodies";
import type { Centreline } from "./centreline";
import type { Palette } from "./colours";
import { MM } from "./shape";
import { type Sweep, SweepBuilder } from "./sweep";

/** Slices along the wire. */
const SLICES = 240;

/** What is beyond the tip counts for nothing; so much of it is drawn, mm, to say that it is there. */
const BEYOND = 4;

/** The guidewire, as wide as it is; a bright line that shines through the device around it. */
export class Guidewire {
    readonly mesh: Mesh;
    private readonly sweep: Sweep;

    constructor(radius: number, palette: Palette) {
        const builder = new SweepBuilder();
        builder.paint(palette.wire);
        tube(builder, { begin: 0, length: 1, innerRadius: 0, outerRadius: MM * radius }, SLICES, 8);
        builder.part();
        this.sweep = builder.build();
        // Drawn last and over everything, as it is inside: else nobody would see it.
        const material = new MeshBasicMaterial({
            vertexColors: true,
            depthTest: false,
            transparent: true,
            opacity: 0.85,
        });
        this.mesh = new Mesh(this.sweep.geometry, material);
        this.mesh.name = "guidewire";
        this.mesh.renderOrder = 5;
        this.mesh.frustumCulled = false;
    }

    /** Bends the wire up to the arc length that it reaches, mm. */
    bend(centreline: Centreline, reach: number): void {
        const length = Math.min(reach, centreline.end + BEYOND);
        this.mesh.visible = length > 1e-3;
        if (this.mesh.visible) this.sweep.bend(centreline, 0, length);
    }

    /** Frees what the graphics card holds. */
    dispose(): void {
        this.sweep.dispose();
    }
}
