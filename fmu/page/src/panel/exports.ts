/** Files of what is seen and open: picture, shape and scene. */

import type { View } from "../view/view";
import type { Banners } from "./banners";
import { save } from "./download";
import { element } from "./element";
import type { Editor } from "./editor";
import type { Keeping } from "./keeping";
import type { Session } from "./session";

/** Connects the buttons. */
export function offerExports(
    view: View,
    {
        session,
        editor,
        keeping,
        banners,
    }: { session: Session; editor: Editor; keeping: Keeping; banners: Banners },
): void {
    // A text that is not applied, and a scene of which nothing has moved, are saved as they are written.
    const moved = () => editor.text === session.scene && keeping.moved;
    const offer = (id: string, name: string, make: () => Promise<Blob | string>) => {
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
    offer("save-scene", "scene.toml", async () => {
        const kept = moved() ? await keeping.kept() : null;
        if (kept !== null && kept.remark !== "") {
            banners.show("notice", kept.remark);
        }
        return kept?.scene ?? editor.text;
    });
}
