/** Which model answers when: the one that the scene asks for where it is fast enough or the inputs rest, else a cheaper one. */

import { type Core, type Result } from "./core";
import { type Answer, type Description, type Level, LEVELS, Places, Status } from "./protocol";
import { Way } from "./way";

/** The level that fills in for dearer ones. */
const CHEAPER: Level = "rings";

/** Time of a step, ms, up to which a model answers while the inputs move: a frame of 60 in a second. */
const FRAME = 16;

/** Time without new inputs after which they rest, ms. */
const REST = 120;

/** Weight of the last step in the mean of times of steps. */
const WEIGHT = 0.3;

/** A device on its way. */
class Follower {
    /** Mean time of a step, ms. */
    cost = 0;

    constructor(
        readonly number: number,
        readonly way: Way,
    ) {}

    note(cost: number): void {
        this.cost += WEIGHT * (cost - this.cost);
    }
}

/** The devices of one scene. */
export class Schedule {
    private readonly asked: Follower;
    private readonly cheaper: Follower | null;
    private readonly places: Places;
    private lastMove = -Infinity;
    /** The last answer of the model asked for, as long as its margin is not measured. */
    private unmeasured: Answer | null = null;

    /** Opens the scene; a `Refusal` is thrown where it is not read. */
    constructor(
        private readonly core: Core,
        readonly description: Description,
    ) {
        this.places = new Places(description);
        this.asked = new Follower(0, new Way(description.inputs));
        this.cheaper = null;
        if (LEVELS.indexOf(description.level) > LEVELS.indexOf(CHEAPER)) {
            core.openAtLevel(0, 1, LEVELS.indexOf(CHEAPER));
            this.cheaper = new Follower(1, new Way(description.inputs));
        }
    }

    /** Loads the devices anew at these inputs, and tells the answers: that of the cheaper model fills in while the one that is asked for
     * is found. */
    load(inputs: Float64Array, tell: (answer: Answer) => void): void {
        for (const follower of [this.cheaper, this.asked]) {
            if (follower !== null) {
                follower.way.clear();
                const load = () => this.core.load(follower.number, inputs);
                tell({ ...this.timed(follower, inputs, load), first: true });
                follower.cost = 0; // a first solve says nothing about steps
            }
        }
    }

    /** Moves on to these inputs; they are reached by `work`. */
    move(inputs: Float64Array, every: boolean, now: number): void {
        this.asked.way.push(inputs, every);
        this.cheaper?.way.push(inputs, false);
        this.lastMove = every ? -Infinity : now;
    }

    /** Whether there is work to do. */
    get busy(): boolean {
        return this.asked.way.length + (this.cheaper?.way.length ?? 0) > 0 || this.unmeasured !== null;
    }

    /** Time until there is work to do, ms. */
    wait(now: number): number {
        const followed = this.asked.way.length > 0 && (this.cheaper === null || this.asked.cost <= FRAME);
        const fillsIn = (this.cheaper?.way.length ?? 0) > 0;
        return followed || fillsIn ? 0 : Math.max(0, this.lastMove + REST - now);
    }

    /** Takes one step; null where it has nothing to say of it. */
    work(now: number): Answer | null {
        const [asked, cheaper] = [this.asked, this.cheaper];
        const moving = now < this.lastMove + REST;
        if (asked.way.length > 0 && (cheaper === null || asked.cost <= FRAME || !moving)) {
            return this.step(asked);
        }
        if (this.unmeasured !== null && !moving) {
            return this.measure(this.unmeasured);
        }
        const answer = cheaper === null ? null : this.step(cheaper);
        return moving && asked.way.length > 0 && answer?.behind === false ? answer : null;
    }

    private measure(answer: Answer): Answer {
        this.unmeasured = null;
        const { outputs } = this.core.measure(this.asked.number);
        return { ...answer, outputs, measured: true, first: false, message: "" };
    }

    private step(follower: Follower): Answer | null {
        const inputs = follower.way.shift();
        return inputs === undefined
            ? null
            : this.timed(follower, inputs, () => this.core.step(follower.number, inputs));
    }

    private timed(follower: Follower, inputs: Float64Array, call: () => Result): Answer {
        const begin = performance.now();
        const { solved, outputs, said } = call();
        const cost = performance.now() - begin;
        follower.note(cost);
        const final = follower === this.asked;
        const level = final ? this.description.level : CHEAPER;
        const answer: Answer = {
            inputs,
            outputs,
            status: Status.NotSolved,
            message: said,
            level,
            final,
            behind: follower.way.length > 0,
            measured: false,
            first: false,
            cost,
        };
        const status = this.places.output(answer, "solver.status");
        answer.status = solved && !Number.isNaN(status) ? status : Status.NotSolved;
        if (final) {
            this.unmeasured = answer.behind || answer.status === Status.NotSolved ? null : answer;
        }
        return answer;
    }
}
