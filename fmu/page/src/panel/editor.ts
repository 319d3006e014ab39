/** The text of the scene, with numbered lines and its faults beneath. */

import { button, create, element } from "./element";
import { faultOf, type Fault } from "./faults";
import type { Session } from "./session";

/** Pause in typing after which the text is applied, ms. */
const PAUSE = 700;

/** The editor of the open scene. */
export class Editor {
    private readonly area = element("scene-text", HTMLTextAreaElement);
    private readonly numbers = element("scene-numbers", HTMLElement);
    private readonly list = element("scene-faults", HTMLUListElement);
    private faults: Fault[] = [];
    private timer = 0;
    /** The text that was sent last, so that it is not sent again as it stands. */
    private sent = "";

    constructor(private readonly session: Session) {
        this.area.addEventListener("input", () => {
            this.draw();
            window.clearTimeout(this.timer);
            this.timer = window.setTimeout(() => this.apply(), PAUSE);
        });
        this.area.addEventListener("keydown", (event) => {
            if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) {
                event.preventDefault();
                this.apply();
            }
        });
        this.area.addEventListener("scroll", () => (this.numbers.scrollTop = this.area.scrollTop));
        element("scene-apply", HTMLButtonElement).addEventListener("click", () => {
            this.sent = "";
            this.apply();
        });
        session.listen({
            opened: () => this.mark([]),
            refused: (faults) => this.mark(faults.map(faultOf)),
        });
    }

    /** The text as it stands, applied or not. */
    get text(): string {
        return this.area.value;
    }

    /** Puts a text in and opens it; `inputs` differ from its start. */
    open(text: string, inputs: Record<string, number> = {}): void {
        this.area.value = text;
        this.area.scrollTop = 0;
        this.sent = "";
        this.apply(inputs);
    }

    private apply(inputs: Record<string, number> = {}): void {
        window.clearTimeout(this.timer);
        this.draw();
        if (this.text !== this.sent) {
            this.sent = this.text;
            this.session.open(this.text, inputs);
        }
    }

    private mark(faults: Fault[]): void {
        this.faults = faults;
        this.list.replaceChildren(
            ...faults.map(({ line, text }) => {
                const item = create("li", "fault");
                if (line !== null) {
                    item.append(button(`Line ${line}`, () => this.show(line)));
                }
                item.append(create("span", "", text));
                return item;
            }),
        );
        if (faults.length > 0) {
            this.list.append(create("li", "remark", "The device before this text goes on."));
        }
        this.draw();
    }

    /** Draws the numbers of the lines, those with a fault marked. */
    private draw(): void {
        const faulty = new Set(this.faults.map(({ line }) => line));
        const count = this.text.split("\n").length;
        const rows = Array.from({ length: count }, (_, row) => {
            const style = faulty.has(row + 1) ? "number number-faulty" : "number";
            return create("span", style, String(row + 1));
        });
        this.numbers.replaceChildren(...rows);
        this.numbers.scrollTop = this.area.scrollTop;
        this.area.setAttribute("aria-invalid", String(this.faults.length > 0));
    }

    /** Brings a line into sight and selects it. */
    private show(line: number): void {
        const rows = this.text.split("\n");
        const begin = rows.slice(0, line - 1).reduce((sum, row) => sum + row.length + 1, 0);
        const height = this.area.scrollHeight / rows.length;
        this.area.focus();
        this.area.setSelectionRange(begin, begin + (rows[line - 1]?.length ?? 0));
        this.area.scrollTop = height * (line - 4);
    }
}
