/** The line of numbers over the picture, and the status in words. */

import { type Answer, LEVELS, Status } from "../protocol";
import { element } from "./element";
import { length, written } from "./number";
import type { Session } from "./session";

/** Least time between two numbers of the same place, ms: faster ones cannot be read. */
const READABLE = 60;

/** Shows the newest answer in numbers. */
export class Readout {
    private waiting = 0;

    constructor(private readonly session: Session) {
        const later = () => {
            this.waiting ||= window.setTimeout(() => {
                this.waiting = 0;
                this.show();
            }, READABLE);
        };
        session.listen({ answered: later, opened: later, refused: later });
    }

    private show(): void {
        const { answer, places, description } = this.session;
        if (answer === null || places === null || description === null) {
            return;
        }
        const output = (name: string) => places.output(answer, name);
        const millimetres = places.vector(answer, "tip.position").map((part) => written(1e3 * part, 2));
        const force = places.vector(answer, "force.magnetic").map((part) => 1e3 * part);
        write("read-angle", written((180 / Math.PI) * output("tip.angle"), 2));
        write("read-position", millimetres.join("  "));
        write("read-force", written(length(force), 2));
        write("read-force-parts", force.map((part) => written(part, 1)).join("  "));
        write("read-margin", written(output("stability.margin"), 3));
        write("read-cost", written(answer.cost, answer.cost < 10 ? 1 : 0));
        write("read-snaps", written(output("stability.snaps"), 0));
        const [level, remark] = modelOf(answer, output("model.level"));
        write("read-level", level);
        write("read-level-remark", remark);
        write("status-model", `By ${level}, ${remark.startsWith("as") ? "" : "which "}${remark}.`);
        const [state, words] = statusOf(answer);
        const status = element("status", HTMLElement);
        status.dataset.state = state;
        write("status-words", words);
    }
}

function write(id: string, text: string): void {
    const place = element(id, HTMLElement);
    // An unchanged text must not be read out again.
    if (place.textContent !== text) {
        place.textContent = text;
    }
}

/** The model that answered, and whether it is the one asked for. */
function modelOf(answer: Answer, level: number): [string, string] {
    const answered = LEVELS[level];
    if (!answer.final) {
        return [answer.level, "fills in while the inputs move"];
    }
    const chosen =
        answer.level === "auto" && answered !== undefined ? `as asked, by ${answered}` : "as asked";
    return [answer.level, chosen];
}

/** The status as a word for its colour, and in words for people. */
function statusOf(answer: Answer): [string, string] {
    switch (answer.status) {
        case Status.Solved:
            return ["solved", "Solved, stable."];
        case Status.NearFold:
            return ["fold", "Solved, near a fold."];
        case Status.Snapped:
            return ["snapped", "Snapped."];
        case Status.NotSolved:
            return ["unsolved", "Not solved."];
    }
}
