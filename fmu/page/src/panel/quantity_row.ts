/** A slider beside a number field, for one input. */

import { create } from "./element";
import type { Quantity } from "./quantity";

/** Decimals of a number field. */
function decimals(step: number): number {
    return Math.max(0, Math.ceil(-Math.log10(step)));
}

let made = 0;

/** A row of the panel; `set` gets the value in SI units as it is moved or typed. */
export class QuantityRow {
    readonly element = create("div", "row");
    private readonly slider = create("input", "row-slider");
    private readonly field = create("input", "row-field");

    /** `least` and `most` are what the device allows, SI. */
    constructor(
        readonly quantity: Quantity,
        least: number | null,
        most: number | null,
        private readonly set: (value: number) => void,
    ) {
        const { label, unit, step } = quantity;
        const limit = (value: number, given: number | null, pick: (...of: number[]) => number) =>
            given === null ? value : pick(value, given * quantity.factor);
        const named = create("label", "row-label", label);
        made += 1;
        named.htmlFor = this.field.id = `quantity-${made}`;
        this.slider.type = "range";
        this.slider.min = String(limit(quantity.from, least, Math.max));
        this.slider.max = String(limit(quantity.to, most, Math.min));
        this.slider.step = String(step);
        this.slider.setAttribute("aria-label", `${label}, slider`);
        this.field.type = "number";
        this.field.step = "any";
        this.field.inputMode = "decimal";
        if (least !== null) {
            this.field.min = String(least * quantity.factor);
        }
        if (most !== null) {
            this.field.max = String(most * quantity.factor);
        }
        this.slider.addEventListener("input", () => this.take(this.slider));
        this.field.addEventListener("input", () => this.take(this.field));
        this.element.append(named, this.slider, this.field, create("span", "row-unit", unit));
    }

    /** Shows a value, SI. The slider grows where a value lies beyond its ends. */
    show(value: number): void {
        const shown = value * this.quantity.factor;
        const rounded = String(Number(shown.toFixed(decimals(this.quantity.step) + 1)));
        this.slider.min = String(Math.min(Number(this.slider.min), Math.floor(shown)));
        this.slider.max = String(Math.max(Number(this.slider.max), Math.ceil(shown)));
        this.slider.value = rounded;
        // What a person is typing stays as it is typed.
        if (document.activeElement !== this.field) {
            this.field.value = rounded;
        }
    }

    private take(from: HTMLInputElement): void {
        const shown = from.valueAsNumber;
        const valid = Number.isFinite(shown) && from.checkValidity();
        this.field.toggleAttribute("data-fault", !valid);
        if (valid) {
            const other = from === this.field ? this.slider : this.field;
            other.value = String(shown);
            this.set(shown / this.quantity.factor);
        }
    }
}
