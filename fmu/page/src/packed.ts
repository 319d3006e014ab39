/** Bytes that come with the page. */

/** The text of an element that holds bytes as base64 of gzip; empty where there is no such element. */
export function packed(id: string): string {
    return document.getElementById(id)?.textContent?.trim() ?? "";
}

/** The bytes of such a text; none of an empty one. */
export async function unpacked(text: string): Promise<ArrayBuffer> {
    if (text === "") {
        return new ArrayBuffer(0);
    }
    const response = await fetch(`data:application/gzip;base64,${text}`);
    return new Response(response.body!.pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}
