/** The buttons of the tape: record, stop, replay, play, and tables out and in. */

import type { Banners } from "../panel/banners";
import { save } from "../panel/download";
import { element } from "../panel/element";
import type { Preset } from "../panel/presets";
import type { Session } from "../panel/session";
import { pathOf, resultsOf, tableOf } from "./csv";
import { type Ending, type Leg, Player } from "./player";
import { MOST, Tape } from "./tape";

/** Least time between two counts of the rows, ms. */
const PAUSE = 200;

/** How long the end of a way is told, s. */
const TOLD = 15;

/** Records what happens and plays it again. */
export class Deck {
    private readonly tape = new Tape();
    private readonly player: Player;
    private waiting = 0;
    /** Whether a way is played that is on the tape already. */
    private replaying = false;

    constructor(
        private readonly session: Session,
        private readonly banners: Banners,
        private readonly preset: () => Preset | undefined,
    ) {
        this.player = new Player(session);
        session.listen({
            opened: () => {
                this.replaying = false;
                this.tape.recording = true;
                this.later();
            },
            answered: (answer) => {
                if (!this.replaying) {
                    const recorded = this.tape.recording;
                    this.tape.take(answer, performance.now() / 1e3);
                    if (recorded && this.tape.full) {
                        banners.show("notice", `The tape is full: ${MOST} rows. Recording has stopped.`);
                    }
                }
                this.later();
            },
        });
        this.press("record", () => {
            this.player.stop("a new recording was begun");
            this.tape.recording = true;
            session.restart();
        });
        this.press("stop", () => {
            this.tape.recording = false;
            this.player.stop("it was stopped");
        });
        this.press("replay", () => this.replay());
        this.press("play", () => this.playPreset());
        this.press("save-path", () => this.export("mcm_path.csv", pathOf));
        this.press("save-results", () => this.export("mcm_results.csv", resultsOf));
        const chosen = element("open-csv", HTMLInputElement);
        this.press("open-csv-button", () => chosen.click());
        chosen.addEventListener("change", () => {
            const file = chosen.files?.[0];
            chosen.value = "";
            if (file !== undefined) {
                void this.open(file);
            }
        });
    }

    private press(id: string, does: () => void): void {
        element(id, HTMLButtonElement).addEventListener("click", () => {
            does();
            this.show();
        });
    }

    /** Plays the tape, which is kept as it is. */
    private replay(): void {
        const places = this.session.places;
        const tip = [1, 2, 3].map((k) => places?.outputPlace(`tip.position[${k}]`));
        const legs = this.tape.rows
            .filter((row) => row.solved)
            .map(({ time, inputs, outputs }) => ({
                time,
                inputs,
                tip: tip.map((place) => outputs[place ?? -1] ?? NaN),
            }));
        if (places !== null && legs.length > 0) {
            this.player.stop("it is played again");
            this.tape.recording = false;
            this.replaying = true;
            this.player.play(legs, (ending) => {
                this.replaying = false;
                this.tell("Replay", ending);
            });
        }
    }

    private playPreset(): void {
        const way = this.preset()?.way ?? [];
        const legs = way.map(({ time, inputs }) => ({ time, inputs: this.at(inputs), tip: null }));
        this.playNew("The way", legs);
    }

    /** Plays a way and records it on a new tape. */
    private playNew(what: string, legs: Leg[]): void {
        this.player.stop("another one was begun");
        this.tape.recording = true;
        this.player.play(legs, (ending) => this.tell(what, ending));
    }

    /** All inputs: those given, and the scene's start values. */
    private at(given: Record<string, number>): Float64Array {
        const inputs = this.session.start.slice();
        this.session.places?.put(inputs, given);
        return inputs;
    }

    private async open(file: File): Promise<void> {
        try {
            const { time, columns } = tableOf(await file.text());
            const known = [...columns].filter(([name]) => this.session.places?.input(name) !== undefined);
            if (known.length === 0) {
                throw new Error("no column has the name of an input of this device");
            }
            const tip = [1, 2, 3].map((k) => columns.get(`tip.position[${k}]`));
            const legs = time.map((at, row) => ({
                time: at,
                inputs: this.at(Object.fromEntries(known.map(([name, values]) => [name, values[row]!]))),
                tip: tip.includes(undefined) ? null : tip.map((values) => values?.[row] ?? NaN),
            }));
            if (legs.some(({ inputs }) => inputs.some((value) => !Number.isFinite(value)))) {
                throw new Error("an input has a cell that is no number");
            }
            this.playNew(file.name, legs);
        } catch (error) {
            const why = error instanceof Error ? error.message : String(error);
            this.banners.show("notice", `${file.name} cannot be played: ${why}.`);
        }
        this.show();
    }

    private tell(what: string, { legs, difference, reason }: Ending): void {
        const rows = counted(legs);
        const apart =
            difference === null
                ? ""
                : ` The tip was at most ${inMillimetres(difference)} from the recorded one.`;
        const end =
            reason === "" ? `${what} was played: ${rows}.` : `${what} ended after ${rows}: ${reason}.`;
        this.banners.show("notice", end + apart, null, TOLD);
        this.later();
    }

    private export(name: string, write: typeof pathOf): void {
        const description = this.session.description;
        if (description !== null && this.tape.rows.length > 0) {
            save(name, write(this.tape.rows, description));
        }
    }

    private later(): void {
        this.waiting ||= window.setTimeout(() => {
            this.waiting = 0;
            this.show();
        }, PAUSE);
    }

    private show(): void {
        const { rows, recording, seconds, full } = this.tape;
        const percent = Math.round(100 * this.player.done);
        const doing = this.player.playing
            ? `Playing, ${percent} %.`
            : recording
              ? "Recording."
              : full
                ? "Full, stopped."
                : "Stopped.";
        element("tape-state", HTMLElement).textContent =
            `${doing} ${counted(rows.length)}, ${seconds.toFixed(1)} s.`;
        const empty = rows.length === 0;
        for (const id of ["replay", "save-path", "save-results"]) {
            element(id, HTMLButtonElement).disabled = empty;
        }
        element("stop", HTMLButtonElement).disabled = !recording && !this.player.playing;
        element("record", HTMLButtonElement).setAttribute("aria-pressed", String(recording));
    }
}

function counted(rows: number): string {
    return `${rows} ${rows === 1 ? "row" : "rows"}`;
}

function inMillimetres(metres: number): string {
    const millimetres = 1e3 * metres;
    const tiny = millimetres > 0 && millimetres < 1e-9;
    return tiny ? "1e-9 mm" : `${Number(millimetres.toPrecision(3))} mm`;
}
