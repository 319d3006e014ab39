/** Orientations as unit quaternions w, x, y, z that turn the body's axes to the world's. */

export type Quaternion = [number, number, number, number];
export type Vector = [number, number, number];

/** The orientation after a further turn by `angle` (rad) about a world axis: 0 for x, 1 for y, 2 for z. */
export function turned([w, x, y, z]: Quaternion, axis: 0 | 1 | 2, angle: number): Quaternion {
    const cosine = Math.cos(angle / 2);
    const turn: Vector = [0, 0, 0];
    turn[axis] = Math.sin(angle / 2);
    const [a, b, c] = turn;
    const product: Quaternion = [
        cosine * w - a * x - b * y - c * z,
        cosine * x + a * w + b * z - c * y,
        cosine * y - a * z + b * w + c * x,
        cosine * z + a * y - b * x + c * w,
    ];
    // Rounding adds up over many turns, and the device asks for a unit quaternion.
    const length = Math.hypot(...product);
    return product.map((value) => value / length) as Quaternion;
}

/** Where the body's z axis points. */
export function axis([w, x, y, z]: Quaternion): Vector {
    return [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)];
}
