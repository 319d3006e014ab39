/** Tapes as tables: a path that the FMU takes as its input file, or all results; and tables read back. */

import type { Description, Variable } from "../protocol";
import { MOST, type Row } from "./tape";

/** Time and all inputs, SI, in full precision. Rows that were not solved are left out: there an FMU would stop, and the
 * device goes on from its last good shape as if they had not been. */
export function pathOf(rows: Row[], { inputs }: Description): string {
    const solved = rows.filter((row) => row.solved);
    const begin = solved[0]?.time ?? 0;
    const table = solved.map(({ time, inputs }) => [since(begin, time), ...inputs]);
    return written(["time", ...names(inputs)], table);
}

/** Time, all inputs and all outputs, SI, of all rows; those that were not solved have the last good outputs and status 3. */
export function resultsOf(rows: Row[], { inputs, outputs }: Description): string {
    const table = rows.map((row) => [row.time, ...row.inputs, ...row.outputs]);
    return written(["time", ...names(inputs), ...names(outputs)], table);
}

/** Time of a row since the first one, without what rounding of the difference adds. */
function since(begin: number, time: number): number {
    return Math.round(1e3 * (time - begin)) / 1e3;
}

function names(variables: Variable[]): string[] {
    return variables.map(({ name }) => (name.includes(",") ? `"${name}"` : name));
}

function written(header: string[], rows: number[][]): string {
    const numbers = (row: number[]) =>
        row.map((value) => (Number.isNaN(value) ? "" : String(value))).join(",");
    return [header.join(","), ...rows.map(numbers)].join("\n") + "\n";
}

/** A table by its columns' names. */
export interface Table {
    time: number[];
    columns: Map<string, number[]>;
}

/** Reads a table of numbers with a header; an error says in words what is wrong with it. */
export function tableOf(text: string): Table {
    const [header = "", ...lines] = text.split(/\r?\n/).filter((line) => line.trim() !== "");
    const named = cells(header);
    if (lines.length > MOST) {
        throw new Error(`it has more than ${MOST} rows`);
    }
    const values: number[][] = named.map(() => []);
    lines.forEach((line, row) => {
        const read = cells(line);
        if (read.length !== named.length) {
            throw new Error(`line ${row + 2} has ${read.length} values and the header ${named.length}`);
        }
        read.forEach((cell, column) => values[column]!.push(cell.trim() === "" ? NaN : Number(cell)));
    });
    const columns = new Map(named.map((name, column) => [name.trim(), values[column]!]));
    const time = columns.get("time");
    if (time === undefined || time.length === 0) {
        throw new Error("it has no column named time, or no rows");
    }
    if (time.some((at, row) => !Number.isFinite(at) || (row > 0 && at <= time[row - 1]!))) {
        throw new Error("its times do not increase");
    }
    columns.delete("time");
    return { time, columns };
}

/** The cells of a line; quotes keep commas together. */
function cells(line: string): string[] {
    return [...line.matchAll(/(?:^|,)(?:"([^"]*)"|([^,]*))/g)].map(
        ([, quoted, plain]) => quoted ?? plain ?? "",
    );
}
