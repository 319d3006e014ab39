import { Group, Mesh } from "three";
import type { Answer, Description } from "../protocol";
import { finenessFor, ring, rubber } from "./bodies";
import type { Centreline } from "./centreline";
import { bendingColour, type Palette, TOUCHING } from "./colours";
import { type ValuePlaces, valueAt } from "./places";
import { type Sweep, SweepBuilder } from "./sweep";
import type { Tint } from "./tint";

/** Windings touch from this part of the boundary angle on: less than what the answer's own errors make of it. */
const TOUCHES = 0.999;

/** A core: where its angle is, its boundary angle, and the last colouring, to paint it only when that changes. */
interface Core {
    part: number;
    angle: number;
    boundary: number;
    shown: number;
}

/** The device: rings in one geometry, all that is rubber in another, bent along the centreline. */
export class Device {
    readonly group = new Group();
    private readonly metal: Sweep;
    private readonly rubber: Sweep;
    private readonly cores: Core[] = [];

    constructor(description: Description, places: ValuePlaces, palette: Palette, tint: Tint) {
        const fine = finenessFor(description.bodies.length);
        const [metal, soft] = [new SweepBuilder(), new SweepBuilder()];
        let parts = 0;
        for (const body of description.bodies) {
            if (body.kind === "ring") {
                ring(metal, body, palette, fine.around);
                continue;
            }
            rubber(soft, body, palette, fine);
            soft.part();
            if (body.kind === "core") {
                const angle = places.output(`core[${this.cores.length + 1}].angle`);
                this.cores.push({ part: parts, angle, boundary: body.boundaryAngle ?? NaN, shown: 0 });
            }
            parts++;
        }
        metal.part();
        this.metal = metal.build();
        this.rubber = soft.build();
        const rings = new Mesh(this.metal.geometry, tint.material({ metalness: 0.1, roughness: 0.35 }));
        const bodies = new Mesh(this.rubber.geometry, tint.material({ metalness: 0, roughness: 0.5 }));
        rings.name = "rings";
        bodies.name = "rubber";
        for (const mesh of [rings, bodies]) {
            mesh.frustumCulled = false;
            this.group.add(mesh);
        }
    }

    /** Bends the device; `base` is the arc length of its base, mm. */
    bend(centreline: Centreline, base: number): void {
        this.metal.bend(centreline, base);
        this.rubber.bend(centreline, base);
    }

    /** Colours cores by their bending, and those whose windings touch. */
    colour(answer: Answer, bending: boolean, touching: boolean): void {
        for (const core of this.cores) {
            const fraction = Math.abs(valueAt(answer.outputs, core.angle)) / core.boundary;
            const touches = touching && fraction > TOUCHES;
            // 0: as built; 1: touching; from 2 on: a step of the scale.
            const shown = touches
                ? 1
                : bending && fraction >= 0
                  ? 2 + Math.round(200 * Math.min(1, fraction))
                  : 0;
            if (shown === core.shown) continue;
            core.shown = shown;
            if (touches) this.rubber.paint(core.part, TOUCHING, 0.75);
            else if (shown) this.rubber.paint(core.part, bendingColour(fraction), 0.15);
            else this.rubber.paint(core.part, null, 0);
        }
    }

    /** Frees what the graphics card holds. */
    dispose(): void {
        this.metal.dispose();
        this.rubber.dispose();
    }
}
