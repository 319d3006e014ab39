/** What the page needs of a browser, and what it says where that is missing. */

import { button, create, element } from "./element";

/** What is missing, in words; empty where all is there. */
export function missing(): string[] {
    const canvas = document.createElement("canvas");
    const needs: [string, boolean][] = [
        ["WebAssembly, which computes", typeof WebAssembly === "object"],
        ["web workers, which compute beside the page", typeof Worker === "function"],
        ["DecompressionStream, which unpacks the core", typeof DecompressionStream === "function"],
        ["WebGL 2, which draws", canvas.getContext("webgl2") !== null],
    ];
    return needs.filter(([, there]) => !there).map(([what]) => what);
}

/** Covers the page with a message where it cannot go on. */
export function stop(title: string, lines: string[], reload: boolean): void {
    const cover = element("cover", HTMLElement);
    const list = create("ul", "");
    list.append(...lines.map((line) => create("li", "", line)));
    cover.replaceChildren(create("h2", "", title), list);
    if (reload) {
        cover.append(button("Reload", () => location.reload()));
    }
    cover.hidden = false;
    cover.querySelector("button")?.focus();
}
