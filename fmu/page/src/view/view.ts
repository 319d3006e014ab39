import { type Answer, type Description, Status } from "../protocol";
import { DARK, LIGHT } from "./colours";
import { Drawing, type Overlay, OVERLAYS, type Pose } from "./drawing";
import { binaryGltf } from "./export";
import { Floor } from "./floor";
import { MM, scaled } from "./shape";
import { Stage } from "./stage";
import { Tint } from "./tint";
import { Trace } from "./trace";

export { OVERLAYS };
export type { Overlay, Pose };

/** What the view tells the page. */
export interface ViewEvents {
    /** The magnet was dragged or turned; called at most once a frame. */
    moved(pose: Pose): void;
    dragging(on: boolean): void;
}

/** The device, its magnet and its vessel in 3-D, to scale. The scene's unit is the millimetre. */
export class View {
    private readonly stage: Stage;
    private readonly floor = new Floor();
    private readonly tint = new Tint();
    private readonly trace = new Trace(LIGHT.trace);
    private readonly overlays = new Set<Overlay>();
    private drawing: Drawing | null = null;
    private answer: Answer | null = null;
    /** The answer, or how it is drawn, has changed since the last picture. */
    private stale = false;
    private moved = false;
    private dark = false;
    private strength = 1;

    /** Throws an error that can be shown where the browser has no WebGL. */
    constructor(
        container: HTMLElement,
        private readonly events: ViewEvents,
    ) {
        this.stage = new Stage(container, (now) => this.update(now));
        this.stage.scene.add(this.floor.mesh, this.trace.line);
        this.stage.gizmo.addEventListener("objectChange", () => (this.moved = true));
        this.stage.gizmo.addEventListener("dragging-changed", (event) => {
            // The last move comes before the end of the drag.
            if (!event.value) this.tellMoved();
            this.events.dragging(event.value === true);
        });
        this.setDark(false);
    }

    /** Builds what a description holds, at the start of its inputs, and frames it. */
    open(description: Description): void {
        this.answer = null;
        this.trace.clear();
        const drawing = this.build(description);
        const { pose, strength } = drawing.start();
        this.setMagnet(pose, strength);
        this.frame();
    }

    /** Shows an answer at the next animation frame. */
    show(answer: Answer): void {
        if (answer.first) this.trace.lift();
        this.answer = answer;
        this.tint.aim(answer.final, answer.status !== Status.NotSolved);
        this.refresh();
    }

    /** Puts the magnet to a pose; while it is dragged only its strength is taken. */
    setMagnet(pose: Pose, strength: number): void {
        this.strength = strength;
        const magnet = this.drawing?.magnet;
        if (!magnet) return;
        magnet.setStrength(strength);
        const [w, x, y, z] = pose.orientation;
        const known = [...pose.position, ...pose.orientation].every(Number.isFinite);
        if (known && !this.stage.gizmo.dragging) {
            magnet.group.position.set(...scaled(pose.position));
            magnet.group.quaternion.set(x, y, z, w).normalize();
        }
        this.stage.change();
    }

    /** Switches an overlay. */
    setOverlay(overlay: Overlay, on: boolean): void {
        if (on) this.overlays.add(overlay);
        else this.overlays.delete(overlay);
        this.refresh();
    }

    /** Chooses what the handles at the magnet do. */
    setGizmo(mode: "translate" | "rotate"): void {
        this.stage.gizmo.setMode(mode);
    }

    /** Takes the colours for a dark or a light page. */
    setDark(dark: boolean): void {
        this.dark = dark;
        const palette = dark ? DARK : LIGHT;
        this.stage.setTheme(palette.background, palette.text);
        this.floor.setColour(palette.grid);
        this.trace.setColour(palette.trace);
        this.tint.setPale(palette.pale);
        if (this.drawing) this.build(this.drawing.description);
    }

    /** Takes the line of the tip away. */
    clearTrace(): void {
        this.trace.clear();
        this.stage.change();
    }

    /** Moves the camera back to where all is seen, or close to the device. */
    frame(what: "all" | "device" = "all"): void {
        const { drawing } = this;
        if (!drawing) return;
        // An answer that came since the last picture counts, too.
        this.update(performance.now());
        const box = what === "all" ? drawing.box() : drawing.deviceBox();
        if (what === "all") this.floor.lay(box);
        this.stage.frame(box, drawing.flat ? "above" : "side");
    }

    /** What is seen, as a PNG. */
    picture(): Promise<Blob> {
        return this.stage.picture();
    }

    /** Device and magnet as binary glTF, in metres. */
    async gltf(): Promise<Blob> {
        if (!this.drawing) throw new Error("There is no device yet.");
        this.update(performance.now());
        return binaryGltf(this.drawing.solids());
    }

    /** Where the middle of the gizmo is seen, in CSS pixels of the container; null without a magnet. */
    magnetOnScreen(): [number, number] | null {
        const magnet = this.drawing?.magnet;
        return magnet ? this.stage.onScreen(magnet.group.position) : null;
    }

    /** Builds all that depends on description and theme, in place of what was there. */
    private build(description: Description): Drawing {
        const before = this.drawing;
        const drawing = new Drawing(description, this.dark, this.tint, this.stage.scene);
        const { magnet } = drawing;
        if (magnet) {
            if (before?.magnet) {
                magnet.group.position.copy(before.magnet.group.position);
                magnet.group.quaternion.copy(before.magnet.group.quaternion);
            }
            magnet.setStrength(this.strength);
        }
        this.stage.gizmo.hold(magnet ? magnet.group : null);
        before?.dispose();
        this.drawing = drawing;
        this.refresh();
        return drawing;
    }

    /** Has the answer drawn anew at the next picture. */
    private refresh(): void {
        this.stale = true;
        this.stage.change();
    }

    /** Brings everything up to date before a picture; true while it must go on. */
    private update(now: number): boolean {
        this.tellMoved();
        if (this.stale) {
            this.stale = false;
            this.trace.line.visible = this.overlays.has("trace");
            const tip = this.drawing && this.answer && this.drawing.bend(this.answer, this.overlays);
            if (tip) this.trace.add(tip);
        }
        return this.tint.ease(now);
    }

    private tellMoved(): void {
        const magnet = this.drawing?.magnet;
        if (!this.moved || !magnet) return;
        this.moved = false;
        const { x, y, z } = magnet.group.position;
        const turn = magnet.group.quaternion;
        this.events.moved({
            position: [x / MM, y / MM, z / MM],
            orientation: [turn.w, turn.x, turn.y, turn.z],
        });
    }
}
