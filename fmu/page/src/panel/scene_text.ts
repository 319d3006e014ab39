/** Changes single keys in the text of a scene and keeps all else, remarks included. */

/** Where a top-level line stands in the text: its number, and the table that it belongs to ("" before the first). */
interface Line {
    text: string;
    number: number;
    table: string;
}

const HEADER = /^\s*\[\s*([^[\]]+?)\s*\]\s*(#.*)?$/;
const ARRAY_HEADER = /^\s*\[\[\s*([^[\]]+?)\s*\]\]\s*(#.*)?$/;

/** The value of a key as it is written, such as `"rings"` or `9`; null where the text does not have it. */
export function valueIn(text: string, table: string, key: string): string | null {
    const found = find(lines(text), table, key);
    return found === undefined ? null : (split(found.text)?.value ?? null);
}

/** The text with a key set to a value as TOML writes it; null where it is written in a way that cannot be changed by line. */
export function withValue(text: string, table: string, key: string, value: string): string | null {
    const rows = text.split("\n");
    const known = lines(text);
    const found = find(known, table, key);
    if (found !== undefined) {
        const parts = split(found.text);
        if (parts === null || !closed(parts.value)) {
            return null;
        }
        rows[found.number] = `${parts.before}${value}${parts.after}`;
        return rows.join("\n");
    }
    const inline = known.some((line) => line.table === "" && keyOf(line.text) === table);
    if (inline) {
        return null;
    }
    const header = known.find((line) => HEADER.exec(line.text)?.[1] === table);
    if (header !== undefined) {
        rows.splice(header.number + 1, 0, `${key} = ${value}`);
        return rows.join("\n");
    }
    // A table that exists by dotted keys must not be opened by a header too.
    const dotted = known.find((line) => line.table === "" && keyOf(line.text)?.startsWith(`${table}.`));
    if (dotted !== undefined) {
        rows.splice(dotted.number, 0, `${table}.${key} = ${value}`);
        return rows.join("\n");
    }
    return `${text.replace(/\n*$/, text.trim() === "" ? "" : "\n\n")}[${table}]\n${key} = ${value}\n`;
}

function find(known: Line[], table: string, key: string): Line | undefined {
    return known.find(
        ({ text, table: within }) =>
            (within === table && keyOf(text) === key) || (within === "" && keyOf(text) === `${table}.${key}`),
    );
}

/** The lines that begin outside of any array or string that spans lines. */
function lines(text: string): Line[] {
    const top: Line[] = [];
    let table = "";
    let open: Open = { depth: 0, quote: "" };
    text.split("\n").forEach((row, number) => {
        if (open.depth === 0 && open.quote === "") {
            table = HEADER.exec(row)?.[1] ?? ARRAY_HEADER.exec(row)?.[1] ?? table;
            top.push({ text: row, number, table });
        }
        const isHeader = open.depth === 0 && (HEADER.test(row) || ARRAY_HEADER.test(row));
        open = isHeader ? open : after(row, open);
    });
    return top;
}

/** What is open at the end of a line: brackets, and the quotes of a string that spans lines. */
interface Open {
    depth: number;
    quote: string;
}

function after(row: string, { depth, quote }: Open): Open {
    for (let at = 0; at < row.length;) {
        const rest = row.slice(at);
        const quotes = /^("""|'''|"|')/.exec(rest)?.[0] ?? "";
        if (quote !== "") {
            const escaped = quote.startsWith('"') && rest.startsWith("\\");
            const ends = rest.startsWith(quote);
            at += escaped ? 2 : ends ? quote.length : 1;
            quote = ends && !escaped ? "" : quote;
        } else if (rest.startsWith("#")) {
            break;
        } else if (quotes !== "") {
            quote = quotes;
            at += quotes.length;
        } else {
            depth += /^[[{]/.test(rest) ? 1 : /^[\]}]/.test(rest) ? -1 : 0;
            at += 1;
        }
    }
    return { depth: Math.max(0, depth), quote: quote.length === 3 ? quote : "" };
}

function closed(value: string): boolean {
    const { depth, quote } = after(value, { depth: 0, quote: "" });
    return depth === 0 && quote === "";
}

function keyOf(line: string): string | null {
    const key = /^\s*([^=#[]+?)\s*=/.exec(line)?.[1];
    return key === undefined ? null : key.replace(/\s*\.\s*/g, ".").replace(/["']/g, "");
}

/** A line as what stands before the value, the value, and spaces and remark after it. */
function split(line: string): { before: string; value: string; after: string } | null {
    const parts = /^(\s*[^=]+?=\s*)("(?:[^"\\]|\\.)*"|'[^']*'|[^#]*?)(\s*(?:#.*)?)$/.exec(line);
    return parts === null ? null : { before: parts[1]!, value: parts[2]!, after: parts[3]! };
}
