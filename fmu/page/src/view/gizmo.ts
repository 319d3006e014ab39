import { type Camera, type Object3D, Vector3 } from "three";
import { TransformControls } from "three/examples/jsm/controls/TransformControls.js";

/** Handles in units of three's own, about an eighth of the view's height; larger where a finger points. */
const SIZE = { mouse: 0.8, finger: 1.15 };

/**
 * Handles that move or turn the magnet. Besides the handles the magnet itself can be dragged: it then moves in the plane of two
 * axes that faces the camera most, so that it stays where it is in depth, or turns freely.
 */
export class Gizmo extends TransformControls {
    private grip: Object3D | null = null;
    private finger = false;
    private aspect = 1;

    constructor(camera: Camera, element: HTMLElement) {
        // Three's handlers are added by `connect`, after the one below: a second finger must not begin to drag.
        super(camera, null);
        element.addEventListener("pointerdown", (event) => {
            this.finger = event.pointerType === "touch";
            this.fit();
            if (!this.dragging) this.enabled = event.isPrimary;
        });
        // A system gesture may take the finger away without lifting it.
        element.addEventListener("pointercancel", () => this.pointerUp(null));
        this.connect(element);
        this.setColors("#e5484d", "#3fa34d", "#3e7bfa", "#f5b301");
        this.finger = window.matchMedia("(pointer: coarse)").matches;
        this.fit();
    }

    /** Holds an object, or nothing. */
    hold(object: Object3D | null): void {
        this.grip = object;
        if (object) this.attach(object);
        else this.detach();
    }

    /** Fits the handles to a view of this width, relative to its height. */
    setAspect(aspect: number): void {
        this.aspect = aspect;
        this.fit();
    }

    override pointerHover(pointer: PointerEvent | null): void {
        if (this.dragging) return;
        super.pointerHover(pointer);
        if (!this.object || !this.grip) return;
        if (this.axis === null && this.getRaycaster().intersectObject(this.grip, true).length > 0) {
            this.axis = this.mode === "rotate" ? "XYZE" : "XYZ";
        }
        if (this.axis === "XYZ") this.axis = this.facingPlane();
    }

    private fit(): void {
        const size = this.finger ? SIZE.finger : SIZE.mouse;
        // Three's handles follow the view's height, which a narrow view has too much of.
        this.setSize(size * Math.min(1, 1.5 * this.aspect));
    }

    /** The plane of two axes that the camera looks at most. */
    private facingPlane(): "YZ" | "XZ" | "XY" {
        const way = new Vector3();
        this.camera.getWorldDirection(way);
        const [x, y, z] = [Math.abs(way.x), Math.abs(way.y), Math.abs(way.z)];
        return x >= y && x >= z ? "YZ" : y >= z ? "XZ" : "XY";
    }
}
