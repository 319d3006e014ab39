/** Moving and turning the external magnet by buttons and numbers. */

import type { Pose } from "../view/view";
import { button, create, element } from "./element";
import { axis, type Quaternion, turned, type Vector } from "./orientation";
import type { Session } from "./session";

/** Turn of a button, rad. */
const BUTTON = Math.PI / 36;

/** The pose asked for. */
export function poseOf(session: Session): Pose {
    const read = (name: string, count: number) =>
        Array.from({ length: count }, (_, k) => session.input(`${name}[${k + 1}]`));
    return {
        position: read("magnet.position", 3) as Vector,
        orientation: read("magnet.orientation", 4) as Quaternion,
    };
}

/** A pose as inputs of the device. */
export function inputsOf({ position, orientation }: Pose): Record<string, number> {
    const named = (name: string, values: number[]) =>
        values.map((value, k): [string, number] => [`${name}[${k + 1}]`, value]);
    return Object.fromEntries([
        ...named("magnet.position", position),
        ...named("magnet.orientation", orientation),
    ]);
}

/** Moves the magnet along a world axis (0 for x, 1 for y, 2 for z) by a distance, m. */
export function moveMagnet(session: Session, along: 0 | 1 | 2, distance: number): void {
    const name = `magnet.position[${along + 1}]`;
    // A micrometre grid keeps 23 steps of 1 mm at 23 mm.
    const place = Math.round((session.input(name) + distance) * 1e9) / 1e9;
    session.set({ [name]: place }, "controls");
}

/** Turns the magnet about its centre and a world axis by an angle, rad. */
export function turnMagnet(session: Session, about: 0 | 1 | 2, angle: number): void {
    const pose = poseOf(session);
    session.set(inputsOf({ ...pose, orientation: turned(pose.orientation, about, angle) }), "controls");
}

/** The buttons that turn the magnet, and the direction of its dipole in numbers. */
export class MagnetTurns {
    constructor(private readonly session: Session) {
        const places: [string, 0 | 1 | 2][] = [
            ["x", 0],
            ["y", 1],
            ["z", 2],
        ];
        for (const [name, about] of places) {
            const group = create("span", "turn");
            const less = button("\u2212", () => turnMagnet(session, about, -BUTTON));
            const more = button("+", () => turnMagnet(session, about, BUTTON));
            less.setAttribute("aria-label", `Turn by \u22125 degrees about ${name}`);
            more.setAttribute("aria-label", `Turn by 5 degrees about ${name}`);
            group.append(less, create("b", "", name), more);
            element("turns", HTMLElement).append(group);
        }
        element("magnet-flip", HTMLButtonElement).addEventListener("click", () =>
            turnMagnet(session, 0, Math.PI),
        );
        session.listen({ changed: () => this.show() });
    }

    private show(): void {
        const direction = axis(poseOf(this.session).orientation);
        const shown = direction.map((part) => (Math.abs(part) < 5e-4 ? 0 : part).toFixed(3));
        element("magnet-axis", HTMLElement).textContent = shown.join(", ").replaceAll("-", "\u2212");
    }
}
