/** Warns before a fold, tells snaps, and says where the device was not solved. */

import { type Answer, Status } from "../protocol";
import { Approach, inWords } from "./approach";
import type { Banners } from "./banners";
import { written } from "./number";
import type { Session } from "./session";

/** How long a snap is told, s. */
const SNAP_TOLD = 6;

/** Listens to the answers. `seconds` is the time since the device was loaded. */
export class Warnings {
    /** Ways by model, and by whether margins are measured or bounds: only margins of one kind are compared. */
    private ways = new Map<string, Approach>();
    private lastTip: number[] = [];

    constructor(
        private readonly session: Session,
        private readonly banners: Banners,
        private readonly seconds: () => number,
    ) {
        session.listen({
            opened: () => this.clear(),
            answered: (answer) => this.hear(answer),
        });
    }

    private clear(): void {
        this.ways = new Map();
        this.lastTip = [];
        (["fold", "snap", "unsolved"] as const).forEach((kind) => this.banners.hide(kind));
    }

    private hear(answer: Answer): void {
        if (answer.first) {
            this.clear();
        }
        this.foretell(answer);
        if (!answer.final || answer.measured) {
            return;
        }
        const tip = this.session.places?.vector(answer, "tip.position") ?? [];
        if (answer.status === Status.Snapped) {
            const far = 1e3 * Math.hypot(...tip.map((value, axis) => value - (this.lastTip[axis] ?? NaN)));
            const jump = Number.isFinite(far) ? `the tip went by ${written(far, 1)} mm` : "the shape jumped";
            const time = `Snapped at ${written(this.seconds(), 1)} s`;
            this.banners.show("snap", `${time}: ${jump}.`, null, SNAP_TOLD);
        }
        if (answer.status === Status.NotSolved) {
            const anew = { text: "Load anew", does: () => this.session.restart() };
            const why = answer.message === "" ? "" : ` The device says: ${answer.message}`;
            this.banners.show("unsolved", `Not solved here; the last good shape is shown.${why}`, anew);
        } else {
            this.banners.hide("unsolved");
            this.lastTip = tip;
        }
    }

    private foretell(answer: Answer): void {
        const { places, description } = this.session;
        if (places === null || description === null) {
            return;
        }
        const kind = [answer.final, answer.measured, answer.level].join(" ");
        const way = this.ways.get(kind) ?? new Approach(description.inputs);
        this.ways.set(kind, way);
        if (answer.status === Status.Snapped || answer.status === Status.NotSolved) {
            way.clear();
        }
        const margin = places.output(answer, "stability.margin");
        const solved = answer.status !== Status.NotSolved && Number.isFinite(margin);
        const ahead = solved ? way.add(answer.inputs, margin) : null;
        // A margin that is measured at rest has mostly none to be compared with: what the way there foretold stays.
        if (answer.behind || (answer.measured && ahead === null)) {
            return;
        }
        if (ahead !== null) {
            const whose = answer.final ? "" : ` (${answer.level}, which fills in)`;
            this.banners.show("fold", `${inWords(ahead)}${whose}`);
        } else if (answer.status === Status.NearFold) {
            this.banners.show("fold", "Close to a fold: a small step further may snap.");
        } else {
            this.banners.hide("fold");
        }
    }
}
