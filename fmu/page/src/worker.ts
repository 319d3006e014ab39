/** The worker: keeps the core, takes requests of the page, and steps between them. */

import { Core, Refusal } from "./core";
import { unpacked } from "./packed";
import { carried } from "./carry";
import { type Answer, Places, type Reply, type Request, startOf } from "./protocol";
import { Schedule } from "./schedule";

/** What the page sends first, packed: the core's code, and the distance grid of the mesh that comes with the page (empty for none). */
export interface Start {
    code: string;
    grid: string;
}

let module: WebAssembly.Module;
let core: Core;
let grid = new Uint8Array();
let scene = "";
let schedule: Schedule | null = null;
let planned: ReturnType<typeof setTimeout> | "at once" | null = null;
const again = new MessageChannel();

function reply(message: Reply): void {
    postMessage(message);
}

function answered(answer: Answer): void {
    reply({ kind: "answer", answer });
}

function open(text: string, wanted: Record<string, number>): void {
    const description = core.open(0, text, grid);
    schedule = new Schedule(core, description);
    scene = text;
    reply({ kind: "opened", description });
    const inputs = startOf(description);
    new Places(description).put(inputs, wanted);
    schedule.load(inputs, answered);
}

function take(request: Request): void {
    switch (request.kind) {
        case "open":
            open(request.scene, request.inputs);
            break;
        case "carry":
            reply({ kind: "carried", carried: carried(core, grid, request) });
            break;
        case "restart":
            schedule?.load(request.inputs, answered);
            break;
        case "move":
            schedule?.move(request.inputs, request.every, performance.now());
            break;
    }
}

/** Takes one step, and comes again while there are more: requests are read in between. */
function work(): void {
    planned = null;
    guarded(() => {
        const answer = schedule?.work(performance.now());
        if (answer != null) {
            answered(answer);
        }
    });
    wake();
}

/** Plans the next step, as soon as it must be; the plan made before gives way to it. */
function wake(): void {
    if (planned === "at once" || schedule === null || !schedule.busy) {
        return;
    }
    if (planned !== null) {
        clearTimeout(planned);
    }
    const wait = schedule.wait(performance.now());
    if (wait > 0) {
        planned = setTimeout(work, wait);
    } else {
        planned = "at once";
        again.port2.postMessage(null); // a timer would wait for 4 ms
    }
}

/** Does this; a scene that is refused is told, and a core that has ended is started anew with the last scene that it knew. */
function guarded(does: () => void): void {
    try {
        does();
    } catch (error) {
        if (error instanceof Refusal) {
            reply({ kind: "refused", message: error.message });
        } else {
            void revive(String(error));
        }
    }
}

async function revive(reason: string): Promise<void> {
    schedule = null;
    try {
        core = await Core.start(module);
        reply({ kind: "refused", message: `the core ended (${reason}) and was started anew` });
        if (scene !== "") {
            open(scene, {});
        }
    } catch (error) {
        reply({ kind: "broken", message: `${reason}; ${String(error)}` });
    }
}

async function start(packed: Start): Promise<void> {
    const begin = performance.now();
    try {
        module = await WebAssembly.compile(await unpacked(packed.code));
        core = await Core.start(module);
        grid = new Uint8Array(await unpacked(packed.grid));
    } catch (error) {
        reply({ kind: "broken", message: String(error) });
        return;
    }
    onmessage = (event: MessageEvent<Request>) => {
        guarded(() => take(event.data));
        wake();
    };
    reply({ kind: "ready", seconds: (performance.now() - begin) / 1000 });
}

again.port1.onmessage = work;
onmessage = (event: MessageEvent<Start>) => void start(event.data);
