/** The state of the page as the part of its address after the `#`. */

import type { WayRow } from "../protocol";
import { PRESETS } from "./presets";
import type { Theme } from "./theme";
import { MOST_ROWS } from "./trail";

/** What a link holds. */
export interface Linked {
    scene: string;
    /** Inputs that differ from the scene's start, by name, SI. */
    inputs: Record<string, number>;
    /** Rows of the way to them, which follow those of the scene. */
    way: WayRow[];
    overlays: string[];
    theme: Theme | null;
}

/** Of the form below: a later one must not be misread. */
const VERSION = "1.";

/** The longest state that a link may unpack to, bytes: a broken link must not fill the memory. */
const LONGEST = 2_000_000;

/** The hash of a state: JSON, deflated, in the base64 of addresses. The text of a preset is not repeated. */
export async function hashOf({ scene, inputs, way, overlays, theme }: Linked): Promise<string> {
    const preset = PRESETS.find((known) => known.scene === scene);
    const named = preset === undefined ? { scene } : { preset: preset.name };
    const state = JSON.stringify({ ...named, inputs, way, overlays, theme });
    const packed = await through(new TextEncoder().encode(state), new CompressionStream("deflate-raw"));
    const binary = Array.from(packed, (byte) => String.fromCharCode(byte)).join("");
    const text = btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
    return `#${VERSION}${text}`;
}

/** The state in a hash; an error says in words what is wrong with it. */
export async function linkedBy(hash: string): Promise<Linked> {
    const text = hash.replace(/^#/, "");
    if (!text.startsWith(VERSION)) {
        throw new Error("it is of another version of this page");
    }
    let state: unknown;
    try {
        const binary = atob(text.slice(VERSION.length).replaceAll("-", "+").replaceAll("_", "/"));
        const packed = Uint8Array.from(binary, (character) => character.charCodeAt(0));
        const bytes = await through(packed, new DecompressionStream("deflate-raw"));
        state = JSON.parse(new TextDecoder().decode(bytes));
    } catch {
        throw new Error("it is damaged, or not complete");
    }
    return checked(state);
}

async function through(
    bytes: Uint8Array<ArrayBuffer>,
    change: CompressionStream | DecompressionStream,
): Promise<Uint8Array> {
    const reader = new Blob([bytes]).stream().pipeThrough(change).getReader();
    const parts: number[] = [];
    for (;;) {
        const { done, value } = await reader.read();
        if (done) {
            return Uint8Array.from(parts);
        }
        for (const byte of value) {
            parts.push(byte);
        }
        if (parts.length > LONGEST) {
            await reader.cancel();
            throw new Error("too long");
        }
    }
}

/** A link comes from anywhere: every part is looked at before it is used. */
function checked(state: unknown): Linked {
    if (typeof state !== "object" || state === null) {
        throw new Error("it holds no state");
    }
    const { preset, scene, inputs, way, overlays, theme } = state as Record<string, unknown>;
    const known = PRESETS.find(({ name }) => name === preset)?.scene;
    const text = typeof scene === "string" ? scene : known;
    if (text === undefined) {
        throw new Error("it names a scene that this page does not know");
    }
    const rows = Array.isArray(way) ? way.slice(0, MOST_ROWS) : [];
    const words = Array.isArray(overlays) ? overlays.filter((word) => typeof word === "string") : [];
    return {
        scene: text,
        inputs: numbersOf(inputs),
        way: rows.map(numbersOf),
        overlays: words,
        theme: theme === "light" || theme === "dark" ? theme : null,
    };
}

/** The finite numbers among values, by names that can be those of inputs. */
function numbersOf(values: unknown): Record<string, number> {
    const entries = typeof values === "object" && values !== null ? Object.entries(values) : [];
    const numbers = entries.filter((entry): entry is [string, number] => Number.isFinite(entry[1]));
    return Object.fromEntries(numbers.filter(([name]) => /^[a-z_.[\]0-9]+$/.test(name)));
}
