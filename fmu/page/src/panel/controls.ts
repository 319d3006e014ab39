/** The sliders of the panel: magnet, field, feed and load, as far as the device has them. */

import type { Description } from "../protocol";
import { create, element } from "./element";
import { FIELD, LOAD, STRENGTH, feedOf, positionOf, type Quantity } from "./quantity";
import { QuantityRow } from "./quantity_row";
import type { Session } from "./session";

/** Inputs that have no slider of their own are set as numbers, in SI units; orientations are turned with the gizmo. */
const NOT_LISTED = /orientation|^magnet\.position|^magnet\.strength|^field\.uniform|^feed\.|^guidewire\./;

/** Rows for the inputs of the open device. */
export class Controls {
    private rows: QuantityRow[] = [];

    constructor(private readonly session: Session) {
        session.listen({
            opened: (description) => this.build(description),
            changed: () => this.show(),
        });
        element("others", HTMLDetailsElement).addEventListener("toggle", () => this.show());
    }

    private build(description: Description): void {
        this.rows = [];
        const feed = feedOf(description);
        const magnet = description.magnet.length > 0;
        this.fill("magnet-rows", magnet ? [...positionOf(description), STRENGTH] : [], description);
        this.fill("field-rows", FIELD, description);
        this.fill("feed-rows", feed, description);
        this.fill("load-rows", LOAD, description);
        const listed = new Set(this.rows.map((row) => row.quantity.name));
        const others = description.inputs
            .filter(({ name }) => !listed.has(name) && !NOT_LISTED.test(name))
            .map(({ name, unit }): Quantity => {
                const shown = unit === "1" ? "" : unit;
                return { name, label: name, unit: shown, factor: 1, from: 0, to: 0, step: 1e-9 };
            });
        this.fill("other-rows", others, description);
        element("magnet-section", HTMLElement).hidden = !magnet;
        element("feed-section", HTMLElement).hidden = feed.length === 0;
        element("magnet-turns", HTMLElement).hidden = !magnet;
    }

    private fill(place: string, quantities: Quantity[], description: Description): void {
        const rows = quantities.map((quantity) => {
            const input = description.inputs.find(({ name }) => name === quantity.name);
            const set = (value: number) => this.session.set({ [quantity.name]: value }, "controls");
            return new QuantityRow(quantity, input?.min ?? null, input?.max ?? null, set);
        });
        this.rows.push(...rows);
        const nothing = create("p", "remark", "This device has none.");
        const shown = rows.length === 0 ? [nothing] : rows.map((row) => row.element);
        element(place, HTMLElement).replaceChildren(...shown);
    }

    private show(): void {
        const others = element("others", HTMLDetailsElement);
        for (const row of this.rows) {
            // Scores of fields that nobody sees are not written at every frame of a drag.
            if (others.open || !others.contains(row.element)) {
                row.show(this.session.input(row.quantity.name));
            }
        }
    }
}
