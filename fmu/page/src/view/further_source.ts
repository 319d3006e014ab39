import type { Source } from "../protocol";
import type { Palette } from "./colours";
import { Magnet } from "./magnet";
import { SourcePlaces } from "./source_places";
import { valueAt, type ValuePlaces, vectorAt } from "./places";
import { orientationAt, scaled } from "./shape";

/** A magnet after the first one, or a coil, where its inputs say. */
export class FurtherSource {
    readonly magnet: Magnet;
    private readonly places: SourcePlaces;

    constructor(source: Source, places: ValuePlaces, palette: Palette) {
        this.magnet = new Magnet(source.parts, palette, source.name, source.coil);
        this.places = new SourcePlaces(places, source);
        this.place(places.start());
    }

    /** Puts it where these inputs say. */
    place(inputs: Float64Array): void {
        const { position, orientation, strength } = this.places;
        const strong = valueAt(inputs, strength) || 0;
        if (this.magnet.faded !== (strong === 0)) this.magnet.setStrength(strong);
        this.magnet.group.position.set(...scaled(vectorAt(inputs, position)));
        this.magnet.group.quaternion.copy(orientationAt(inputs, orientation)).normalize();
    }
}
