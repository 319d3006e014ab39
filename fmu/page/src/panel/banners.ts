/** Messages over the picture: what lies ahead, what has happened, what is wrong. */

import { button, create, element } from "./element";

/** What a message is about: a newer one of the same kind takes its place. */
export type Kind = "fold" | "snap" | "unsolved" | "notice";

/** A button in a message. */
export interface Choice {
    text: string;
    does(): void;
}

/** Shows at most one message of each kind. */
export class Banners {
    private readonly shown = new Map<Kind, { banner: HTMLElement; words: HTMLElement; timer: number }>();

    /** Shows a message until another of its kind comes or `seconds` have passed. A `notice` can be put away. */
    show(kind: Kind, text: string, choice: Choice | null = null, seconds = 0): void {
        const old = this.shown.get(kind);
        if (old !== undefined && choice === null && kind !== "notice") {
            window.clearTimeout(old.timer);
            if (old.words.textContent !== text) {
                old.words.textContent = text;
            }
            old.timer = this.expiry(kind, seconds);
            return;
        }
        this.hide(kind);
        const banner = create("div", `banner banner-${kind}`);
        // A way to a fold changes its number all the time: it is read out when there is time for it.
        banner.setAttribute("role", kind === "fold" || kind === "notice" ? "status" : "alert");
        const words = create("p", "banner-words", text);
        banner.append(words);
        if (choice !== null) {
            banner.append(button(choice.text, choice.does));
        }
        if (kind === "notice") {
            banner.append(button("Close", () => this.hide(kind)));
        }
        element("banners", HTMLElement).append(banner);
        this.shown.set(kind, { banner, words, timer: this.expiry(kind, seconds) });
    }

    hide(kind: Kind): void {
        const shown = this.shown.get(kind);
        if (shown !== undefined) {
            window.clearTimeout(shown.timer);
            shown.banner.remove();
            this.shown.delete(kind);
        }
    }

    private expiry(kind: Kind, seconds: number): number {
        return seconds > 0 ? window.setTimeout(() => this.hide(kind), 1e3 * seconds) : 0;
    }
}
