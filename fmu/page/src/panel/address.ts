/** Keeps the address of the page up to date with its state, and opens the state of an address. */

import type { Banners } from "./banners";
import { element } from "./element";
import { hashOf, type Linked, linkedBy } from "./link";

/** Time at rest after which the address is written, ms. */
const REST = 600;

/** The address of the page. */
export class Address {
    private timer = 0;

    /** `state` says what a link shall hold; null while nothing is open. `kept` does so after a trial, with what is not kept as it is.
     * `open` takes what an address holds. */
    constructor(
        private readonly state: () => Linked | null,
        private readonly kept: () => Promise<{ linked: Linked; remark: string } | null>,
        private readonly open: (linked: Linked | null) => void,
        private readonly banners: Banners,
    ) {
        window.addEventListener("hashchange", () => void this.read());
        element("copy-link", HTMLButtonElement).addEventListener("click", () => void this.copy());
    }

    /** Opens what the address holds; what is broken is told, and the first scene opened. */
    async read(): Promise<void> {
        if (location.hash.length <= 1) {
            this.open(null);
            return;
        }
        try {
            this.open(await linkedBy(location.hash));
        } catch (error) {
            const why = error instanceof Error ? error.message : String(error);
            this.banners.show("notice", `The link cannot be read: ${why}. The first scene was opened.`);
            this.open(null);
        }
    }

    /** Writes the address once nothing has changed for a while. */
    later(): void {
        window.clearTimeout(this.timer);
        this.timer = window.setTimeout(() => void this.write(), REST);
    }

    private async write(state = this.state()): Promise<string | null> {
        if (state === null) {
            return null;
        }
        const hash = await hashOf(state).catch(() => null);
        if (hash === null) {
            return null;
        }
        try {
            history.replaceState(null, "", hash);
        } catch {
            // Some browsers do not let a file change its address; the link can still be copied.
        }
        return location.href.replace(/#.*$/, "") + hash;
    }

    private async copy(): Promise<void> {
        const kept = await this.kept();
        window.clearTimeout(this.timer); // what was tried stays in the address
        const link = await this.write(kept?.linked ?? null);
        if (link === null) {
            this.banners.show("notice", "This browser cannot pack the state into a link.");
            return;
        }
        try {
            await navigator.clipboard.writeText(link);
            const remark = kept?.remark ?? "";
            const seconds = remark === "" ? 4 : 0;
            this.banners.show("notice", `The link is on the clipboard. ${remark}`.trim(), null, seconds);
        } catch {
            this.banners.show(
                "notice",
                `The browser does not allow copying: the link is in the address bar. ${kept?.remark ?? ""}`.trim(),
            );
        }
    }
}
