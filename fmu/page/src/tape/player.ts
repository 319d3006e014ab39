/** Plays a way of inputs on a device loaded anew, answer by answer. */

import { same, type Session } from "../panel/session";
import { type Answer, Status } from "../protocol";

/** A point of a way. */
export interface Leg {
    time: number;
    inputs: Float64Array;
    /** Where the tip was when it was recorded, m; null where that is not known. */
    tip: number[] | null;
}

/** How a way ended. */
export interface Ending {
    legs: number;
    /** Largest distance of the tip from where it was recorded, m; null where nothing was recorded. */
    difference: number | null;
    /** Why it ended early, in words; empty where it did not. */
    reason: string;
}

/** Plays one way at a time, at its own pace but never faster than answers come. */
export class Player {
    private legs: Leg[] = [];
    private next = 0;
    private sent = 0;
    private difference: number | null = null;
    private timer = 0;
    private ended: (ending: Ending) => void = () => {};

    constructor(private readonly session: Session) {
        session.listen({
            answered: (answer) => this.hear(answer),
            changed: (origin) => {
                if (this.playing && origin !== "way") {
                    this.stop("it was stopped, as inputs were changed");
                }
            },
        });
    }

    get playing(): boolean {
        return this.legs.length > 0;
    }

    /** Part of the way that is done, 0 to 1. */
    get done(): number {
        return this.playing ? this.next / this.legs.length : 0;
    }

    /** Loads the device anew at the first point and plays on from there. */
    play(legs: Leg[], ended: (ending: Ending) => void): void {
        this.stop("another one was begun");
        const first = legs[0];
        if (first !== undefined) {
            [this.legs, this.next, this.difference, this.ended] = [legs, 0, null, ended];
            this.sent = performance.now();
            this.session.restart(first.inputs);
        }
    }

    stop(reason: string): void {
        if (this.playing) {
            window.clearTimeout(this.timer);
            const legs = this.next;
            this.legs = [];
            this.ended({ legs, difference: this.difference, reason });
        }
    }

    private hear(answer: Answer): void {
        const leg = this.legs[this.next];
        const begins = this.next === 0;
        const told = answer.final && !answer.measured;
        if (leg === undefined || !told || begins !== answer.first || !same(answer.inputs, leg.inputs)) {
            return;
        }
        if (answer.status === Status.NotSolved) {
            this.stop(`not solved at ${leg.time} s`);
            return;
        }
        if (leg.tip !== null) {
            const tip = this.session.places?.vector(answer, "tip.position") ?? [];
            const apart = Math.hypot(...tip.map((value, k) => value - (leg.tip?.[k] ?? NaN)));
            this.difference = Math.max(this.difference ?? 0, apart);
        }
        this.next += 1;
        const following = this.legs[this.next];
        if (following === undefined) {
            this.stop("");
            return;
        }
        const due = this.sent + 1e3 * (following.time - leg.time);
        this.timer = window.setTimeout(
            () => {
                this.sent = performance.now();
                this.session.follow(following.inputs);
            },
            Math.max(0, due - performance.now()),
        );
    }
}
