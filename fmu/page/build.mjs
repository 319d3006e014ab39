// Builds the page: one HTML file with script, style, worker, core and, where given, a scene and its mesh.
//
//     node build.mjs --core mcm.wasm --out mcm_live.html [--scene scene.toml] [--grid vessel.grid --mesh vessel.stl]

import { readFile, writeFile } from "node:fs/promises";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const text = { type: "string" };
const options = { core: text, out: text, scene: text, grid: text, mesh: text };
const { values: given } = parseArgs({ options });
if (given.core === undefined || given.out === undefined) {
    throw new Error("--core and --out are needed");
}

/** A script or style with all that it imports, as one text. */
async function bundled(entry, format) {
    const { outputFiles } = await build({
        entryPoints: [join(here, entry)],
        bundle: true,
        minify: true,
        ...(format === undefined ? {} : { format }),
        target: "es2022",
        loader: { ".toml": "text" },
        legalComments: "eof", // the licences of three.js and uPlot stay with their code
        write: false,
    });
    return outputFiles[0].text;
}

/** An element that holds a text; nothing in it ends the element or begins a comment. */
function element(id, content) {
    const inert = content.replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");
    return `<script type="text/plain" id="${id}">${inert}</script>\n`;
}

/** An element that holds bytes: gzip, then base64. */
async function packed(id, path) {
    return element(id, gzipSync(await readFile(path), { level: 9 }).toString("base64"));
}

let data = (await packed("core", given.core)) + element("worker", await bundled("src/worker.ts", "iife"));
if (given.scene !== undefined) {
    const scene = { name: basename(given.scene), text: await readFile(given.scene, "utf8") };
    data += element("scene", JSON.stringify(scene));
}
if (given.grid !== undefined && given.mesh !== undefined) {
    data += (await packed("grid", given.grid)) + (await packed("mesh", given.mesh));
}

const style = await bundled("style.css");
const script = (await bundled("src/main.ts", "esm")).replaceAll("</script", "<\\/script");
const page = (await readFile(join(here, "index.html"), "utf8"))
    .replace("/*STYLE*/", () => style)
    .replace(/<script type="module">\s*\/\*SCRIPT\*\/\s*<\/script>/, () => {
        return `${data}<script type="module">${script}</script>`;
    });
await writeFile(given.out, page);
