/** Numbers as people read them. */

/** A number with so many decimals, a true minus sign, and a dash where there is none. */
export function written(value: number, decimals: number): string {
    if (!Number.isFinite(value)) {
        return "\u2013";
    }
    const text = value.toFixed(decimals);
    const zero = Number(text) === 0;
    return (zero ? text.replace("-", "") : text).replace("-", "\u2212");
}

/** The length of a vector. */
export function length(vector: readonly number[]): number {
    return Math.hypot(...vector);
}
