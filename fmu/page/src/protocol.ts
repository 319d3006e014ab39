/** What page and worker say to each other. All values are in SI units, names are those of the FMU's variables. */

/** Interaction levels of the model in the FMU's order, cheapest first; `auto` chooses by the tolerances asked for. */
export const LEVELS = ["none", "preceding", "rings", "full", "auto"] as const;
export type Level = (typeof LEVELS)[number];

/** An input or output of the device. */
export interface Variable {
    /** Name in the FMU, such as `magnet.position[1]`. */
    name: string;
    /** SI unit; "1" for a pure number. */
    unit: string;
    description: string;
    /** Value at the start; null for an output. */
    start: number | null;
    min: number | null;
    max: number | null;
}

/** The spiral on a core: a sector that turns about the axis. At a fraction `u` of the core it begins at the angle
 * `start + turn * 2 pi windings u` from the first director. */
export interface Spiral {
    innerRadius: number;
    outerRadius: number;
    /** Angle of the sector, rad. */
    sectorAngle: number;
    windings: number;
    /** 1 right-handed, -1 left-handed, 0 spread evenly over the circle. */
    turn: -1 | 0 | 1;
    start: number;
}

/** A body of the device, base to tip. */
export interface Body {
    kind: "ring" | "disc" | "core" | "rod";
    /** Arc length at which it begins, m, from the device's base (not from the port: a shaft comes before it). */
    begin: number;
    length: number;
    innerRadius: number;
    outerRadius: number;
    /** Remanence of a ring, polarisation of other bodies, T, along the device's axis; its sign says where north is. */
    remanence: number;
    spiral: Spiral | null;
    /** Angle by which it bends until adjacent windings touch, rad. */
    boundaryAngle: number | null;
}

/** The shape of a part of a magnet or coil, about or along the axes of its source, m. */
export type Solid =
    | { shape: "cylinder"; innerRadius: number; outerRadius: number; length: number }
    | { shape: "cuboid"; size: [number, number, number] }
    | { shape: "sphere"; radius: number };

/** A part of a magnet or coil. */
export type Part = Solid & {
    /** Place of its centre along the source's z axis, m. */
    offset: number;
    /** Remanence, T: north lies where it points. */
    remanence: [number, number, number];
    /** Volume, m3. */
    volume: number;
};

/**
 * A magnet after the first one, or a coil. The part of a coil is its winding, with the remanence that has its dipole moment of one
 * ampere.
 */
export interface Source {
    /** Beginning of the names of its inputs, such as `magnet[2]` or `coil[1]`. */
    name: string;
    coil: boolean;
    parts: Part[];
}

/** A branch of a vessel: balls along its centreline, closely spaced; x, y, z and radius of each, m. */
export interface Branch {
    name: string;
    balls: number[];
}

/** What a scene holds, as far as the page needs it. */
export interface Description {
    /** The model that the scene asks for. */
    level: Level;
    /** Inputs of the device, in the order of all arrays of inputs. */
    inputs: Variable[];
    /** Outputs, in the order of all arrays of outputs. */
    outputs: Variable[];
    /** Number of points of the centreline among the outputs. */
    shapePoints: number;
    bodies: Body[];
    /** Radii of the tube behind the base; null for a clamped device. */
    shaft: { innerRadius: number; outerRadius: number } | null;
    /** How the device is held at its base: without a shaft, by its shaft's length, or by a push on it. */
    feedMode: "clamped" | "insertion" | "force";
    /** Radius of the wire inside; null for none. */
    guidewire: { radius: number } | null;
    /** The external magnet; empty where the scene has none (its strength is then 0). */
    magnet: Part[];
    /** Further magnets, then coils. */
    further: Source[];
    /** The vessel; null for none. A vessel from a mesh has no branches, but triangles: nine numbers each, m. */
    vessel: { branches: Branch[]; triangles: number[] } | null;
}

/** How a step ended: `solver.status` of the FMU. */
export enum Status {
    Solved = 0,
    NearFold = 1,
    Snapped = 2,
    NotSolved = 3,
}

/** The device's answer to inputs. */
export interface Answer {
    /** The inputs that were to be reached. */
    inputs: Float64Array;
    /** Outputs; not a number where one has no value yet. Where the step was not solved they are the last good ones. */
    outputs: Float64Array;
    status: Status;
    /** What the device said: why a step failed, that it snapped, that a fold is near. Empty for nothing. */
    message: string;
    /** The model that answered. */
    level: Level;
    /** Whether that is the model that the scene asks for, so that its tolerances hold; else a cheaper one fills in. */
    final: boolean;
    /** Whether the device is still behind newer inputs: a point on its way, for the record, but not to be drawn. */
    behind: boolean;
    /** Whether this is the last answer once more, with the stability margin measured: steps give an upper bound of it. */
    measured: boolean;
    /** Whether this is the first answer of a device loaded anew (scene opened, restart); where a cheaper model fills in meanwhile, each of the
     * two models has one. */
    first: boolean;
    /** Time that the step took, ms. */
    cost: number;
}

/** A row of a scene's way: inputs by name. */
export type WayRow = Record<string, number>;

/** From the page to the worker. */
export type Request =
    /** Reads a scene and loads the device at its start, where `inputs` do not say otherwise. Answered by `opened` and `answer`, or by
     * `refused`. */
    | { kind: "open"; scene: string; inputs: Record<string, number> }
    /** Asks which of several ways leads a new device to these inputs and to the shape of these outputs. Answered by `carried`. */
    | { kind: "carry"; scene: string; ways: Carriage[]; inputs: Float64Array; outputs: Float64Array }
    /** Loads the device anew, at these inputs. */
    | { kind: "restart"; inputs: Float64Array }
    /** Moves on to these inputs. The newest wins where they come faster than answers, unless `every` is set: then each is solved,
     * by the model that the scene asks for, in turn. */
    | { kind: "move"; inputs: Float64Array; every: boolean };

/** A way that a scene could carry: its text as tables of a scene, and its rows of all inputs. */
export interface Carriage {
    text: string;
    points: Float64Array[];
}

/** What a scene carries. */
export interface Carried {
    /** Which of the ways it is: the first one that leads to the shape, or else the last. */
    way: number;
    /** Largest distance of the centreline to which it leads from that of the device, m; not a number where it leads nowhere. */
    apart: number;
    /** The text of the scene with this way at these inputs. */
    scene: string;
}

/** From the worker to the page. */
export type Reply =
    /** The core can be used; `seconds` it took. */
    | { kind: "ready"; seconds: number }
    | { kind: "opened"; description: Description }
    /** The scene is not read, and the one before goes on; a line for each fault. */
    | { kind: "refused"; message: string }
    | { kind: "answer"; answer: Answer }
    | { kind: "carried"; carried: Carried }
    /** The core failed in a way that it should not; the page must be loaded anew. */
    | { kind: "broken"; message: string };

/** Values of all inputs at the scene's start. */
export function startOf(description: Description): Float64Array {
    return Float64Array.from(description.inputs, (input) => input.start ?? 0);
}

/** Where variables stand in the arrays of a description. */
export class Places {
    private readonly inputs: Map<string, number>;
    private readonly outputs: Map<string, number>;

    constructor(description: Description) {
        const places = (of: Variable[]) => new Map(of.map((variable, place) => [variable.name, place]));
        this.inputs = places(description.inputs);
        this.outputs = places(description.outputs);
    }

    /** Place of an input; undefined where the device has none of this name. */
    input(name: string): number | undefined {
        return this.inputs.get(name);
    }

    /** Place of an output; undefined where the device has none of this name. */
    outputPlace(name: string): number | undefined {
        return this.outputs.get(name);
    }

    /** Puts values of inputs into their places; those that the device has not are left out. */
    put(inputs: Float64Array, values: Record<string, number>): void {
        for (const [name, value] of Object.entries(values)) {
            const place = this.input(name);
            if (place !== undefined) {
                inputs[place] = value;
            }
        }
    }

    /** An output of an answer; not a number where there is none. */
    output(answer: Answer, name: string): number {
        const place = this.outputPlace(name);
        return place === undefined ? NaN : (answer.outputs[place] ?? NaN);
    }

    /** The output `name[1]`, `name[2]`, `name[3]`. */
    vector(answer: Answer, name: string): [number, number, number] {
        return [1, 2, 3].map((k) => this.output(answer, `${name}[${k}]`)) as [number, number, number];
    }
}
