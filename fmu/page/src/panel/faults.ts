/** Faults of a scene as the core tells them. */

/** A fault, and the line of the text that it is in; null where it is in none. */
export interface Fault {
    line: number | null;
    text: string;
}

/** Reads a line such as `scene, line 7: unknown key`. */
export function faultOf(message: string): Fault {
    const parts = /^(?:error: )?[^:]*?, line (\d+): (.*)$/s.exec(message);
    return parts === null ? { line: null, text: message } : { line: Number(parts[1]), text: parts[2]! };
}
