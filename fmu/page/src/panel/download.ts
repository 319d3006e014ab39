/** Files that the page gives away. */

/** Saves a text or blob as a file. */
export function save(name: string, content: Blob | string): void {
    const blob = typeof content === "string" ? new Blob([content], { type: "text/plain" }) : content;
    const anchor = document.createElement("a");
    anchor.href = URL.createObjectURL(blob);
    anchor.download = name;
    anchor.click();
    // The browser reads the blob after the click.
    setTimeout(() => URL.revokeObjectURL(anchor.href), 10_000);
}
