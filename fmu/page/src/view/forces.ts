import { Group } from "three";
import type { Answer, Description } from "../protocol";
import { Arrows, arrowSize } from "./arrows";
import { FRAME } from "./centreline";
import type { Palette } from "./colours";
import { type Triple, type ValuePlaces, vectorAt } from "./places";
import { type ShapeReader, scaled } from "./shape";

/** Force of an arrow of middling length, N. */
const TYPICAL = 0.02;

/**
 * Arrows of forces on the device: the magnet's at its middle, that of the clamp, or of the port that holds the shaft, where it acts,
 * the load at its tip, and the wall's, in all at its middle and thinner at each ring.
 */
export class ForceArrows {
    readonly group = new Group();
    private readonly magnetic: Arrows;
    private readonly reaction: Arrows;
    private readonly load: Arrows;
    private readonly contact: Arrows;
    private readonly ringContact: Arrows;
    private readonly rings: { place: Triple; force: Triple }[];
    private readonly forces: { magnetic: Triple; reaction: Triple; load: Triple; contact: Triple };
    private readonly frames = new Float32Array(3 * FRAME);

    constructor(description: Description, places: ValuePlaces, palette: Palette) {
        const size = arrowSize(description);
        const rings = description.bodies.filter((body) => body.kind === "ring");
        this.rings = rings.map((_, k) => ({
            place: places.outputVector(`ring[${k + 1}].position`),
            force: places.outputVector(`ring[${k + 1}].contact_force`),
        }));
        this.forces = {
            magnetic: places.outputVector("force.magnetic"),
            reaction: places.outputVector("base.reaction_force"),
            load: places.inputVector("tip.load_force"),
            contact: places.outputVector("contact.force"),
        };
        this.magnetic = new Arrows(1, palette.magneticForce, TYPICAL, size);
        this.reaction = new Arrows(1, palette.reaction, TYPICAL, size);
        this.load = new Arrows(1, palette.load, TYPICAL, size);
        this.contact = new Arrows(1, palette.contact, TYPICAL, size);
        this.ringContact = new Arrows(this.rings.length, palette.contact, TYPICAL, size, 0.6);
        this.group.add(...this.all().map((arrows) => arrows.group));
    }

    /** Draws the forces of an answer, whose shape was read. */
    draw(answer: Answer, shape: ShapeReader): void {
        const { inputs, outputs } = answer;
        for (const arrows of this.all()) arrows.clear();
        const { base: begin, length } = shape;
        shape.centreline.sample([0, begin + length / 2, begin + length], 0, 1, this.frames);
        const [base, middle, tip] = [this.place(0), this.place(1), this.place(2)];
        this.magnetic.add(middle, vectorAt(outputs, this.forces.magnetic));
        this.reaction.add(base, vectorAt(outputs, this.forces.reaction));
        this.load.add(tip, vectorAt(inputs, this.forces.load));
        this.contact.add(middle, vectorAt(outputs, this.forces.contact));
        for (const ring of this.rings) {
            this.ringContact.add(scaled(vectorAt(outputs, ring.place)), vectorAt(outputs, ring.force));
        }
    }

    /** Frees what the graphics card holds. */
    dispose(): void {
        for (const arrows of this.all()) arrows.dispose();
    }

    private all(): Arrows[] {
        return [this.magnetic, this.reaction, this.load, this.contact, this.ringContact];
    }

    private place(k: number): [number, number, number] {
        return [this.frames[FRAME * k]!, this.frames[FRAME * k + 1]!, this.frames[FRAME * k + 2]!];
    }
}
