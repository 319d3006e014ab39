/** The keyboard: the magnet along and about the world's axes. */

import { moveMagnet, turnMagnet } from "./magnet";
import type { Session } from "./session";

type Axis = 0 | 1 | 2;

/** Axis and sense of the keys: left and right go along the device, up and down towards it, pages across. */
const ALONG: Record<string, [Axis, 1 | -1]> = {
    ArrowRight: [2, 1],
    ArrowLeft: [2, -1],
    ArrowUp: [1, 1],
    ArrowDown: [1, -1],
    PageUp: [0, 1],
    PageDown: [0, -1],
};

/** Sense of the keys that turn about x, in the plane in which a magnet beside the device bends it. */
const TURNS: Record<string, 1 | -1> = { "[": -1, "{": -1, "]": 1, "}": 1 };

/** A step of a key: 1 mm or 1 deg, ten with Shift, a tenth with Alt. */
const MILLIMETRE = 1e-3;
const DEGREE = Math.PI / 180;

/** What other keys do. */
export interface KeyActions {
    gizmo(mode: "translate" | "rotate"): void;
    frame(): void;
    help(): void;
}

/** Listens to the keys of the page, except where a person types or moves a slider. */
export function listenToKeys(session: Session, actions: KeyActions): void {
    let turning = false;
    const isTyping = (target: EventTarget | null) =>
        target instanceof HTMLElement && target.closest("input, textarea, select, dialog[open]") !== null;

    document.addEventListener("keyup", (event) => {
        turning = event.key.toLowerCase() === "r" ? false : turning;
    });
    window.addEventListener("blur", () => (turning = false));
    document.addEventListener("keydown", (event) => {
        if (isTyping(event.target) || event.ctrlKey || event.metaKey) {
            return;
        }
        const size = event.shiftKey ? 10 : event.altKey ? 0.1 : 1;
        const along = ALONG[event.key];
        const turn = TURNS[event.key];
        if (along !== undefined && session.description !== null) {
            const [axis, sense] = along;
            if (turning) {
                turnMagnet(session, axis, sense * size * DEGREE);
            } else {
                moveMagnet(session, axis, sense * size * MILLIMETRE);
            }
        } else if (turn !== undefined && session.description !== null) {
            turnMagnet(session, 0, turn * size * DEGREE);
        } else if (event.key === "?") {
            actions.help();
        } else if (event.key.toLowerCase() === "r") {
            turning = true;
            return;
        } else if (event.key === "m") {
            actions.gizmo("translate");
        } else if (event.key === "t") {
            actions.gizmo("rotate");
        } else if (event.key === "f") {
            actions.frame();
        } else {
            return;
        }
        event.preventDefault();
    });
}
