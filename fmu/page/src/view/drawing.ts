import { Box3, Group, type Material, Mesh, type Object3D, type Scene, Vector3 } from "three";
import { type Answer, type Description, Status } from "../protocol";
import { DARK, LIGHT } from "./colours";
import { Device } from "./device";
import { FieldArrows } from "./field";
import { ForceArrows } from "./forces";
import { FurtherSource } from "./further_source";
import { Guidewire } from "./guidewire";
import { Magnet } from "./magnet";
import { type Triple, ValuePlaces, valueAt, vectorAt } from "./places";
import { Shaft } from "./shaft";
import { MM, orientationAt, scaled, ShapeReader } from "./shape";
import { SourcePlaces } from "./source_places";
import type { Tint } from "./tint";
import { Vessel } from "./vessel";

/** A pose: position in m, orientation as a quaternion w, x, y, z from body to world. */
export interface Pose {
    position: [number, number, number];
    orientation: [number, number, number, number];
}

/** What can be drawn over the device. */
export const OVERLAYS = ["field", "forces", "trace", "touching", "bending"] as const;
export type Overlay = (typeof OVERLAYS)[number];

/** All that is drawn of one description, in the colours of one theme. */
export class Drawing {
    readonly magnet: Magnet | null;
    private readonly further: readonly FurtherSource[];
    private readonly places: ValuePlaces;
    private readonly shape: ShapeReader;
    private readonly device: Device;
    private readonly shaft: Shaft;
    private readonly guidewire: Guidewire | null;
    private readonly vessel: Vessel | null;
    private readonly field: FieldArrows;
    private readonly forces: ForceArrows;
    private readonly reach: number;
    private readonly tip: Triple;
    /** What follows the shape; hidden while there is none. */
    private readonly bent = new Group();

    constructor(
        readonly description: Description,
        dark: boolean,
        tint: Tint,
        private readonly scene: Scene,
    ) {
        const palette = dark ? DARK : LIGHT;
        const places = new ValuePlaces(description);
        const { guidewire, magnet, further, vessel } = description;
        this.places = places;
        this.shape = new ShapeReader(description, places);
        this.device = new Device(description, places, palette, tint);
        this.shaft = new Shaft(description, palette, tint);
        this.guidewire = guidewire ? new Guidewire(guidewire.radius, palette) : null;
        this.magnet = magnet.length > 0 ? new Magnet(magnet, palette) : null;
        this.further = further.map((source) => new FurtherSource(source, places, palette));
        this.vessel = vessel ? new Vessel(vessel, palette) : null;
        this.field = new FieldArrows(description, places, palette);
        this.forces = new ForceArrows(description, places, palette);
        this.reach = places.input("guidewire.insertion");
        this.tip = places.outputVector("tip.position");
        this.bent.add(this.device.group, this.shaft.group, this.field.group, this.forces.group);
        if (this.guidewire) this.bent.add(this.guidewire.mesh);
        this.bent.visible = false;
        scene.add(this.bent);
        if (this.vessel) scene.add(this.vessel.mesh);
        if (this.magnet) scene.add(this.magnet.group);
        for (const source of this.further) scene.add(source.magnet.group);
    }

    /** Whether the vessel lies flat, so that it is better seen from above. */
    get flat(): boolean {
        const size = this.vessel?.bounds.getSize(new Vector3());
        return size !== undefined && size.x > 2 * size.y;
    }

    /** Pose and strength of the magnet at the start. */
    start(): { pose: Pose; strength: number } {
        const { places } = this;
        const values = places.start();
        const { position, orientation, strength } = new SourcePlaces(places, { name: "magnet", coil: false });
        const turn = orientationAt(values, orientation);
        return {
            pose: { position: vectorAt(values, position), orientation: [turn.w, turn.x, turn.y, turn.z] },
            strength: valueAt(values, strength) || 0,
        };
    }

    /** Draws the shape of an answer. Returns where the tip is, mm; null where it has no shape, or only the last good one. */
    bend(answer: Answer, overlays: ReadonlySet<Overlay>): [number, number, number] | null {
        const { shape, field, forces } = this;
        for (const source of this.further) source.place(answer.inputs);
        this.bent.visible = shape.read(answer);
        if (!this.bent.visible) return null;
        this.device.bend(shape.centreline, shape.base);
        this.device.colour(answer, overlays.has("bending"), overlays.has("touching"));
        this.shaft.bend(shape.centreline, shape.base);
        this.guidewire?.bend(shape.centreline, MM * (valueAt(answer.inputs, this.reach) || 0));
        field.group.visible = overlays.has("field");
        if (field.group.visible) field.draw(answer);
        forces.group.visible = overlays.has("forces");
        if (forces.group.visible) forces.draw(answer, shape);
        return answer.status === Status.NotSolved ? null : scaled(vectorAt(answer.outputs, this.tip));
    }

    /** The box around the device: the shape that is drawn, or the straight device before there is one. */
    deviceBox(): Box3 {
        const { shape } = this;
        const outline = this.bent.visible ? shape.outline() : shape.straight(this.places.start());
        return new Box3().setFromPoints(outline).expandByScalar(3);
    }

    /** The box around all; a magnet that is switched off does not count. */
    box(): Box3 {
        const box = this.deviceBox();
        for (const magnet of this.magnets()) if (magnet.present) box.union(magnet.box());
        if (this.vessel) box.union(this.vessel.bounds);
        return box;
    }

    /** Device, magnets and coils, as far as they are shown. */
    solids(): Object3D[] {
        const { bent, device, shaft, guidewire } = this;
        const shaped = bent.visible
            ? [device.group, shaft.group, ...(guidewire ? [guidewire.mesh] : [])]
            : [];
        return [...shaped, ...this.magnets().map((magnet) => magnet.group)];
    }

    /** All magnets and coils. */
    private magnets(): Magnet[] {
        return [...(this.magnet ? [this.magnet] : []), ...this.further.map((source) => source.magnet)];
    }

    /** Takes all out of the scene and frees what the graphics card holds. */
    dispose(): void {
        const { device, shaft, guidewire, vessel, field, forces } = this;
        this.scene.remove(this.bent);
        for (const magnet of this.magnets()) this.scene.remove(magnet.group);
        if (vessel) this.scene.remove(vessel.mesh);
        for (const one of [device, shaft, guidewire, vessel, field, forces, ...this.magnets()])
            one?.dispose();
        this.bent.traverse((object) => {
            if (object instanceof Mesh) (object.material as Material).dispose();
        });
    }
}
