/** Scenes to begin with. */

import demo from "../../../default.toml";
import aorta from "./aorta.toml";

/** Inputs of a time (s), by name, in SI units. */
export interface Waypoint {
    time: number;
    inputs: Record<string, number>;
}

/** A scene with a name, and where it has one, a way of its inputs. */
export interface Preset {
    name: string;
    title: string;
    about: string;
    scene: string;
    way: Waypoint[];
}

const FIG_7A = `# Fig. 7A of the paper: one segment with a ring at either end, in a field across it.
[design]
segments = 1

[field]
uniform_mt = [0.0, 20.0, 0.0]    # the paper goes up to 30 mT

[model]
interaction = "full"
`;

const FIG_7B = `# Fig. 7B of the paper: three segments in 20 mT. A field across turns the tip to 90 degrees at most:
# for the 119 degrees measured, its direction has to turn on.
[design]
segments = 3

[field]
uniform_mt = [0.0, 20.0, 0.0]

[model]
interaction = "full"
bending_stop = true              # adjacent windings touch at 40 degrees of each core
`;

const HYSTERESIS = `# The magnet pair passes nine segments with its field against them, and comes back: they snap over,
# at -18 mm on the way forth and at -23 mm on the way back.
[design]
segments = 9

[magnet]
position_mm = [0.0, -120.0, -40.0]
orientation_wxyz = [1.0, 0.0, 0.0, 0.0]    # magnetised along +z

[model]
interaction = "rings"
bending_stop = true
`;

/** Points of a way, evenly in time. */
function way(seconds: number, steps: number, at: (part: number) => Record<string, number>): Waypoint[] {
    return Array.from({ length: steps + 1 }, (_, step) => ({
        time: (seconds * step) / steps,
        inputs: at(step / steps),
    }));
}

/** A uniform field of `millitesla` at `degrees` from the base's axis, towards +y. */
function uniform(millitesla: number, degrees: number): Record<string, number> {
    const angle = (degrees * Math.PI) / 180;
    const [across, along] = [(millitesla / 1e3) * Math.sin(angle), (millitesla / 1e3) * Math.cos(angle)];
    return { "field.uniform[1]": 0, "field.uniform[2]": across, "field.uniform[3]": along };
}

/** From 0 to 1 and back. */
function thereAndBack(part: number): number {
    return 1 - Math.abs(1 - 2 * part);
}

/** The scenes in the order of the menu; the first is opened where nothing else is asked for. */
export const PRESETS: [Preset, ...Preset[]] = [
    {
        name: "demo",
        title: "Nine segments beside the magnet pair",
        about: "The paper's manipulator, free, 120 mm from the axis of its magnet pair. Drag the magnet.",
        scene: demo,
        way: [],
    },
    {
        name: "fig-7a",
        title: "Fig. 7A: one segment in a field across",
        about: "Play lets the field grow from 0 to 30 mT: the rings help the segment to bend.",
        scene: FIG_7A,
        way: way(12, 120, (part) => uniform(30 * part, 90)),
    },
    {
        name: "fig-7b",
        title: "Fig. 7B: three segments in 20 mT",
        about: "Play turns a field of 20 mT from the base's axis to 170 degrees: the paper's 119 degrees are passed on the way.",
        scene: FIG_7B,
        way: way(15, 170, (part) => uniform(20, 170 * part)),
    },
    {
        name: "hysteresis",
        title: "Hysteresis: snaps forth and back",
        about: "Play passes the magnet along the device and back: it snaps at different places on its two ways.",
        scene: HYSTERESIS,
        way: way(24, 160, (part) => ({ "magnet.position[3]": -0.04 + 0.04 * thereAndBack(part) })),
    },
    {
        name: "aorta",
        title: "In an abdominal aorta",
        about: "Nine segments at the end of a silicone tube, in an iliac artery. Push the shaft in and lead it with the magnet.",
        scene: aorta,
        way: [],
    },
];

/** The scene that the page was built with, if there is one: its build writes name and text into an element `scene`. */
export function builtIn(): Preset | null {
    const text = document.getElementById("scene")?.textContent?.trim() ?? "";
    if (text === "") {
        return null;
    }
    const { name, text: scene } = JSON.parse(text) as { name: string; text: string };
    return {
        name: "built-in",
        title: name,
        about: "The scene that this page was built with.",
        scene,
        way: [],
    };
}
