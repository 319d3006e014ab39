/** Tip angle, magnetic force and stability margin over time. */

import uPlot from "uplot";
import { create, element } from "../panel/element";
import { length } from "../panel/number";
import type { Session } from "../panel/session";
import { type Answer, Status } from "../protocol";
import { History } from "./history";

/** Least time between two drawings, ms. */
const PAUSE = 100;

/** Width of the window that shows the last minute, s. */
const WINDOW = 60;

/** Titles of the plots, and the least range of their vertical axes: less would make rounding look like motion. */
const TITLES = ["Tip angle (deg)", "Magnetic force (mN)", "Stability margin (1)"];
const LEAST_RANGE = [2, 1, 0.1];
const MARGIN = 2;

/** The three plots. */
export class Plots {
    private readonly history = new History(TITLES.length);
    private plots: uPlot[] = [];
    private loaded = performance.now();
    private waiting = 0;
    private all = false;

    constructor(private readonly session: Session) {
        const window = element("plots-window", HTMLButtonElement);
        window.addEventListener("click", () => {
            this.all = !this.all;
            window.setAttribute("aria-pressed", String(this.all));
            this.later();
        });
        const resized = new ResizeObserver(() => this.resize());
        resized.observe(element("plots", HTMLElement));
        session.listen({ opened: () => this.clear(), answered: (answer) => this.append(answer) });
    }

    /** Time since the device was loaded, s. */
    readonly seconds = (): number => (performance.now() - this.loaded) / 1e3;

    /** Draws anew in the colours of the page, after these have changed. */
    recolour(): void {
        const style = getComputedStyle(document.documentElement);
        const colour = (name: string) => style.getPropertyValue(name).trim();
        const holder = element("plots-row", HTMLElement);
        this.plots.forEach((plot) => plot.destroy());
        holder.replaceChildren();
        this.plots = TITLES.map((title, column) => {
            const place = create("figure", "plot");
            place.append(create("figcaption", "plot-title", title));
            holder.append(place);
            return new uPlot(this.options(column, colour), [[], [], []], place);
        });
        this.resize();
    }

    private clear(): void {
        this.loaded = performance.now();
        this.history.clear();
        this.later();
    }

    private append(answer: Answer): void {
        const places = this.session.places;
        if (places === null) {
            return;
        }
        if (answer.first) {
            this.clear();
        }
        if (answer.status === Status.NotSolved || (answer.behind && !answer.final)) {
            return;
        }
        const margin = places.output(answer, "stability.margin");
        if (answer.measured) {
            this.history.amend(MARGIN, margin);
            this.later();
            return;
        }
        const time = Math.max(this.seconds(), this.history.last + 1e-4);
        const force = 1e3 * length(places.vector(answer, "force.magnetic"));
        const angle = (180 / Math.PI) * places.output(answer, "tip.angle");
        const values = [angle, force, margin];
        this.history.append({ time, final: answer.final, values });
        if (answer.final && answer.status === Status.Snapped) {
            this.history.snaps.push(time);
        }
        this.later();
    }

    private later(): void {
        this.waiting ||= window.setTimeout(() => {
            this.waiting = 0;
            this.draw();
        }, PAUSE);
    }

    private draw(): void {
        const last = this.history.last;
        const from = this.all ? 0 : Math.max(0, last - WINDOW);
        this.plots.forEach((plot, column) => {
            plot.setData(this.history.since(from, column), false);
            plot.setScale("x", { min: from, max: Math.max(from + 5, last) });
        });
    }

    private resize(): void {
        for (const plot of this.plots) {
            const { clientWidth, clientHeight } = plot.root.parentElement!;
            const [width, height] = [clientWidth, clientHeight - 20];
            if (width > 0 && height > 0 && (plot.width !== width || plot.height !== height)) {
                plot.setSize({ width, height });
            }
        }
        this.later();
    }

    private options(column: number, colour: (name: string) => string): uPlot.Options {
        const font = `11px ${colour("--font")}`;
        const grid = { stroke: colour("--line"), width: 1 };
        const axis = { stroke: colour("--muted"), font, grid, ticks: { show: false } };
        const line = colour("--accent");
        return {
            width: 300,
            height: 110,
            padding: [6, 10, 0, 0],
            legend: { show: false },
            cursor: { show: false },
            scales: {
                x: { time: false },
                y: { range: (_, least, most) => roomy(least, most, LEAST_RANGE[column] ?? 1) },
            },
            axes: [
                { ...axis, size: 22, space: 60, values: (_, ticks) => ticks.map((tick) => `${tick} s`) },
                { ...axis, size: 46, space: 24 },
            ],
            series: [
                {},
                { stroke: line, width: 1.5, spanGaps: true, points: { size: 3, show: isShort } },
                { stroke: colour("--faint"), paths: () => null, points: { show: true, size: 2.5 } },
            ],
            hooks: { draw: [(plot) => this.markSnaps(plot, column, colour("--snap"))] },
        };
    }

    private markSnaps(plot: uPlot, column: number, colour: string): void {
        const { ctx, bbox } = plot;
        const { min = 0, max = 0 } = plot.scales.x ?? {};
        ctx.save();
        ctx.strokeStyle = ctx.fillStyle = colour;
        ctx.lineWidth = devicePixelRatio;
        ctx.font = `${11 * devicePixelRatio}px sans-serif`;
        ctx.textAlign = "left";
        for (const snap of this.history.snaps.filter((time) => time >= (min ?? 0) && time <= (max ?? 0))) {
            const x = Math.round(plot.valToPos(snap, "x", true));
            ctx.beginPath();
            ctx.moveTo(x, bbox.top);
            ctx.lineTo(x, bbox.top + bbox.height);
            ctx.stroke();
            if (column === 0) {
                ctx.fillText("snap", x + 4 * devicePixelRatio, bbox.top + 11 * devicePixelRatio);
            }
        }
        ctx.restore();
    }
}

/** Few values are seen as points, as a line of one point is not. */
function isShort(plot: uPlot): boolean {
    return (plot.data[1]?.length ?? 0) < 3;
}

/** A range with room above and below, also around values that are all the same. */
function roomy(least: number | null, most: number | null, smallest: number): [number, number] {
    if (least === null || most === null) {
        return [0, smallest];
    }
    const room = Math.max(0.1 * (most - least), 0.5 * (smallest - (most - least)));
    return [least - room, most + room];
}
