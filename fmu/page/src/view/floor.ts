import { type Box3, Color, DoubleSide, Mesh, PlaneGeometry, ShaderMaterial } from "three";

/** A grid beneath everything, lines at each 10 mm and stronger ones at each 50 mm, which fades with the distance. */
export class Floor {
    readonly mesh: Mesh<PlaneGeometry, ShaderMaterial>;

    constructor() {
        const material = new ShaderMaterial({
            uniforms: { colour: { value: new Color() }, radius: { value: 200 } },
            vertexShader: `
                varying vec2 vPlace;
                varying vec2 vOff;
                void main() {
                    vec4 place = modelMatrix * vec4(position, 1.0);
                    vPlace = place.xz;
                    vOff = position.xz;
                    gl_Position = projectionMatrix * viewMatrix * place;
                }`,
            fragmentShader: `
                uniform vec3 colour;
                varying vec2 vPlace;
                varying vec2 vOff;
                float lines(float distance) {
                    vec2 at = vPlace / distance;
                    vec2 width = fwidth(at);
                    vec2 near = abs(fract(at - 0.5) - 0.5) / width;
                    // Where lines are closer than a few pixels they would only shimmer.
                    float seen = 1.0 - smoothstep(0.1, 0.5, max(width.x, width.y));
                    return seen * (1.0 - min(min(near.x, near.y), 1.0));
                }
                void main() {
                    float fade = 1.0 - smoothstep(0.35, 1.0, 2.0 * length(vOff));
                    float alpha = fade * max(0.17 * lines(10.0), 0.4 * lines(50.0));
                    if (alpha < 0.004) discard;
                    gl_FragColor = vec4(colour, alpha);
                    #include <colorspace_fragment>
                }`,
            transparent: true,
            depthWrite: false,
            side: DoubleSide,
        });
        this.mesh = new Mesh(new PlaneGeometry(1, 1).rotateX(-Math.PI / 2), material);
        this.mesh.name = "floor";
        this.mesh.renderOrder = -1;
    }

    /** Lays it beneath a box. */
    lay(box: Box3): void {
        const { min, max } = box;
        const size = 2.4 * Math.max(max.x - min.x, max.z - min.z, 0.6 * (max.y - min.y));
        this.mesh.position.set((min.x + max.x) / 2, min.y - 0.04 * size, (min.z + max.z) / 2);
        this.mesh.scale.set(size, 1, size);
    }

    setColour(colour: string): void {
        this.mesh.material.uniforms["colour"]!.value.set(colour);
    }
}
