import { type PerspectiveCamera, Vector3 } from "three";

/** Size of the drawing, CSS pixels. */
const [WIDTH, HEIGHT] = [200, 88];

/** Longest bar, CSS pixels. */
const LONGEST = 100;

const AXES = [
    { name: "x", way: new Vector3(1, 0, 0), colour: "#e5484d" },
    { name: "y", way: new Vector3(0, 1, 0), colour: "#3fa34d" },
    { name: "z", way: new Vector3(0, 0, 1), colour: "#3e7bfa" },
];

/** A scale bar, which holds at the distance of what the camera looks at, and the world's axes, in the corner of the view. */
export class ScaleBar {
    readonly canvas = document.createElement("canvas");
    private readonly ratio = Math.min(2, window.devicePixelRatio);
    private colour = "#000000";
    private drawn = "";

    constructor() {
        this.canvas.width = WIDTH * this.ratio;
        this.canvas.height = HEIGHT * this.ratio;
        this.canvas.style.cssText = `position:absolute;left:0;bottom:0;width:${WIDTH}px;height:${HEIGHT}px;pointer-events:none`;
    }

    setColour(colour: string): void {
        this.colour = colour;
    }

    /** Draws it for a camera at this distance (mm) from what it looks at, in a view of this height (CSS pixels). */
    draw(camera: PerspectiveCamera, distance: number, height: number): void {
        const pixel = (2 * distance * Math.tan((camera.fov * Math.PI) / 360)) / Math.max(1, height);
        const length = roundLength(LONGEST * pixel);
        const turn = camera.quaternion.clone().invert();
        const axes = AXES.map(({ name, way, colour }) => ({
            name,
            colour,
            seen: way.clone().applyQuaternion(turn),
        }));
        const key = [
            this.colour,
            (length / pixel).toFixed(1),
            ...axes.map(({ seen }) => seen.toArray().map((x) => x.toFixed(3))),
        ];
        if (key.join() === this.drawn) return;
        this.drawn = key.join();

        const context = this.canvas.getContext("2d");
        if (!context) return;
        context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
        context.clearRect(0, 0, WIDTH, HEIGHT);
        context.lineCap = "round";
        context.font = "11px system-ui, sans-serif";
        context.textAlign = "center";
        context.textBaseline = "middle";
        // Axes that point away are drawn first, beneath the others.
        for (const { name, colour, seen } of axes.sort((a, b) => a.seen.z - b.seen.z)) {
            const [x, y] = [40 + 22 * seen.x, HEIGHT - 42 - 22 * seen.y];
            context.strokeStyle = context.fillStyle = colour;
            context.lineWidth = 2;
            context.beginPath();
            context.moveTo(40, HEIGHT - 42);
            context.lineTo(x, y);
            context.stroke();
            context.fillText(name, 40 + 31 * seen.x, HEIGHT - 42 - 31 * seen.y);
        }
        context.strokeStyle = context.fillStyle = this.colour;
        context.lineWidth = 1.5;
        const [left, right, level] = [84, 84 + length / pixel, HEIGHT - 20];
        context.beginPath();
        context.moveTo(left, level - 4);
        context.lineTo(left, level);
        context.lineTo(right, level);
        context.lineTo(right, level - 4);
        context.stroke();
        context.fillText(`${length} mm`, (left + right) / 2, level - 11);
    }
}

/** The greatest of 1, 2, 5, 10, 20, ... that is not longer. */
function roundLength(most: number): number {
    const decade = 10 ** Math.floor(Math.log10(most));
    const times = [5, 2, 1].find((factor) => factor * decade <= most) ?? 1;
    return Number((times * decade).toPrecision(1));
}
