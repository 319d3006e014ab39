/** The panel: at the side of a wide window, where it can be put away; a sheet from below on a narrow one. */

import { element } from "./element";

/** Heights of the sheet, from low to high. */
const HEIGHTS = ["low", "half", "high"] as const;
type Height = (typeof HEIGHTS)[number];

/** Way of a finger on the grip that counts as a pull, px. */
const PULL = 24;

/** Lets the panel be opened, put away and pulled. */
export class Sheet {
    private readonly narrow = matchMedia("(max-width: 760px)");
    private height: Height = "half";
    private open = true;

    constructor() {
        const grip = element("grip", HTMLButtonElement);
        let from: number | null = null;
        let pulled = false;
        grip.addEventListener("pointerdown", (event) => {
            [from, pulled] = [event.clientY, false];
            grip.setPointerCapture(event.pointerId);
        });
        grip.addEventListener("pointermove", (event) => {
            if (from !== null && Math.abs(event.clientY - from) > PULL) {
                this.pull(event.clientY < from ? 1 : -1);
                [from, pulled] = [event.clientY, true];
            }
        });
        grip.addEventListener("pointerup", () => (from = null));
        grip.addEventListener("pointercancel", () => (from = null));
        grip.addEventListener("click", () => {
            if (!pulled) {
                this.height = this.height === "half" ? "low" : "half";
                this.apply();
            }
            pulled = false;
        });
        element("panel-toggle", HTMLButtonElement).addEventListener("click", () => {
            this.open = !this.open;
            this.apply();
        });
        this.narrow.addEventListener("change", () => this.apply());
        this.apply();
    }

    private pull(by: 1 | -1): void {
        const next = HEIGHTS[HEIGHTS.indexOf(this.height) + by];
        if (next !== undefined) {
            this.height = next;
            this.apply();
        }
    }

    private apply(): void {
        const narrow = this.narrow.matches;
        document.body.dataset.sheet = this.height;
        document.body.dataset.panel = this.open || narrow ? "open" : "closed";
        element("panel-toggle", HTMLButtonElement).setAttribute("aria-expanded", String(this.open));
        element("grip", HTMLButtonElement).setAttribute("aria-expanded", String(this.height !== "low"));
        // Beneath a low picture there is no room for plots: they move into the sheet.
        const plots = element("plots", HTMLElement);
        const place = element(narrow ? "plots-in-panel" : "plots-below", HTMLElement);
        if (plots.parentElement !== place) {
            place.append(plots);
        }
    }
}
