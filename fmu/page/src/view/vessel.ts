import { Box3, BufferGeometry, Color, DoubleSide, Float32BufferAttribute, Mesh, ShaderMaterial } from "three";
import type { Description } from "../protocol";
import { Lumen } from "./lumen";
import type { Palette } from "./colours";
import { MM } from "./shape";

type Wall = NonNullable<Description["vessel"]>;

/**
 * The vessel's wall, clear where one looks through it and denser at its outline, like glass. It hides nothing: what is behind it and
 * in it stays visible. Its colour is the same on both sides, so that the order in which its faces are drawn does not matter.
 */
export class Vessel {
    readonly mesh: Mesh;
    /** The box around it, mm. */
    readonly bounds: Box3;

    constructor(vessel: Wall, palette: Palette) {
        const geometry =
            vessel.triangles.length > 0 ? fromTriangles(vessel.triangles) : new Lumen(vessel.branches).wall();
        geometry.computeBoundingBox();
        this.bounds = geometry.boundingBox ?? new Box3();
        const material = new ShaderMaterial({
            uniforms: {
                colour: { value: new Color(palette.wall) },
                clear: { value: 0.075 },
                dense: { value: 0.55 },
            },
            vertexShader: `
                varying vec3 vNormal;
                varying vec3 vView;
                void main() {
                    vec4 place = modelViewMatrix * vec4(position, 1.0);
                    vNormal = normalMatrix * normal;
                    vView = -place.xyz;
                    gl_Position = projectionMatrix * place;
                }`,
            fragmentShader: `
                uniform vec3 colour;
                uniform float clear;
                uniform float dense;
                varying vec3 vNormal;
                varying vec3 vView;
                void main() {
                    float facing = abs(dot(normalize(vNormal), normalize(vView)));
                    float outline = pow(1.0 - facing, 2.6);
                    gl_FragColor = vec4(colour, mix(clear, dense, outline));
                    #include <colorspace_fragment>
                }`,
            side: DoubleSide,
            transparent: true,
            depthWrite: false,
        });
        this.mesh = new Mesh(geometry, material);
        this.mesh.name = "vessel";
        this.mesh.renderOrder = 2;
    }

    /** Frees what the graphics card holds. */
    dispose(): void {
        this.mesh.geometry.dispose();
        (this.mesh.material as ShaderMaterial).dispose();
    }
}

/** The wall of a mesh. Its corners may be in any order, so that normals are turned to agree before they are averaged. */
function fromTriangles(triangles: readonly number[]): BufferGeometry {
    const places: number[] = [];
    const normals: number[] = [];
    const index: number[] = [];
    const known = new Map<string, number>();
    for (let t = 0; t + 8 < triangles.length; t += 9) {
        const corners = [0, 3, 6].map((k) => triangles.slice(t + k, t + k + 3).map((value) => MM * value));
        const [a, b, c] = corners as [number[], number[], number[]];
        const [u, v] = [b.map((value, k) => value - a[k]!), c.map((value, k) => value - a[k]!)];
        const normal = [
            u[1]! * v[2]! - u[2]! * v[1]!,
            u[2]! * v[0]! - u[0]! * v[2]!,
            u[0]! * v[1]! - u[1]! * v[0]!,
        ];
        for (const corner of corners) {
            const key = corner.map((value) => Math.round(1e3 * value)).join();
            let number = known.get(key);
            if (number === undefined) {
                number = known.size;
                known.set(key, number);
                places.push(...corner);
                normals.push(0, 0, 0);
            }
            index.push(number);
            const agreement = normal.reduce((sum, value, k) => sum + value * normals[3 * number + k]!, 0);
            for (let k = 0; k < 3; k++) normals[3 * number + k]! += agreement < 0 ? -normal[k]! : normal[k]!;
        }
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new Float32BufferAttribute(places, 3));
    geometry.setAttribute("normal", new Float32BufferAttribute(normals, 3));
    geometry.setIndex(index);
    geometry.normalizeNormals();
    return geometry;
}
