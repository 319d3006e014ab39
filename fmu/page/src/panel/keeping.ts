/** What a link or a saved scene keeps: the inputs, and the way on which the device came to its shape. */

import { SAME_BRANCH } from "../carry";
import { Status, type WayRow } from "../protocol";
import { written } from "./number";
import { same, type Session } from "./session";
import { MOST_ROWS, rowsOf, textOf, Trail } from "./trail";

/** Numbers of rows that are tried in turn: where the branch does not care, the way needs none. */
const TRIED = [0, 20, MOST_ROWS];

/** The most rows in the address, which is written whenever the device rests, without a trial. */
const IN_ADDRESS = 40;

/** What is kept, and what of it is not as it is here; empty where all is. */
export interface Kept {
    rows: WayRow[];
    scene: string;
    remark: string;
}

/** Listens to the answers of a session. */
export class Keeping {
    private readonly trail = new Trail();

    constructor(private readonly session: Session) {
        session.listen({
            answered: (answer) => {
                if (session.description !== null) {
                    this.trail.take(answer, session.description);
                }
            },
        });
    }

    /** Rows of the way to the present inputs, as they were, thinned. */
    rows(): WayRow[] {
        const { description, inputs } = this.session;
        return description === null
            ? []
            : rowsOf(this.trail.to(inputs, description, IN_ADDRESS), inputs, description);
    }

    /** Whether the device is not where its scene begins, or came there on a way. */
    get moved(): boolean {
        return !same(this.session.inputs, this.session.start) || this.rows().length > 0;
    }

    /** What is to be kept, tried on a device of its own; null while nothing is open. */
    async kept(): Promise<Kept | null> {
        const { description, answer, inputs, scene } = this.session;
        if (description === null || answer === null) {
            return null;
        }
        const every = TRIED.map((most) => (most === 0 ? [] : this.trail.to(inputs, description, most)));
        const ways = every.filter(({ length }, place) => place === 0 || length > every[place - 1]!.length);
        const carriages = ways.map((points) => ({
            points,
            text: textOf(rowsOf(points, inputs, description)),
        }));
        const end = inputs.slice();
        const carried = await this.session.carry(carriages);
        if (carried === null || this.session.scene !== scene) {
            return null;
        }
        const rows = rowsOf(ways[carried.way] ?? [], end, description);
        const here = answer.final && answer.status !== Status.NotSolved && same(answer.inputs, end);
        return { rows, scene: carried.scene, remark: here ? remark(carried.apart) : NOT_HERE };
    }
}

const NOT_HERE = "The shape shown is not the answer to these inputs: what is kept may lead to another one.";

/** What is to be said of a shape so far from the present one, m. */
function remark(apart: number): string {
    if (apart <= SAME_BRANCH) {
        return "";
    }
    const far = Number.isFinite(apart) ? `to a shape ${written(1e3 * apart, 1)} mm away` : "to no shape";
    return `The way to this shape cannot be kept in ${MOST_ROWS} rows: what is kept leads ${far}.`;
}
