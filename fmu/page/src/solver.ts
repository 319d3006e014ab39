/** The page's side of the worker that computes. */

import { trianglesOf } from "./mesh";
import type { Reply, Request } from "./protocol";
import type { Start } from "./worker";

/** The bytes, unpacked, of an element of the page that holds them as base64 of gzip; none where there is no such element. */
async function embedded(id: string): Promise<ArrayBuffer> {
    const text = document.getElementById(id)?.textContent?.trim() ?? "";
    if (text === "") {
        return new ArrayBuffer(0);
    }
    const packed = await fetch(`data:application/gzip;base64,${text}`);
    return new Response(packed.body!.pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

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
                const requests = this.waiting ?? [];
                this.waiting = null;
                requests.forEach((request) => this.send(request));
            }
            if (event.data.kind === "opened" && event.data.description.vessel?.branches.length === 0) {
                event.data.description.vessel.triangles = this.triangles;
            }
            reply(event.data);
        };
        void this.start();
    }

    /** Sends a request, once the core is there. */
    send(request: Request): void {
        if (this.waiting === null) {
            this.worker.postMessage(request);
        } else {
            this.waiting.push(request);
        }
    }

    private async start(): Promise<void> {
        try {
            const start: Start = { code: await embedded("core"), grid: await embedded("grid") };
            const mesh = await embedded("mesh");
            this.triangles = mesh.byteLength > 0 ? trianglesOf(mesh) : [];
            this.worker.postMessage(start, [start.code, start.grid]);
        } catch (error) {
            this.reply({ kind: "broken", message: String(error) });
        }
    }
}
