/** The session with the core: the scene that is open, the inputs asked for, and the newest answer. */

import {
    type Answer,
    type Carriage,
    type Carried,
    type Description,
    Places,
    type Reply,
    type Request,
    startOf,
} from "../protocol";

/** Who changed inputs: the 3-D view, the controls, a way that is played, or a scene that was opened. */
export type Origin = "view" | "controls" | "way" | "opened";

/** What others want to know of the session. */
export interface Listener {
    ready?(seconds: number): void;
    opened?(description: Description): void;
    /** The scene was not read, and the one before goes on. */
    refused?(faults: string[]): void;
    answered?(answer: Answer): void;
    /** The inputs asked for are others than before. */
    changed?(origin: Origin): void;
    broken?(message: string): void;
}

/** Whether two arrays hold the same numbers. */
export function same(one: Float64Array, other: Float64Array): boolean {
    return one.length === other.length && one.every((value, place) => Object.is(value, other[place]));
}

/** What is asked of the device that is open. */
type DeviceRequest = Exclude<Request, { kind: "open" | "carry" }>;

/** What was sent to be opened: the scene, and inputs that shall differ from its start. */
interface Asked {
    scene: string;
    inputs: Record<string, number>;
}

/** Sends requests to the core, at most one move a frame, and tells all listeners what comes back. */
export class Session {
    /** Text of the scene that is open. */
    scene = "";
    description: Description | null = null;
    places: Places | null = null;
    inputs: Float64Array = new Float64Array();
    /** Inputs at the scene's start. */
    start: Float64Array = new Float64Array();
    /** The newest answer that is not behind newer inputs. */
    answer: Answer | null = null;
    /** Why the last text was not read. */
    faults: string[] = [];

    private readonly listeners: Listener[] = [];
    private readonly opening: Asked[] = [];
    /** Number of answers to come from a device loaded anew. */
    private loading = 0;
    private frame = 0;
    /** What was asked of the device while another scene was opened: it is of no use to that one, and sent only if the scene is refused. */
    private held: DeviceRequest[] = [];
    /** Who waits to be told what a scene carries. */
    private readonly carrying: ((carried: Carried | null) => void)[] = [];

    constructor(private readonly send: (request: Request) => void) {}

    listen(listener: Listener): void {
        this.listeners.push(listener);
    }

    /** Whether an answer by the model asked for is still to come. */
    get busy(): boolean {
        const answer = this.answer;
        const reached = answer !== null && answer.final && same(answer.inputs, this.inputs);
        return this.opening.length > 0 || this.loading > 0 || !reached;
    }

    /** Opens a scene. Where `inputs` are given, the device is loaded with these in place of the scene's start values. */
    open(scene: string, inputs: Record<string, number> = {}): void {
        this.opening.push({ scene, inputs });
        this.send({ kind: "open", scene, inputs });
    }

    /** Which of these ways leads a new device to the present shape; null where there is none, or another scene is opened meanwhile. */
    carry(ways: Carriage[]): Promise<Carried | null> {
        const answer = this.answer;
        if (answer === null || this.opening.length > 0) {
            return Promise.resolve(null);
        }
        this.send({
            kind: "carry",
            scene: this.scene,
            ways,
            inputs: this.inputs.slice(),
            outputs: answer.outputs,
        });
        return new Promise((keep) => this.carrying.push(keep));
    }

    /** Loads the device anew at the present inputs, or at others. */
    restart(inputs: Float64Array = this.inputs): void {
        this.take(inputs);
        this.ask({ kind: "restart", inputs: inputs.slice() });
        this.tell("changed", "way");
    }

    /** Asks for some inputs, by name; those that the device has not, or that are no numbers, are left out. */
    set(values: Record<string, number>, origin: Origin): void {
        const known = Object.entries(values).filter(([, value]) => Number.isFinite(value));
        this.places?.put(this.inputs, Object.fromEntries(known));
        // A hand moves more often than the screen is drawn: only the newest inputs of a frame are sent.
        this.frame ||= requestAnimationFrame(() => {
            this.frame = 0;
            this.ask({ kind: "move", inputs: this.inputs.slice(), every: false });
        });
        this.tell("changed", origin);
    }

    /** Asks for these inputs, to be solved by the model asked for even if others follow. */
    follow(inputs: Float64Array): void {
        this.take(inputs);
        this.ask({ kind: "move", inputs: inputs.slice(), every: true });
        this.tell("changed", "way");
    }

    /** Asks the present device, unless another scene is being opened. */
    private ask(request: DeviceRequest): void {
        if (this.opening.length > 0) {
            this.held.push(request);
            return;
        }
        if (request.kind === "restart") {
            this.loading += 1;
        }
        this.send(request);
    }

    /** An input asked for; not a number where the device has none of this name. */
    input(name: string): number {
        const place = this.places?.input(name);
        return place === undefined ? NaN : (this.inputs[place] ?? NaN);
    }

    /** Inputs that differ from the scene's start. */
    moved(): Record<string, number> {
        const inputs = this.description?.inputs ?? [];
        const moved = inputs.filter((_, place) => this.inputs[place] !== this.start[place]);
        return Object.fromEntries(moved.map(({ name }) => [name, this.input(name)]));
    }

    /** Takes what the core says. */
    receive(reply: Reply): void {
        switch (reply.kind) {
            case "ready":
                this.tell("ready", reply.seconds);
                break;
            case "opened":
                this.enter(reply.description);
                break;
            case "refused":
                this.opening.shift();
                this.loading = 0;
                this.faults = reply.message.split("\n").filter((line) => line.trim() !== "");
                this.held.splice(0).forEach((request) => this.ask(request));
                this.tell("refused", this.faults);
                break;
            case "answer":
                this.note(reply.answer);
                break;
            case "carried":
                this.carrying.shift()?.(reply.carried);
                break;
            case "broken":
                this.carrying.splice(0).forEach((keep) => keep(null));
                this.tell("broken", reply.message);
                break;
        }
    }

    private enter(description: Description): void {
        // The core opens the last scene again by itself when it was started anew: then nothing was asked.
        const asked = this.opening.shift() ?? { scene: this.scene, inputs: {} };
        this.scene = asked.scene;
        this.faults = [];
        this.held = [];
        this.description = description;
        this.places = new Places(description);
        this.answer = null;
        this.start = startOf(description);
        this.take(this.start);
        this.loading = 1;
        this.places.put(this.inputs, asked.inputs);
        this.tell("opened", description);
        this.tell("changed", "opened");
    }

    private note(answer: Answer): void {
        if (answer.inputs.length !== this.inputs.length) {
            return;
        }
        if (answer.first && answer.final) {
            this.loading = Math.max(0, this.loading - 1);
        }
        if (!answer.behind) {
            this.answer = answer;
        }
        this.tell("answered", answer);
    }

    /** Makes these the inputs asked for; a move that waits for the next frame is dropped. */
    private take(inputs: Float64Array): void {
        this.inputs = inputs.slice();
        cancelAnimationFrame(this.frame);
        this.frame = 0;
    }

    private tell<K extends keyof Listener>(event: K, ...what: Parameters<NonNullable<Listener[K]>>): void {
        for (const listener of this.listeners) {
            const hear = listener[event] as ((...what: unknown[]) => void) | undefined;
            hear?.apply(listener, what);
        }
    }
}
