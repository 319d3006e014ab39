/** The core: the Rust library as WebAssembly, called through its C functions. */

import type { Description } from "./protocol";

interface Exports {
    memory: WebAssembly.Memory;
    mcm_text(bytes: number): number;
    mcm_grid(bytes: number): number;
    mcm_inputs(count: number): number;
    mcm_way(count: number): number;
    mcm_scene_at(number: number): number;
    mcm_said(): number;
    mcm_said_bytes(): number;
    mcm_outputs(): number;
    mcm_outputs_count(): number;
    mcm_open(number: number): number;
    mcm_open_at_level(number: number, other: number, level: number): number;
    mcm_close(number: number): void;
    mcm_load(number: number): number;
    mcm_step(number: number): number;
    mcm_measure(number: number): number;
}

/** Why a scene is not read, a line for each fault. */
export class Refusal extends Error {}

/** What a device has answered. */
export interface Result {
    solved: boolean;
    outputs: Float64Array;
    /** What it said, a line each. */
    said: string;
}

/** A running core, with devices called by numbers. */
export class Core {
    private constructor(private readonly exports: Exports) {}

    /** Starts a core. */
    static async start(module: WebAssembly.Module): Promise<Core> {
        const page = { seconds: () => performance.now() / 1000 };
        const instance = await WebAssembly.instantiate(module, { page });
        return new Core(instance.exports as unknown as Exports);
    }

    /** Opens the device of a scene under a number; `grid` is the distance grid of the mesh that the scene names, if it does. */
    open(number: number, scene: string, grid: Uint8Array): Description {
        const text = new TextEncoder().encode(scene);
        this.bytes(this.exports.mcm_text(text.length), text.length).set(text);
        this.bytes(this.exports.mcm_grid(grid.length), grid.length).set(grid);
        const opened = this.exports.mcm_open(number);
        const said = this.said();
        if (opened === 0) {
            throw new Refusal(said);
        }
        return JSON.parse(said) as Description;
    }

    /** Opens a device once more, under another number and by the level with this index. */
    openAtLevel(number: number, other: number, level: number): void {
        this.exports.mcm_open_at_level(number, other, level);
    }

    /** The text of a device's scene at these inputs, with the way to them. */
    sceneAt(number: number, inputs: Float64Array, points: Float64Array[]): string {
        this.numbers(this.exports.mcm_inputs(inputs.length), inputs.length).set(inputs);
        const count = points.length * inputs.length;
        const way = this.numbers(this.exports.mcm_way(count), count);
        points.forEach((point, row) => way.set(point, row * inputs.length));
        const written = this.exports.mcm_scene_at(number);
        const said = this.said();
        if (written === 0) {
            throw new Refusal(said);
        }
        return said;
    }

    close(number: number): void {
        this.exports.mcm_close(number);
    }

    /** Loads a device at these inputs, from its unloaded shape. */
    load(number: number, inputs: Float64Array): Result {
        return this.answer(inputs, this.exports.mcm_load, number);
    }

    /** Moves a device on to these inputs. */
    step(number: number, inputs: Float64Array): Result {
        return this.answer(inputs, this.exports.mcm_step, number);
    }

    /** Measures the stability margin of a device, of which steps give an upper bound. */
    measure(number: number): Result {
        return this.answer(new Float64Array(), this.exports.mcm_measure, number);
    }

    private answer(inputs: Float64Array, call: (number: number) => number, number: number): Result {
        const place = this.exports.mcm_inputs(inputs.length);
        new Float64Array(this.exports.memory.buffer, place, inputs.length).set(inputs);
        const solved = call(number) !== 0;
        // The memory may have grown meanwhile, and the next call overwrites what is there.
        const count = this.exports.mcm_outputs_count();
        const outputs = new Float64Array(
            this.exports.memory.buffer,
            this.exports.mcm_outputs(),
            count,
        ).slice();
        return { solved, outputs, said: this.said() };
    }

    private said(): string {
        return new TextDecoder().decode(this.bytes(this.exports.mcm_said(), this.exports.mcm_said_bytes()));
    }

    private numbers(place: number, length: number): Float64Array {
        return new Float64Array(this.exports.memory.buffer, place, length);
    }

    private bytes(place: number, length: number): Uint8Array {
        return new Uint8Array(this.exports.memory.buffer, place, length);
    }
}
