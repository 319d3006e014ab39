import {
    Box3,
    BufferGeometry,
    CanvasTexture,
    CylinderGeometry,
    Group,
    LatheGeometry,
    Mesh,
    MeshBasicMaterial,
    MeshStandardMaterial,
    PlaneGeometry,
    SRGBColorSpace,
    type Texture,
    Vector2,
    Vector3,
} from "three";
import type { Cylinder } from "../protocol";
import type { Palette } from "./colours";
import { MM } from "./shape";

/** Parts of a full circle. */
const AROUND = 96;

/** Letters on the side of each half. */
const LETTERS = 4;

/** Opacity of a magnet without strength. */
const FADED = 0.22;

/** A magnet: coaxial cylinders about its z axis, each half in the colour of its pole and with its letter. Or a coil, in that of a wire. */
export class Magnet {
    /** Whether it is switched off. */
    faded = false;
    readonly group = new Group();
    private readonly materials: (MeshStandardMaterial | MeshBasicMaterial)[] = [];
    private readonly textures: Texture[] = [];

    constructor(
        private readonly cylinders: readonly Cylinder[],
        palette: Palette,
        name = "magnet",
        private readonly coil = false,
    ) {
        this.group.name = name;
        const painted = (pole: "north" | "south" | "plain" | "wire") =>
            this.keep(new MeshStandardMaterial({ color: palette[pole], metalness: 0.15, roughness: 0.36 }));
        const plain = painted(coil ? "wire" : "plain");
        const paint = { north: painted("north"), south: painted("south"), plain };
        const ink = { north: this.ink("N"), south: this.ink("S") };
        for (const cylinder of cylinders) {
            const half = (MM * cylinder.length) / 2;
            for (const side of [-1, 1] as const) {
                const pole =
                    coil || cylinder.remanence === 0
                        ? "plain"
                        : side * cylinder.remanence > 0
                          ? "north"
                          : "south";
                const part = new Group();
                part.add(new Mesh(halfCylinder(cylinder, half), paint[pole]));
                if (pole !== "plain") this.letter(part, cylinder, half, ink[pole]);
                // Halves are built towards +z with letters upright; the other one is turned about the x axis.
                part.position.z = MM * cylinder.offset;
                if (side < 0) part.rotation.x = Math.PI;
                this.group.add(part);
            }
        }
    }

    /** Whether it is in the way: a coil also without a current. */
    get present(): boolean {
        return this.coil || !this.faded;
    }

    /** The box around it as it lies. */
    box(): Box3 {
        const along = Math.max(...this.cylinders.map((one) => MM * (Math.abs(one.offset) + one.length / 2)));
        const across = Math.max(...this.cylinders.map((one) => MM * one.outerRadius));
        const axis = new Vector3(0, 0, 1).applyQuaternion(this.group.quaternion);
        const reach = (part: number) =>
            along * Math.abs(part) + across * Math.sqrt(Math.max(0, 1 - part ** 2));
        const size = new Vector3(reach(axis.x), reach(axis.y), reach(axis.z)).multiplyScalar(2);
        return new Box3().setFromCenterAndSize(this.group.position, size);
    }

    /** Shows how strong it is: without strength it is faded. */
    setStrength(strength: number): void {
        const faded = strength === 0;
        this.faded = faded;
        for (const material of this.materials) {
            const letters = material instanceof MeshBasicMaterial;
            material.transparent = faded || letters;
            material.opacity = faded ? FADED : letters ? 0.95 : 1;
            material.depthWrite = !faded && !letters;
            material.needsUpdate = true;
        }
    }

    /** Frees what the graphics card holds. */
    dispose(): void {
        this.group.traverse((object) => {
            if (object instanceof Mesh) (object.geometry as BufferGeometry).dispose();
        });
        for (const one of [...this.materials, ...this.textures]) one.dispose();
    }

    /** Puts the letter on the side, several times around, and on the end face where that has room. */
    private letter(part: Group, cylinder: Cylinder, half: number, ink: MeshBasicMaterial): void {
        const radius = MM * cylinder.outerRadius;
        const size = Math.min(0.72 * half, 0.7 * radius);
        const angle = size / radius;
        for (let k = 0; k < LETTERS; k++) {
            // A patch of the side; three's cylinders are about y.
            const start = (2 * Math.PI * k) / LETTERS - angle / 2;
            const patch = new CylinderGeometry(
                radius * 1.003,
                radius * 1.003,
                size,
                12,
                1,
                true,
                start,
                angle,
            );
            patch.rotateX(Math.PI / 2).translate(0, 0, half / 2);
            part.add(new Mesh(patch, ink));
        }
        const wall = radius - MM * cylinder.innerRadius;
        const face = Math.min(0.8 * wall, 1.1 * radius);
        const patch = new PlaneGeometry(face, face).rotateZ(Math.PI / 2);
        const place = cylinder.innerRadius > 0 ? radius - wall / 2 : 0;
        part.add(new Mesh(patch.translate(0, place, half * 1.002 + 0.02), ink));
    }

    /** A material that draws a white letter, lying: it stands upright where the axis is level. N and S may stand on their heads. */
    private ink(letter: string): MeshBasicMaterial {
        const canvas = document.createElement("canvas");
        canvas.width = canvas.height = 128;
        const context = canvas.getContext("2d");
        if (context) {
            context.fillStyle = "#ffffff";
            context.font = "bold 116px system-ui, sans-serif";
            context.textAlign = "center";
            context.textBaseline = "alphabetic";
            context.translate(64, 64);
            context.rotate(-Math.PI / 2);
            context.fillText(letter, 0, 42);
        }
        const texture = new CanvasTexture(canvas);
        texture.colorSpace = SRGBColorSpace;
        texture.anisotropy = 8;
        this.textures.push(texture);
        return this.keep(new MeshBasicMaterial({ map: texture, transparent: true, depthWrite: false }));
    }

    private keep<T extends MeshStandardMaterial | MeshBasicMaterial>(material: T): T {
        this.materials.push(material);
        return material;
    }
}

/** The half of a cylinder from its middle towards +z, with broken edges. */
function halfCylinder(cylinder: Cylinder, half: number): LatheGeometry {
    const [inner, outer] = [MM * cylinder.innerRadius, MM * cylinder.outerRadius];
    const edge = Math.min(0.04 * outer, 0.1 * half, 0.2 * (outer - inner));
    const profile: [number, number][] = [
        [outer, 0],
        [outer, half - edge],
        [outer - edge, half],
        [inner, half],
        [inner, 0],
    ];
    // Doubled points make sharp edges: a lathe averages normals at points that it shares.
    const points = profile.slice(0, inner > 0 ? 5 : 4).flatMap(([radius, along], k, all) => {
        const point = new Vector2(radius, along);
        return k === 0 || k === all.length - 1 ? [point] : [point, point.clone()];
    });
    return new LatheGeometry(points, AROUND).rotateX(Math.PI / 2);
}
