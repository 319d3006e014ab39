/** What a test, or a person at the browser's console, can ask the page. */

import type { Variable } from "../protocol";
import type { View } from "../view/view";
import type { Session } from "./session";

/** The state of the session, SI. */
export interface State {
    /** Inputs asked for, by name. */
    inputs: Record<string, number>;
    /** Outputs of the newest answer, by name. */
    outputs: Record<string, number>;
    /** Whether the newest answer is by the model that the scene asks for. */
    final: boolean;
    /** Whether its stability margin is measured; it is an upper bound before. */
    measured: boolean;
    /** `solver.status`; -1 before the first answer. */
    status: number;
    /** Level that answered. */
    level: string;
    /** Whether an answer to these inputs, by the model asked for, is still to come. */
    busy: boolean;
    /** Snaps since the device was loaded. */
    snaps: number;
    /** Why the newest text of a scene was not read, a line each. */
    faults: string[];
}

/** `window.mcm`. */
export interface Inspection {
    state(): State;
    /** Seconds that the core took to start; kept once it has. */
    ready: Promise<number>;
    /** Centre of the magnet's gizmo in CSS pixels of the picture. */
    magnetOnScreen(): [number, number] | null;
}

declare global {
    interface Window {
        /** The page as tests see it: read only, nothing here moves the device. */
        mcm: Inspection;
    }
}

/** What the page tells of a session. */
export function inspectionOf(session: Session, view: View): Inspection {
    const ready = new Promise<number>((keep) => session.listen({ ready: keep }));
    const named = (variables: Variable[] = [], values: Float64Array = new Float64Array()) =>
        Object.fromEntries(variables.map(({ name }, place) => [name, values[place] ?? NaN]));
    return {
        ready,
        magnetOnScreen: () => view.magnetOnScreen(),
        state: () => {
            const { answer, description, places, inputs, busy, faults } = session;
            const snaps = answer === null ? NaN : places?.output(answer, "stability.snaps");
            return {
                inputs: named(description?.inputs, inputs),
                outputs: named(description?.outputs, answer?.outputs),
                final: answer?.final ?? false,
                measured: answer?.measured ?? false,
                status: answer?.status ?? -1,
                level: answer?.level ?? "",
                busy,
                snaps: snaps ?? NaN,
                faults,
            };
        },
    };
}
