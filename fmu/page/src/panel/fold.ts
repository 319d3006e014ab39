/** Where a way ends in a fold, foretold from the stability margins on it. */

/** A shape on a way: how far the inputs have gone, in any unit, and the margin there. */
export interface Passed {
    gone: number;
    margin: number;
}

/** Margin below which a fold is foretold: farther away the margin does not yet follow the law below. */
export const FORETOLD_BELOW = 0.3;

/** Powers of the distance with which the margin vanishes: at a fold, and where a symmetric shape loses its stability without one. */
const FOLD = 0.5;
const SYMMETRIC = 1;

/** Number of bisections of the interval of powers. */
const HALVINGS = 40;

/**
 * Distance from the last shape to the fold ahead, in the unit of `gone`; null where none is foretold.
 *
 * At a fold the lowest stiffness falls with the square root of the distance, so that margin squared is a straight line over the
 * way gone and meets zero at the fold: two shapes foretell it. A shape that is nearly symmetric, as a device that turns over beneath a
 * magnet, falls almost in proportion to the distance until very close, and a straight line of the square would warn far too
 * early. So where there is a third shape, the power between one half and one is chosen that passes through all three, as
 * `Branch::predicted_fold` of the core does.
 */
export function distanceToFold(passed: readonly Passed[]): number | null {
    const [here, before, earlier] = passed.slice(-3).reverse();
    if (here === undefined || before === undefined) {
        return null;
    }
    const falls = here.margin < before.margin && here.margin > 0 && here.gone > before.gone;
    if (!falls || here.margin >= FORETOLD_BELOW) {
        return null;
    }
    const distance = (power: number): number => {
        const rest = (here.margin / before.margin) ** (1 / power);
        return ((here.gone - before.gone) * rest) / (1 - rest);
    };
    if (earlier === undefined) {
        return distance(FOLD);
    }
    // The larger the power, the larger the margin that the law has at the earliest of the three.
    let [low, high] = [FOLD, SYMMETRIC];
    for (let halving = 0; halving < HALVINGS; halving += 1) {
        const power = (low + high) / 2;
        const zero = distance(power);
        const margin = here.margin * ((zero + here.gone - earlier.gone) / zero) ** power;
        [low, high] = margin < earlier.margin ? [power, high] : [low, power];
    }
    return distance((low + high) / 2);
}
