/** Light and dark: as the system has it, until a person chooses. */

import { element } from "./element";

export type Theme = "light" | "dark";

/** The theme of the page. */
export class Appearance {
    /** What was chosen; null follows the system. */
    chosen: Theme | null = null;
    private readonly system = matchMedia("(prefers-color-scheme: dark)");

    /** `changed` is told whether it is dark, at once and at every change. */
    constructor(private readonly changed: (dark: boolean) => void) {
        this.system.addEventListener("change", () => this.apply());
        element("theme", HTMLButtonElement).addEventListener("click", () =>
            this.choose(this.dark ? "light" : "dark"),
        );
        this.apply();
    }

    get dark(): boolean {
        return this.chosen === null ? this.system.matches : this.chosen === "dark";
    }

    choose(theme: Theme | null): void {
        this.chosen = theme;
        this.apply();
    }

    private apply(): void {
        document.documentElement.dataset.theme = this.dark ? "dark" : "light";
        element("theme", HTMLButtonElement).setAttribute("aria-pressed", String(this.dark));
        this.changed(this.dark);
    }
}
