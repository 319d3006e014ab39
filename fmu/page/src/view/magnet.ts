import {
    Box3,
    BoxGeometry,
    BufferGeometry,
    type Color,
    CanvasTexture,
    CylinderGeometry,
    Float32BufferAttribute,
    Group,
    LatheGeometry,
    Mesh,
    MeshBasicMaterial,
    MeshStandardMaterial,
    PlaneGeometry,
    type Quaternion,
    SphereGeometry,
    SRGBColorSpace,
    type Texture,
    Vector2,
    Vector3,
} from "three";
import type { Part, Solid } from "../protocol";
import type { Palette } from "./colours";
import { MM } from "./shape";

/** Parts of a full circle. */
const AROUND = 96;

/** Letters on the side of each half. */
const LETTERS = 4;

/** Parts of an edge and of a meridian where the poles are told by the colour of their faces. */
const ACROSS = 24;

/** Opacity of a magnet without strength. */
const FADED = 0.22;

/** A cylinder of a magnet or coil. */
type Cylinder = Extract<Solid, { shape: "cylinder" }>;

/**
 * A magnet: cylinders about its z axis, magnetised along it, each half in the colour of its pole and with its letter; other parts in the
 * colours of their poles. Or a coil, in that of a wire.
 */
export class Magnet {
    /** Whether it is switched off. */
    faded = false;
    readonly group = new Group();
    private readonly materials: (MeshStandardMaterial | MeshBasicMaterial)[] = [];
    private readonly textures: Texture[] = [];

    constructor(
        private readonly parts: readonly Part[],
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
        const colours = { north: palette.north, south: palette.south };
        for (const solid of parts) {
            const [x, y, z] = solid.remanence;
            if (solid.shape === "cylinder" && (coil || (x === 0 && y === 0))) {
                this.halves(solid, solid.offset, coil ? 0 : z, paint, ink);
            } else {
                const geometry = withPoles(geometryOf(solid), new Vector3(x, y, z), colours);
                const own = new MeshStandardMaterial({
                    vertexColors: true,
                    metalness: 0.15,
                    roughness: 0.36,
                });
                const mesh = new Mesh(geometry, this.keep(own));
                mesh.position.z = MM * solid.offset;
                this.group.add(mesh);
            }
        }
    }

    /** The two halves of a cylinder with this remanence along z. */
    private halves(
        cylinder: Cylinder,
        offset: number,
        remanence: number,
        paint: Record<"north" | "south" | "plain", MeshStandardMaterial>,
        ink: Record<"north" | "south", MeshBasicMaterial>,
    ): void {
        const half = (MM * cylinder.length) / 2;
        for (const side of [-1, 1] as const) {
            const pole = remanence === 0 ? "plain" : side * remanence > 0 ? "north" : "south";
            const part = new Group();
            part.add(new Mesh(halfCylinder(cylinder, half), paint[pole]));
            if (pole !== "plain") this.letter(part, cylinder, half, ink[pole]);
            // Halves are built towards +z with letters upright; the other one is turned about the x axis.
            part.position.z = MM * offset;
            if (side < 0) part.rotation.x = Math.PI;
            this.group.add(part);
        }
    }

    /** Whether it is in the way: a coil also without a current. */
    get present(): boolean {
        return this.coil || !this.faded;
    }

    /** The box around it as it lies. */
    box(): Box3 {
        const box = new Box3();
        const turn = this.group.quaternion;
        for (const part of this.parts) {
            const place = new Vector3(0, 0, MM * part.offset).applyQuaternion(turn).add(this.group.position);
            const size = reachOf(part, turn).multiplyScalar(2);
            box.union(new Box3().setFromCenterAndSize(place, size));
        }
        return box;
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

/** How far a part reaches from its middle along the axes of the world, where its source is turned. */
function reachOf(part: Solid, turn: Quaternion): Vector3 {
    const axes = [0, 1, 2].map((k) => new Vector3().setComponent(k, 1).applyQuaternion(turn));
    const [first, second, axis] = axes as [Vector3, Vector3, Vector3];
    const along = (component: 0 | 1 | 2) => {
        const [x, y, z] = [first, second, axis].map((one) => Math.abs(one.getComponent(component)));
        const parts = [x, y, z] as [number, number, number];
        switch (part.shape) {
            case "cylinder":
                return (part.length / 2) * parts[2] + part.outerRadius * Math.hypot(parts[0], parts[1]);
            case "cuboid":
                return parts.reduce((sum, share, k) => sum + (share * (part.size[k] ?? 0)) / 2, 0);
            case "sphere":
                return part.radius;
        }
    };
    return new Vector3(along(0), along(1), along(2)).multiplyScalar(MM);
}

/** The surface of a part, in many faces. */
function geometryOf(part: Solid): BufferGeometry {
    switch (part.shape) {
        case "cylinder": {
            const [inner, outer, half] = [part.innerRadius, part.outerRadius, part.length / 2].map(
                (v) => MM * v,
            );
            const steps = Array.from({ length: ACROSS + 1 }, (_, k) => k / ACROSS);
            const line = (from: [number, number], to: [number, number]) =>
                steps.map(
                    (t) => new Vector2(from[0] + (to[0] - from[0]) * t, from[1] + (to[1] - from[1]) * t),
                );
            const [r, a, h] = [outer as number, inner as number, half as number];
            const profile = [...line([a, -h], [r, -h]), ...line([r, -h], [r, h]), ...line([r, h], [a, h])];
            const bore = a > 0 ? line([a, h], [a, -h]) : [];
            return new LatheGeometry([...profile, ...bore], AROUND).rotateX(Math.PI / 2);
        }
        case "cuboid": {
            const [x, y, z] = part.size.map((edge) => MM * edge) as [number, number, number];
            return new BoxGeometry(x, y, z, ACROSS, ACROSS, ACROSS);
        }
        case "sphere":
            return new SphereGeometry(MM * part.radius, AROUND, AROUND / 2);
    }
}

/** The surface with every face in the colour of the pole on whose side of the middle it lies. */
function withPoles(
    surface: BufferGeometry,
    remanence: Vector3,
    { north, south }: Record<"north" | "south", Color>,
): BufferGeometry {
    const faces = surface.toNonIndexed();
    surface.dispose();
    const places = faces.getAttribute("position");
    const painted = new Float32Array(3 * places.count);
    const corner = new Vector3();
    for (let first = 0; first < places.count; first += 3) {
        let height = 0;
        for (let k = first; k < first + 3; k++) {
            height += corner.fromBufferAttribute(places, k).dot(remanence);
        }
        for (let k = first; k < first + 3; k++) (height > 0 ? north : south).toArray(painted, 3 * k);
    }
    return faces.setAttribute("color", new Float32BufferAttribute(painted, 3));
}
