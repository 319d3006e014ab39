/** The bar over the picture: move or turn the magnet, what is drawn beside the device, and the camera. */

import { OVERLAYS, type Overlay, type View } from "../view/view";
import { button, element } from "./element";

const TITLES: Record<Overlay, [string, string]> = {
    field: ["Field", "Arrows of the external field around the device"],
    forces: ["Forces", "Forces on rings, tip and magnet"],
    trace: ["Trace", "Where the tip has been"],
    touching: ["Touching", "Cores whose adjacent windings touch, and contacts with the wall"],
    bending: ["Bending", "Colours by how far each core has bent"],
};

/** Overlays that are on where nothing else is asked for. */
const AT_FIRST: Overlay[] = ["trace", "touching"];

/** The bar, and the overlays that are on. */
export class Toolbar {
    private readonly shown = new Set<Overlay>();
    private readonly buttons = new Map<Overlay, HTMLButtonElement>();

    /** `changed` is called where a person switched an overlay. */
    constructor(
        private readonly view: View,
        changed: () => void,
    ) {
        const bar = element("overlays", HTMLElement);
        for (const overlay of OVERLAYS) {
            const [title, about] = TITLES[overlay];
            const toggle = button(title, () => {
                this.set(overlay, !this.shown.has(overlay));
                changed();
            });
            toggle.title = about;
            this.buttons.set(overlay, toggle);
            bar.append(toggle);
            this.set(overlay, AT_FIRST.includes(overlay));
        }
        element("gizmo-move", HTMLButtonElement).addEventListener("click", () => this.gizmo("translate"));
        element("gizmo-turn", HTMLButtonElement).addEventListener("click", () => this.gizmo("rotate"));
        element("frame", HTMLButtonElement).addEventListener("click", () => view.frame());
        element("frame-device", HTMLButtonElement).addEventListener("click", () => view.frame("device"));
        element("clear-trace", HTMLButtonElement).addEventListener("click", () => view.clearTrace());
        this.gizmo("translate");
    }

    /** Names of the overlays that are on. */
    get overlays(): string[] {
        return [...this.shown];
    }

    /** Switches on these and no others. */
    show(names: readonly string[]): void {
        OVERLAYS.forEach((overlay) => this.set(overlay, names.includes(overlay)));
    }

    gizmo(mode: "translate" | "rotate"): void {
        this.view.setGizmo(mode);
        element("gizmo-move", HTMLButtonElement).setAttribute("aria-pressed", String(mode === "translate"));
        element("gizmo-turn", HTMLButtonElement).setAttribute("aria-pressed", String(mode === "rotate"));
    }

    private set(overlay: Overlay, on: boolean): void {
        if (on) {
            this.shown.add(overlay);
        } else {
            this.shown.delete(overlay);
        }
        this.view.setOverlay(overlay, on);
        this.buttons.get(overlay)?.setAttribute("aria-pressed", String(on));
    }
}
