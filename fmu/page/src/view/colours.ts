import { Color } from "three";

/** Colours of all that is drawn, in one theme. */
export interface Palette {
    background: string;
    grid: string;
    text: string;
    rubber: Color;
    winding: Color;
    shaft: Color;
    clamp: Color;
    wall: Color;
    north: Color;
    south: Color;
    plain: Color;
    wire: Color;
    trace: Color;
    field: Color;
    ringField: Color;
    magneticForce: Color;
    reaction: Color;
    load: Color;
    contact: Color;
    /** What a device is mixed with while its shape is not final. */
    pale: Color;
}

const shared = {
    north: new Color("#d8372f"),
    south: new Color("#2b63d6"),
    plain: new Color("#9aa1aa"),
    clamp: new Color("#8b949e"),
};

/** On a light page. */
export const LIGHT: Palette = {
    ...shared,
    background: "#f5f7f9",
    grid: "#8fa0b3",
    text: "#46515e",
    rubber: new Color("#3f4650"),
    winding: new Color("#727b87"),
    shaft: new Color("#d9d3c4"),
    wall: new Color("#d0665a"),
    wire: new Color("#b8860b"),
    trace: new Color("#0f8f7f"),
    field: new Color("#7b2fbf"),
    ringField: new Color("#a77fd0"),
    magneticForce: new Color("#c2255c"),
    reaction: new Color("#5f6b78"),
    load: new Color("#d9730d"),
    contact: new Color("#0b8a6a"),
    pale: new Color("#ffffff"),
};

/** On a dark page. */
export const DARK: Palette = {
    ...shared,
    background: "#12161b",
    grid: "#52606f",
    text: "#aab4c0",
    rubber: new Color("#5a636f"),
    winding: new Color("#98a3b0"),
    shaft: new Color("#cfc7b4"),
    wall: new Color("#ffbdb1"),
    wire: new Color("#ffd24a"),
    trace: new Color("#35e0c4"),
    field: new Color("#c58bff"),
    ringField: new Color("#8f6bc0"),
    magneticForce: new Color("#ff6b9a"),
    reaction: new Color("#b4bfcb"),
    load: new Color("#ffa94d"),
    contact: new Color("#3ddc9f"),
    pale: new Color("#dfe6ee"),
};

/** The colour of cores whose windings touch. */
export const TOUCHING = new Color("#ff7a1a");

/** Viridis at equal distances: lightness grows evenly, so that equal steps of bending look equal, also to the colour-blind. */
const VIRIDIS = [
    "#440154",
    "#482878",
    "#3e4a89",
    "#31688e",
    "#26828e",
    "#1f9e89",
    "#35b779",
    "#6ece58",
    "#b5de2b",
    "#fde725",
].map((colour) => new Color(colour));

/** Colour of a core that has bent by this fraction of its boundary angle, in the view and in a legend beside it. */
export function bendingColour(fraction: number, colour = new Color()): Color {
    // The dark end would not stand out from a dark page.
    const place = (0.1 + 0.9 * Math.min(1, Math.max(0, fraction))) * (VIRIDIS.length - 1);
    const below = Math.min(VIRIDIS.length - 2, Math.floor(place));
    return colour.lerpColors(VIRIDIS[below]!, VIRIDIS[below + 1]!, place - below);
}
