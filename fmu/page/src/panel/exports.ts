/** Files of what is seen and open: picture, shape and scene. */

import type { View } from "../view/view";
import type { Banners } from "./banners";
import { save } from "./download";
import { element } from "./element";
import type { Editor } from "./editor";

/** Connects the buttons. */
export function offerExports(view: View, editor: Editor, banners: Banners): void {
    const offer = (id: string, name: string, make: () => Promise<Blob> | string) => {
        element(id, HTMLButtonElement).addEventListener("click", () => {
            void (async () => {
                try {
                    save(name, await make());
                } catch (error) {
                    banners.show("notice", `${name} could not be made: ${String(error)}`);
                }
            })();
        });
    };
    offer("save-picture", "mcm.png", () => view.picture());
    offer("save-shape", "mcm.glb", () => view.gltf());
    offer("save-scene", "scene.toml", () => editor.text);
}
