/** Quantities that a person sets with a slider: inputs of the device in the units of the page. */

import type { Description } from "../protocol";

/** An input as it is shown. */
export interface Quantity {
    /** Name of the input in the FMU. */
    name: string;
    label: string;
    unit: string;
    /** Units shown in an SI unit. */
    factor: number;
    /** Ends of the slider, in the unit shown; numbers beyond may be typed where the device allows them. */
    from: number;
    to: number;
    step: number;
}

const AXES = ["x", "y", "z"];

/** How far beyond the magnet's start, and beyond the vessel, its slider goes, mm. */
const REACH = 150;

/** Position of the magnet. The ends of the sliders leave room around the device, a vessel and the magnet's start. */
export function positionOf(description: Description): Quantity[] {
    return AXES.map((label, axis) => {
        const name = `magnet.position[${axis + 1}]`;
        const start = 1e3 * (description.inputs.find((input) => input.name === name)?.start ?? 0);
        const balls = description.vessel?.branches.flatMap((branch) => branch.balls) ?? [];
        const passed = [0, start, ...balls.filter((_, place) => place % 4 === axis).map((m) => 1e3 * m)];
        const ends = passed.reduce(([low, high], mm) => [Math.min(low!, mm), Math.max(high!, mm)], [0, 0]);
        const [from, to] = [tens(ends[0]! - REACH), tens(ends[1]! + REACH)];
        return { name, label, unit: "mm", factor: 1e3, from, to, step: 0.1 };
    });
}

function tens(value: number): number {
    return 10 * Math.round(value / 10);
}

/** Strength of the magnet. */
export const STRENGTH: Quantity = {
    name: "magnet.strength",
    label: "Strength",
    unit: "",
    factor: 1,
    from: 0,
    to: 1.5,
    step: 0.01,
};

/** The uniform field. */
export const FIELD: Quantity[] = AXES.map((label, axis) => ({
    name: `field.uniform[${axis + 1}]`,
    label,
    unit: "mT",
    factor: 1e3,
    from: -50,
    to: 50,
    step: 0.1,
}));

/** The force on the tip. */
export const LOAD: Quantity[] = AXES.map((label, axis) => ({
    name: `tip.load_force[${axis + 1}]`,
    label,
    unit: "mN",
    factor: 1e3,
    from: -50,
    to: 50,
    step: 0.1,
}));

/** What is pushed in and turned at the port, by the mode of the feed. */
export function feedOf(description: Description): Quantity[] {
    const mode = description.feedMode;
    const degrees = 180 / Math.PI;
    const push = { name: "feed.force", label: "Push", unit: "mN", factor: 1e3, from: -200, to: 200, step: 1 };
    const reach = reachOf(description);
    const insertion = { name: "feed.insertion", label: "Insertion", unit: "mm", factor: 1e3, step: 0.1 };
    const wire = { name: "guidewire.insertion", label: "Guidewire", unit: "mm", factor: 1e3, step: 0.1 };
    const roll = {
        name: "feed.roll",
        label: "Roll",
        unit: "deg",
        factor: degrees,
        from: -180,
        to: 180,
        step: 0.5,
    };
    const shaft: Quantity[] = [mode === "force" ? push : { ...insertion, from: 0, to: reach }, roll];
    const offered = [...(mode === "clamped" ? [] : shaft), { ...wire, from: 0, to: reach + 100 }];
    return offered.filter(({ name }) => description.inputs.some((input) => input.name === name));
}

/** Length of the longest branch, mm, within which a shaft is pushed; 200 without a vessel. */
function reachOf(description: Description): number {
    const lengths = (description.vessel?.branches ?? []).map(({ balls }) => {
        let length = 0;
        for (let ball = 4; ball + 3 < balls.length; ball += 4) {
            const apart = [0, 1, 2].map((axis) => balls[ball + axis]! - balls[ball - 4 + axis]!);
            length += 1e3 * Math.hypot(...apart);
        }
        return length;
    });
    return lengths.length === 0 ? 200 : Math.min(1000, tens(Math.max(...lengths)));
}
