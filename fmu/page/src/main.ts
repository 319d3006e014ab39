/** The page: connects the core in its worker with picture, panel, plots and tape. */

import { Address } from "./panel/address";
import { Banners } from "./panel/banners";
import { Controls } from "./panel/controls";
import { Editor } from "./panel/editor";
import { element } from "./panel/element";
import { offerExports } from "./panel/exports";
import { inspectionOf } from "./panel/inspection";
import { Keeping } from "./panel/keeping";
import { listenToKeys } from "./panel/keys";
import type { Linked } from "./panel/link";
import { inputsOf, MagnetTurns, poseOf } from "./panel/magnet";
import { Readout } from "./panel/readout";
import { Scenes } from "./panel/scenes";
import { Session } from "./panel/session";
import { Sheet } from "./panel/sheet";
import { missing, stop } from "./panel/support";
import { Appearance } from "./panel/theme";
import { textOf } from "./panel/trail";
import { Toolbar } from "./panel/toolbar";
import { Warnings } from "./panel/warnings";
import { Plots } from "./plots/plots";
import { Solver } from "./solver";
import { Deck } from "./tape/deck";
import { View } from "./view/view";

function begin(): void {
    const solver = new Solver((reply) => session.receive(reply));
    const session = new Session((request) => solver.send(request));
    const view = new View(element("view", HTMLElement), {
        moved: (pose) => session.set(inputsOf(pose), "view"),
        dragging: (on) => document.body.toggleAttribute("data-dragging", on),
    });
    window.mcm = inspectionOf(session, view);

    const banners = new Banners();
    const editor = new Editor(session);
    new Sheet();
    new Controls(session);
    new MagnetTurns(session);
    new Readout(session);
    const plots = new Plots(session);
    new Warnings(session, banners, plots.seconds);
    const scenes = new Scenes(session, editor, (why) => banners.show("notice", why));
    new Deck(session, banners, () => scenes.preset);
    const keeping = new Keeping(session);
    offerExports(view, { session, editor, keeping, banners });

    // The page is connected from here on, so that a change of any part can be written to the address.
    const toolbar = new Toolbar(view, () => address.later());
    const appearance = new Appearance((dark) => {
        view.setDark(dark);
        plots.recolour();
    });
    const state = (): Linked | null =>
        session.description === null
            ? null
            : {
                  scene: session.scene,
                  inputs: session.moved(),
                  way: keeping.rows(),
                  overlays: toolbar.overlays,
                  theme: appearance.chosen,
              };
    const tried = async () => {
        const kept = await keeping.kept();
        const linked = state();
        return kept === null || linked === null
            ? null
            : { linked: { ...linked, way: kept.rows }, remark: kept.remark };
    };
    const open = (linked: Linked | null) => {
        if (linked === null) {
            scenes.openFirst();
            return;
        }
        appearance.choose(linked.theme);
        toolbar.show(linked.overlays);
        editor.open(linked.scene + textOf(linked.way), linked.inputs);
    };
    const address = new Address(state, tried, open, banners);
    element("theme", HTMLButtonElement).addEventListener("click", () => address.later());

    const help = element("help", HTMLDialogElement);
    element("help-open", HTMLButtonElement).addEventListener("click", () => help.showModal());
    listenToKeys(session, {
        gizmo: (mode) => toolbar.gizmo(mode),
        frame: () => view.frame(),
        help: () => help.showModal(),
    });

    let unframed = false;
    session.listen({
        opened: (description) => {
            unframed = true;
            view.open(description);
        },
        changed: (origin) => {
            if (origin !== "view") {
                view.setMagnet(poseOf(session), session.input("magnet.strength"));
            }
        },
        answered: (answer) => {
            if (!answer.behind) {
                view.show(answer);
            }
            if (unframed) {
                // The first shape may be far from the straight one that a new scene is framed for.
                unframed = false;
                requestAnimationFrame(() => view.frame());
            }
            if (!session.busy) {
                address.later();
            }
        },
        refused: (faults) => {
            if (session.description === null) {
                banners.show(
                    "notice",
                    `This scene is not read, the first one was opened. ${faults.join(" ")}`,
                );
                open(null);
            }
        },
        broken: (message) => stop("The core has failed.", [message], true),
    });
    void address.read();
}

const lacks = missing();
if (lacks.length > 0) {
    stop("This browser lacks what the page needs:", lacks, false);
} else {
    try {
        begin();
    } catch (error) {
        stop("The page could not start.", [String(error)], true);
    }
}
