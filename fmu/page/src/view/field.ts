import { Group } from "three";
import type { Answer, Description } from "../protocol";
import { Arrows, arrowSize } from "./arrows";
import type { Palette } from "./colours";
import { DipoleField } from "./dipoles";
import { type Triple, type ValuePlaces, vectorAt } from "./places";
import { scaled } from "./shape";

/** Field of an arrow of middling length, T. */
const TYPICAL = 0.02;

/**
 * Arrows of the magnetic field: the exact one at the tip, which is an output, and at the rings that of the magnet's dipoles, which
 * shows direction and relative size only.
 */
export class FieldArrows {
    readonly group = new Group();
    private readonly tip: { place: Triple; field: Triple };
    private readonly rings: Triple[];
    private readonly dipoles: DipoleField;
    private readonly exact: Arrows;
    private readonly rough: Arrows;

    constructor(description: Description, places: ValuePlaces, palette: Palette) {
        const size = arrowSize(description);
        const rings = description.bodies.filter((body) => body.kind === "ring");
        this.rings = rings.map((_, k) => places.outputVector(`ring[${k + 1}].position`));
        this.tip = { place: places.outputVector("tip.position"), field: places.outputVector("field.tip") };
        this.dipoles = new DipoleField(description, places);
        this.exact = new Arrows(1, palette.field, TYPICAL, size);
        this.rough = new Arrows(this.rings.length, palette.ringField, TYPICAL, size, 0.6);
        this.group.add(this.exact.group, this.rough.group);
    }

    /** Draws the field of an answer. */
    draw(answer: Answer): void {
        const { outputs } = answer;
        this.exact.clear();
        this.rough.clear();
        this.exact.add(scaled(vectorAt(outputs, this.tip.place)), vectorAt(outputs, this.tip.field));
        this.dipoles.read(answer.inputs);
        for (const ring of this.rings) {
            const place = vectorAt(outputs, ring);
            this.rough.add(scaled(place), this.dipoles.at(...place));
        }
    }

    /** Frees what the graphics card holds. */
    dispose(): void {
        this.exact.dispose();
        this.rough.dispose();
    }
}
