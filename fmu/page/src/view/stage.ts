import {
    Box3,
    DirectionalLight,
    HemisphereLight,
    PerspectiveCamera,
    Scene,
    Vector3,
    WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { Gizmo } from "./gizmo";
import { ScaleBar } from "./scale";

/** Ways from what is looked at to the camera: y is up, z to the right, seen slightly from above and from the base's side. */
const FROM = {
    side: new Vector3(-1, 0.36, -0.22).normalize(),
    above: new Vector3(-1, 0.95, -0.22).normalize(),
};

/** Part of the view's width and height that what is framed may fill, and part of its half height by which that is raised: buttons
 * and messages lie over the lower edge. */
const FILLED = { wide: 0.88, high: 0.74 };
const RAISED = 0.14;

/** Pixels for each CSS pixel at most: more costs time and shows nothing. */
const MOST_PIXELS = 2;

/** Renderer, camera, lights and controls. It draws when something has changed, and does not turn idly. */
export class Stage {
    readonly scene = new Scene();
    readonly camera = new PerspectiveCamera(30, 1, 1, 10000);
    readonly gizmo: Gizmo;
    private readonly renderer: WebGLRenderer;
    private readonly orbit: OrbitControls;
    private readonly scale = new ScaleBar();
    private asked = 0;
    private sized = false;
    private background = "#ffffff";
    private framed = new Box3(new Vector3(-50, -50, -50), new Vector3(50, 50, 50));
    private way: keyof typeof FROM = "side";
    private untouched = true;

    /** `draw` is called before each picture and returns whether it must be called again for the next one. */
    constructor(
        private readonly container: HTMLElement,
        private readonly draw: (now: number) => boolean,
    ) {
        this.renderer = newRenderer();
        const canvas = this.renderer.domElement;
        canvas.style.cssText = "position:absolute;inset:0;width:100%;height:100%;display:block;outline:none";
        if (getComputedStyle(container).position === "static") container.style.position = "relative";
        container.append(canvas, this.scale.canvas);

        // The gizmo hears of a finger first, so that it can keep it from the camera.
        this.gizmo = new Gizmo(this.camera, canvas);
        this.scene.add(this.gizmo.getHelper());
        this.orbit = new OrbitControls(this.camera, canvas);
        this.orbit.enableDamping = true;
        this.orbit.dampingFactor = 0.12;
        this.orbit.zoomToCursor = true;
        this.orbit.minDistance = 8;
        this.orbit.maxDistance = 6000;
        this.orbit.addEventListener("start", () => (this.untouched = false));
        this.orbit.addEventListener("change", () => this.change());
        this.gizmo.addEventListener("change", () => this.change());
        this.gizmo.addEventListener("dragging-changed", (event) => {
            this.orbit.enabled = !event.value;
        });

        this.light();
        new ResizeObserver(() => {
            this.sized = false;
            this.change();
        }).observe(container);
        canvas.addEventListener("webglcontextrestored", () => this.change());
    }

    /** Draws a picture at the next animation frame. */
    change(): void {
        if (this.asked === 0) this.asked = requestAnimationFrame((now) => this.render(now));
    }

    /** Colours of page and scale bar; the view itself is transparent. */
    setTheme(background: string, text: string): void {
        this.background = background;
        this.scale.setColour(text);
        this.change();
    }

    /** Moves the camera to where all of a box is seen, as large as possible; what lies flat is better seen from above. */
    frame(box: Box3, from: keyof typeof FROM): void {
        this.framed.copy(box);
        this.way = from;
        const way = FROM[from];
        this.untouched = true;
        this.resize();
        const { camera } = this;
        const target = box.getCenter(new Vector3());
        camera.position.copy(target).addScaledVector(way, 1000);
        camera.up.set(0, 1, 0);
        camera.lookAt(target);
        const [right, up, back] = [new Vector3(), new Vector3(), new Vector3()];
        camera.matrixWorld
            .compose(camera.position, camera.quaternion, camera.scale)
            .extractBasis(right, up, back);
        const half = Math.tan((camera.fov * Math.PI) / 360);
        const high = half * FILLED.high;
        const wide = half * camera.aspect * FILLED.wide;
        let distance = 0;
        // The box's middle is not the middle of its picture: move the target until the corners lie evenly, then step back.
        for (let round = 0; round < 8; round++) {
            distance = 0;
            let [low, top, left, end] = [Infinity, -Infinity, Infinity, -Infinity];
            const from = corners(box).map((corner) => corner.sub(target));
            for (const one of from) {
                const [x, y, z] = [Math.abs(one.dot(right)), Math.abs(one.dot(up)), one.dot(back)];
                distance = Math.max(distance, z + x / wide, z + y / high);
            }
            for (const one of from) {
                const depth = distance - one.dot(back);
                const [x, y] = [one.dot(right) / depth, one.dot(up) / depth];
                [low, top, left, end] = [
                    Math.min(low, y),
                    Math.max(top, y),
                    Math.min(left, x),
                    Math.max(end, x),
                ];
            }
            target
                .addScaledVector(right, ((left + end) / 2) * distance)
                .addScaledVector(up, ((low + top) / 2) * distance);
        }
        target.addScaledVector(up, -RAISED * half * distance);
        camera.position.copy(target).addScaledVector(way, distance);
        this.orbit.target.copy(target);
        this.orbit.update();
        this.change();
    }

    /** What is seen, as a PNG on the page's background, with the scale bar and without the handles. */
    async picture(): Promise<Blob> {
        const helper = this.gizmo.getHelper();
        const shown = helper.visible;
        helper.visible = false;
        this.render(performance.now());
        helper.visible = shown;
        const canvas = document.createElement("canvas");
        const { width, height } = this.renderer.domElement;
        [canvas.width, canvas.height] = [width, height];
        const context = canvas.getContext("2d");
        if (!context) throw new Error("This browser has no room for a picture.");
        context.fillStyle = this.background;
        context.fillRect(0, 0, width, height);
        context.drawImage(this.renderer.domElement, 0, 0);
        context.drawImage(this.scale.canvas, 0, height - this.scale.canvas.height);
        this.change();
        return new Promise((resolve, reject) => {
            canvas.toBlob((blob) =>
                blob ? resolve(blob) : reject(new Error("The picture could not be made.")),
            );
        });
    }

    /** Where a place of the scene, mm, is seen, in CSS pixels of the container. */
    onScreen(place: Vector3): [number, number] {
        this.camera.updateMatrixWorld();
        const seen = place.clone().project(this.camera);
        return [
            ((1 + seen.x) / 2) * this.container.clientWidth,
            ((1 - seen.y) / 2) * this.container.clientHeight,
        ];
    }

    private render(now: number): void {
        cancelAnimationFrame(this.asked);
        this.asked = 0;
        if (!this.sized && this.resize() && this.untouched) this.frame(this.framed, this.way);
        const again = this.draw(now);
        const turning = this.orbit.update();
        const distance = this.camera.position.distanceTo(this.orbit.target);
        this.camera.near = distance / 60;
        this.camera.far = 30 * distance + 3000;
        this.camera.updateProjectionMatrix();
        this.renderer.render(this.scene, this.camera);
        this.scale.draw(this.camera, distance, this.container.clientHeight);
        if (again || turning) this.change();
    }

    /** Fits the picture to the container; false where that has no size. */
    private resize(): boolean {
        const { clientWidth: width, clientHeight: height } = this.container;
        if (width === 0 || height === 0) return false;
        this.renderer.setPixelRatio(Math.min(MOST_PIXELS, window.devicePixelRatio));
        this.renderer.setSize(width, height, false);
        this.camera.aspect = width / height;
        this.gizmo.setAspect(width / height);
        this.camera.updateProjectionMatrix();
        this.sized = true;
        return true;
    }

    /**
     * Light from the sky and the ground, a lamp that goes with the camera, and one above. There are no reflections of surroundings:
     * to prepare them takes seconds where the processor draws.
     */
    private light(): void {
        const lamp = new DirectionalLight("#ffffff", 1.5);
        lamp.position.set(-0.5, 1, 0.7);
        this.camera.add(lamp, lamp.target);
        lamp.target.position.set(0, 0, -1);
        const above = new DirectionalLight("#ffffff", 0.8);
        above.position.set(0.3, 1, 0.3);
        this.scene.add(this.camera, above, new HemisphereLight("#ffffff", "#9aa3af", 1.3));
    }
}

function newRenderer(): WebGLRenderer {
    try {
        const renderer = new WebGLRenderer({ antialias: true, alpha: true });
        renderer.setClearColor(0x000000, 0);
        return renderer;
    } catch {
        throw new Error("This browser shows no 3-D graphics: WebGL 2 is missing or switched off.");
    }
}

function corners({ min, max }: Box3): Vector3[] {
    return [0, 1, 2, 3, 4, 5, 6, 7].map(
        (k) => new Vector3(k & 1 ? max.x : min.x, k & 2 ? max.y : min.y, k & 4 ? max.z : min.z),
    );
}
