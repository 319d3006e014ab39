/** The page's side of the worker that computes. */

import { trianglesOf } from "./mesh";
import { packed, unpacked } from "./packed";
import type { Reply, Request } from "./protocol";
import type { Start } from "./worker";

/** A worker with the core. */
export class Solver {
    /** Requests made before the core was there. */
    private waiting: Request[] | null = [];
    private readonly worker: Worker;
    /** Triangles of the mesh that comes with the page. */
    private triangles: number[] = [];

    /** Starts the core; `reply` gets all that it says, first `ready`. */
    constructor(private readonly reply: (reply: Reply) => void) {
        const code = document.getElementById("worker")?.textContent ?? "";
        const place = URL.createObjectURL(new Blob([code], { type: "text/javascript" }));
        this.worker = new Worker(place);
        this.worker.onerror = (event) => reply({ kind: "broken", message: event.message });
        this.worker.onmessage = (event: MessageEvent<Reply>) => {
            if (event.data.kind === "ready") {
                URL.revokeObjectURL(place);
                void this.begin(event.data);
                return;
            }
            if (event.data.kind === "opened" && event.data.description.vessel?.branches.length === 0) {
                event.data.description.vessel.triangles = this.triangles;
            }
            reply(event.data);
        };
        // Unpacked over there, while this side builds its picture.
        const start: Start = { code: packed("core"), grid: packed("grid") };
        this.worker.postMessage(start);
    }

    /** Sends a request, once the core is there. */
    send(request: Request): void {
        if (this.waiting === null) {
            this.worker.postMessage(request);
        } else {
            this.waiting.push(request);
        }
    }

    /** Takes the mesh, which a scene may need, then sends what has waited. */
    private async begin(ready: Reply): Promise<void> {
        try {
            const stl = await unpacked(packed("mesh"));
            this.triangles = stl.byteLength > 0 ? trianglesOf(stl) : [];
        } catch (error) {
            this.reply({ kind: "broken", message: String(error) });
            return;
        }
        const requests = this.waiting ?? [];
        this.waiting = null;
        requests.forEach((request) => this.send(request));
        this.reply(ready);
    }
}
