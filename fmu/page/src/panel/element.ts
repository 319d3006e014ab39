/** Elements of the page. */

/** The element with this id, which must be there and of this type. */
export function element<T extends HTMLElement>(id: string, type: new () => T): T {
    const found = document.getElementById(id);
    if (!(found instanceof type)) {
        throw new Error(`the page has no ${type.name} "${id}"`);
    }
    return found;
}

/** A new element with a class and a text; text from outside is never read as markup. */
export function create<K extends keyof HTMLElementTagNameMap>(
    tag: K,
    style: string,
    text = "",
): HTMLElementTagNameMap[K] {
    const made = document.createElement(tag);
    made.className = style;
    made.textContent = text;
    return made;
}

/** A new button that does something. */
export function button(text: string, does: () => void): HTMLButtonElement {
    const made = create("button", "button", text);
    made.type = "button";
    made.addEventListener("click", does);
    return made;
}
