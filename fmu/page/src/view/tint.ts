import { Color, MeshStandardMaterial, type MeshStandardMaterialParameters } from "three";

/** Time in which the device takes on another tint, ms: shorter changes would flicker while levels alternate. */
const FADING = 120;

/**
 * How much the device is paled, because its shape is not final, and greyed, because it has none at these inputs. One tint is shared
 * by all materials of the device, as numbers that their shaders read.
 */
export class Tint {
    private readonly pale = { value: 0 };
    private readonly grey = { value: 0 };
    private readonly towards = { value: new Color() };
    private target = { pale: 0, grey: 0 };
    private last = 0;

    /** Says how the device is to look. */
    aim(final: boolean, solved: boolean): void {
        this.target = { pale: final ? 0 : 0.14, grey: solved ? 0 : 1 };
    }

    /** The colour of what is pale. */
    setPale(colour: Color): void {
        this.towards.value.copy(colour);
    }

    /** Comes nearer to the look aimed at; false when it is there. */
    ease(now: number): boolean {
        const part = 1 - Math.exp(-Math.min(100, Math.max(1, now - this.last)) / FADING);
        this.last = now;
        let moving = false;
        for (const [value, target] of [
            [this.pale, this.target.pale],
            [this.grey, this.target.grey],
        ] as const) {
            const rest = target - value.value;
            if (Math.abs(rest) < 0.01) value.value = target;
            else {
                value.value += part * rest;
                moving = true;
            }
        }
        return moving;
    }

    /** A material with colours at the vertices, this tint, and the attribute `glow` of a sweep. */
    material(parameters: MeshStandardMaterialParameters): MeshStandardMaterial {
        const material = new MeshStandardMaterial({ vertexColors: true, ...parameters });
        material.onBeforeCompile = (shader) => {
            Object.assign(shader.uniforms, { pale: this.pale, grey: this.grey, towards: this.towards });
            shader.vertexShader = shader.vertexShader
                .replace(
                    "#include <common>",
                    "#include <common>\nattribute float glow;\nvarying float vGlow;",
                )
                .replace("#include <begin_vertex>", "#include <begin_vertex>\nvGlow = glow;");
            shader.fragmentShader = shader.fragmentShader
                .replace(
                    "#include <common>",
                    "#include <common>\nuniform float pale;\nuniform float grey;\nuniform vec3 towards;\nvarying float vGlow;",
                )
                .replace(
                    "#include <color_fragment>",
                    `#include <color_fragment>
                    float lightness = dot(diffuseColor.rgb, vec3(0.2126, 0.7152, 0.0722));
                    diffuseColor.rgb = mix(diffuseColor.rgb, vec3(0.15 + 0.5 * lightness), 0.9 * grey);
                    diffuseColor.rgb = mix(diffuseColor.rgb, towards, pale);`,
                )
                .replace(
                    "#include <emissivemap_fragment>",
                    "#include <emissivemap_fragment>\ntotalEmissiveRadiance += vGlow * (1.0 - grey) * diffuseColor.rgb;",
                );
        };
        return material;
    }
}
