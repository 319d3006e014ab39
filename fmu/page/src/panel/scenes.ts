/** The menu of scenes, and the two keys of a scene that have controls of their own: segments and level. */

import { LEVELS } from "../protocol";
import { element } from "./element";
import type { Editor } from "./editor";
import { builtIn, PRESETS, type Preset } from "./presets";
import { valueIn, withValue } from "./scene_text";
import type { Session } from "./session";

/** Number of segments that a scene has which does not say it. */
const SEGMENTS = 9;

/** The controls that change which scene is open. */
export class Scenes {
    private readonly scenes: Preset[];
    private readonly menu = element("preset", HTMLSelectElement);
    private readonly segments = element("segments", HTMLInputElement);
    private readonly level = element("level", HTMLSelectElement);

    constructor(
        private readonly session: Session,
        private readonly editor: Editor,
        private readonly refuse: (why: string) => void,
    ) {
        const own = new Option("Your own scene", "");
        own.disabled = true;
        const given = builtIn();
        this.scenes = given === null ? PRESETS : [given, ...PRESETS];
        this.menu.replaceChildren(...this.scenes.map(({ name, title }) => new Option(title, name)), own);
        this.menu.addEventListener("change", () => {
            const preset = this.scenes.find(({ name }) => name === this.menu.value);
            if (preset !== undefined) {
                editor.open(preset.scene);
            }
        });
        this.level.replaceChildren(...LEVELS.map((level) => new Option(level, level)));
        this.segments.addEventListener("change", () => {
            if (this.segments.checkValidity() && this.segments.value !== "") {
                this.change("design", "segments", String(this.segments.valueAsNumber));
            }
        });
        this.level.addEventListener("change", () =>
            this.change("model", "interaction", `"${this.level.value}"`),
        );
        const step = (by: number) => () => {
            const wanted = Number(this.segments.value) + by;
            if (wanted >= Number(this.segments.min) && wanted <= Number(this.segments.max)) {
                this.segments.value = String(wanted);
                this.change("design", "segments", String(wanted));
            }
        };
        element("segments-fewer", HTMLButtonElement).addEventListener("click", step(-1));
        element("segments-more", HTMLButtonElement).addEventListener("click", step(1));
        session.listen({ opened: () => this.show(), refused: () => this.show() });
    }

    /** The preset that is open, if it is one. */
    get preset(): Preset | undefined {
        return this.scenes.find(({ scene }) => scene === this.session.scene);
    }

    /** Opens the first scene. */
    openFirst(): void {
        this.editor.open((this.scenes[0] ?? PRESETS[0]).scene);
    }

    /** Writes a key into the text and opens it; the pose and all that was moved stay as they are. */
    private change(table: string, key: string, value: string): void {
        const text = withValue(this.session.scene, table, key, value);
        if (text === null) {
            this.refuse(`This text writes ${table}.${key} in a way that only the editor can change.`);
            this.show();
            return;
        }
        this.editor.open(text, this.session.moved());
    }

    private show(): void {
        const { scene, description } = this.session;
        const rod = valueIn(scene, "design", "kind")?.includes("cylinder") ?? false;
        this.segments.value = valueIn(scene, "design", "segments") ?? String(SEGMENTS);
        for (const name of ["segments", "segments-fewer", "segments-more"]) {
            element(name, HTMLElement).toggleAttribute("disabled", rod);
        }
        this.level.value = description?.level ?? "auto";
        this.menu.value = this.preset?.name ?? "";
        element("preset-about", HTMLElement).textContent =
            this.preset?.about ?? "A scene of your own; its text is below.";
        element("play", HTMLElement).hidden = (this.preset?.way.length ?? 0) === 0;
    }
}
