/** The tape: every answer by the model asked for, in order. */

import { same } from "../panel/session";
import { type Answer, Status } from "../protocol";

/** A row of the tape. */
export interface Row {
    /** Time since the first row, s. */
    time: number;
    inputs: Float64Array;
    outputs: Float64Array;
    solved: boolean;
}

/** Most rows of a tape: they take some 50 MB. */
export const MOST = 20_000;

/** Least time between two rows, s: times of an input table have to increase. */
const LEAST = 1e-3;

/** Records answers. A tape begins where a device was loaded anew, because only from there can its way be repeated exactly. */
export class Tape {
    rows: Row[] = [];
    recording = true;
    private began = 0;

    get full(): boolean {
        return this.rows.length >= MOST;
    }

    /** Time of the last row, s. */
    get seconds(): number {
        return this.rows.at(-1)?.time ?? 0;
    }

    /** Takes an answer, at a time of the clock (s). */
    take(answer: Answer, now: number): void {
        const newest = this.rows.at(-1);
        if (answer.measured && newest !== undefined && same(newest.inputs, answer.inputs)) {
            newest.outputs = answer.outputs;
        }
        if (!this.recording || !answer.final || answer.measured) {
            return;
        }
        if (answer.first) {
            [this.rows, this.began] = [[], now];
        }
        const last = this.rows.at(-1);
        // Whole milliseconds are short to write and exact enough for a hand.
        const time =
            last === undefined ? 0 : Math.round(1e3 * Math.max(last.time + LEAST, now - this.began)) / 1e3;
        const { inputs, outputs, status } = answer;
        this.rows.push({ time, inputs, outputs, solved: status !== Status.NotSolved });
        this.recording = !this.full;
    }
}
