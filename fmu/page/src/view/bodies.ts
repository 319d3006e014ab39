import type { Body, Spiral } from "../protocol";
import type { Palette } from "./colours";
import { MM } from "./shape";
import type { SweepBuilder } from "./sweep";

/** How finely round surfaces are divided. */
export interface Fineness {
    /** Parts of a full circle. */
    around: number;
    /** Stations on a full turn of a winding. */
    turn: number;
}

/** The fineness for so many bodies: long chains are seen from farther away and must still move at once. */
export function finenessFor(bodies: number): Fineness {
    return bodies > 60 ? { around: 20, turn: 14 } : { around: 32, turn: 24 };
}

/** Edges of rings are broken by this part of the wall's thickness. */
const CHAMFER = 0.08;

/** A point of a profile: arc length and radius, mm. */
type Point = readonly [number, number];

/** Adds the surface that a profile sweeps about the centreline; the material lies to the right of its way. Its corners are sharp. */
export function revolve(builder: SweepBuilder, profile: readonly Point[], around: number): void {
    for (let k = 0; k + 1 < profile.length; k++) {
        const [from, to] = [profile[k]!, profile[k + 1]!];
        const [forward, outward] = [to[0] - from[0], to[1] - from[1]];
        const length = Math.hypot(forward, outward);
        if (length === 0) continue;
        const first = builder.next;
        for (const [arc, radius] of [from, to]) {
            for (let column = 0; column <= around; column++) {
                const angle = (2 * Math.PI * column) / around;
                builder.vertex(arc, radius, angle, [forward / length, 0, -outward / length]);
            }
        }
        builder.grid(first, 2, around + 1);
    }
}

/** Adds a tube with bore and end faces, with so many slices along it. */
export function tube(
    builder: SweepBuilder,
    span: { begin: number; length: number; innerRadius: number; outerRadius: number },
    slices: number,
    around: number,
    chamfer = 0,
): void {
    const { begin, length, innerRadius: inner, outerRadius: outer } = span;
    const end = begin + length;
    const broken = Math.min(chamfer * (outer - inner), length / 4);
    const at = (k: number) => begin + broken + ((length - 2 * broken) * k) / slices;
    const outside = Array.from({ length: slices + 1 }, (_, k): Point => [at(k), outer]);
    revolve(
        builder,
        [[begin, inner], [begin, outer - broken], ...outside, [end, outer - broken], [end, inner]],
        around,
    );
    if (inner > 0) {
        const inside = Array.from({ length: slices + 1 }, (_, k): Point => [
            end - (length * k) / slices,
            inner,
        ]);
        revolve(builder, inside, around);
    }
}

/** Adds a ring magnet: its half towards north in one colour, the other in the other. */
export function ring(builder: SweepBuilder, body: Body, palette: Palette, around: number): void {
    const half = MM * body.length * 0.5;
    const radii = { innerRadius: MM * body.innerRadius, outerRadius: MM * body.outerRadius };
    const begin = MM * body.begin;
    const ends = body.remanence < 0 ? [palette.north, palette.south] : [palette.south, palette.north];
    ends.forEach((colour, k) => {
        builder.paint(body.remanence === 0 ? palette.plain : colour!);
        const { innerRadius: inner, outerRadius: outer } = radii;
        const broken = Math.min(CHAMFER * (outer - inner), half / 3);
        const [near, far] = k === 0 ? [begin, begin + half] : [begin + 2 * half, begin + half];
        const inward = k === 0 ? broken : -broken;
        const profile: Point[] = [
            [near, inner],
            [near, outer - broken],
            [near + inward, outer],
            [far, outer],
        ];
        revolve(builder, k === 0 ? profile : profile.reverse(), around);
        if (inner > 0)
            revolve(
                builder,
                [
                    [begin + (k + 1) * half, inner],
                    [begin + k * half, inner],
                ],
                around,
            );
    });
}

/** Adds a disc, a core with its windings, or a plain rod. */
export function rubber(builder: SweepBuilder, body: Body, palette: Palette, fine: Fineness): void {
    const span = {
        begin: MM * body.begin,
        length: MM * body.length,
        innerRadius: MM * body.innerRadius,
        outerRadius: MM * body.outerRadius,
    };
    if (body.kind === "disc") {
        builder.paint(palette.winding);
        // Its edges stay sharp: the windings go on from them without a step.
        tube(builder, span, 1, fine.around);
        return;
    }
    builder.paint(body.kind === "core" ? palette.rubber : palette.winding);
    // A rod is long: it gets a slice for each millimetre, as far as that is affordable.
    const slices = body.kind === "core" ? 8 : Math.max(8, Math.min(200, Math.ceil(span.length)));
    tube(builder, span, slices, body.kind === "core" ? Math.ceil(fine.around * 0.6) : fine.around);
    if (!body.spiral) return;
    builder.paint(palette.winding);
    if (body.spiral.turn === 0) washers(builder, body.spiral, span, fine);
    else winding(builder, body.spiral, span, fine);
}

/**
 * Adds the windings: the sector of an annulus swept along the core while it turns. Its two flanks are helicoids, its outside lies on
 * the cylinder; the inside lies on the core and the ends on the discs, where nobody sees them.
 */
function winding(
    builder: SweepBuilder,
    spiral: Spiral,
    span: { begin: number; length: number },
    fine: Fineness,
): void {
    const [inner, outer, sector] = [MM * spiral.innerRadius, MM * spiral.outerRadius, spiral.sectorAngle];
    const rows = Math.max(8, Math.ceil(fine.turn * spiral.windings)) + 1;
    const columns = Math.max(2, Math.ceil((fine.around * sector) / (2 * Math.PI))) + 1;
    const rate = (spiral.turn * 2 * Math.PI * spiral.windings) / span.length;
    const start = (row: number) => spiral.start + (rate * span.length * row) / (rows - 1);
    const arc = (row: number) => span.begin + (span.length * row) / (rows - 1);

    const outside = builder.next;
    for (let row = 0; row < rows; row++) {
        for (let column = 0; column < columns; column++) {
            builder.vertex(arc(row), outer, start(row) + (sector * column) / (columns - 1), [1, 0, 0]);
        }
    }
    builder.grid(outside, rows, columns);

    for (const [angle, side] of [
        [0, -1],
        [sector, 1],
    ] as const) {
        const flank = builder.next;
        for (let row = 0; row < rows; row++) {
            for (const radius of [inner, outer]) {
                // The flank's normal is across the radius and the way of the spiral.
                const slope = rate * radius;
                const size = side / Math.hypot(1, slope);
                builder.vertex(arc(row), radius, start(row) + angle, [0, size, -slope * size]);
            }
        }
        builder.grid(flank, rows, 2, side > 0);
    }
}

/** Adds rings of rubber of the windings' volume, for a spiral that is spread evenly over the circle. */
function washers(
    builder: SweepBuilder,
    spiral: Spiral,
    span: { begin: number; length: number },
    fine: Fineness,
): void {
    const count = Math.max(1, Math.round(spiral.windings));
    const pitch = span.length / count;
    const length = (pitch * spiral.sectorAngle) / (2 * Math.PI);
    const radii = { innerRadius: MM * spiral.innerRadius, outerRadius: MM * spiral.outerRadius };
    for (let k = 0; k < count; k++) {
        tube(
            builder,
            { begin: span.begin + (k + 0.5) * pitch - length / 2, length, ...radii },
            1,
            fine.around,
            CHAMFER,
        );
    }
}
