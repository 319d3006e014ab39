/** What is plotted: some numbers of every answer over time, in memory that does not grow. */

/** Numbers of an answer. */
export interface Point {
    /** Time since the device was loaded, s. */
    time: number;
    /** By the model asked for; else a cheaper one filled in. */
    final: boolean;
    values: readonly number[];
}

/** Most points kept; the oldest half goes when there are more. */
const MOST = 16_384;

/** Points in order of time. */
export class History {
    private count = 0;
    private readonly times = new Float64Array(MOST);
    private readonly finals = new Uint8Array(MOST);
    private readonly columns: Float64Array[];
    /** Times of the snaps. */
    snaps: number[] = [];

    constructor(width: number) {
        this.columns = Array.from({ length: width }, () => new Float64Array(MOST));
    }

    get last(): number {
        return this.count === 0 ? 0 : this.times[this.count - 1]!;
    }

    clear(): void {
        this.count = 0;
        this.snaps = [];
    }

    append({ time, final, values }: Point): void {
        if (this.count === MOST) {
            const half = MOST / 2;
            for (const column of [this.times, this.finals, ...this.columns]) {
                column.copyWithin(0, half);
            }
            this.count = half;
            this.snaps = this.snaps.filter((snap) => snap >= this.times[0]!);
        }
        this.times[this.count] = time;
        this.finals[this.count] = Number(final);
        this.columns.forEach((column, place) => (column[this.count] = values[place] ?? NaN));
        this.count += 1;
    }

    /** Gives the newest point another value in a column. */
    amend(column: number, value: number): void {
        const values = this.columns[column];
        if (values !== undefined && this.count > 0) {
            values[this.count - 1] = value;
        }
    }

    /** Times since `from`, and of one column the values of the model asked for and of those that filled in; null is no value. */
    since(from: number, column: number): [number[], (number | null)[], (number | null)[]] {
        let begin = this.count;
        while (begin > 0 && this.times[begin - 1]! >= from) {
            begin -= 1;
        }
        // One point before the window lets lines come in from its left.
        begin = Math.max(0, begin - 1);
        const values = this.columns[column];
        const pick = (final: 0 | 1) =>
            Array.from({ length: this.count - begin }, (_, k) => {
                const value = values?.[begin + k] ?? NaN;
                return this.finals[begin + k] === final && Number.isFinite(value) ? value : null;
            });
        return [Array.from(this.times.subarray(begin, this.count)), pick(1), pick(0)];
    }
}
