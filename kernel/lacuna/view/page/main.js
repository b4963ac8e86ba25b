// SPDX-License-Identifier: MIT
"use strict";

async function start() {
    const data = JSON.parse(document.getElementById("data").textContent);
    document.title = data.title;
    const box = document.getElementById("stage"),
        canvas = el("canvas"),
        tip = el("div", { id: "tip" });
    const scale = el("div", { id: "scale" });
    box.append(
        canvas,
        scale,
        tip,
        el("div", {
            id: "hint",
            textContent:
                "drag: turn · shift or right drag: move · wheel: zoom · x y z i: look along · f: all",
        }),
    );
    let asked = false,
        page = null,
        pointer = null;
    const stage = {
        box,
        canvas,
        // Draw once before the next frame, however often it is asked.
        change() {
            if (asked || !page) return;
            asked = true;
            requestAnimationFrame(() => {
                asked = false;
                if (pointer) {
                    const at = pointer;
                    pointer = null;
                    showTip(tip, page.over(...at), ...at);
                }
                page.drawing.render(page.camera);
                page.moved();
                showScale(scale, page.camera, canvas.clientHeight);
            });
        },
        flyTo(centre, size, from) {
            const camera = page.camera,
                start = performance.now();
            const old = { centre: camera.centre, scale: camera.scale, back: camera.axes[2] },
                back = unit(from);
            const step = now => {
                const t = Math.min((now - start) / 450, 1),
                    s = t * t * (3 - 2 * t);
                camera.look(plus(times(old.back, 1 - s), times(back, s)));
                camera.centre = plus(times(old.centre, 1 - s), times(centre, s));
                camera.scale = old.scale * (size / old.scale) ** s;
                stage.change();
                stage.flying = t < 1;
                if (stage.flying) requestAnimationFrame(step);
            };
            stage.flying = true;
            requestAnimationFrame(step);
        },
    };
    const kind = data.kind === "cells" ? CellsPage : FacesPage;
    page = await kind.make(data, stage, document.getElementById("panel"));
    handle(canvas, page.camera, {
        change: () => {
            showTip(tip, null);
            stage.change();
        },
        over: (x, y) => {
            pointer = [x, y];
            stage.change();
        },
        click: (x, y) => page.click(x, y),
    });
    new ResizeObserver(() => stage.change()).observe(canvas);
    stage.change();
    window.lacunaPage = page; // for the console, and for tests
}

start().catch(error => {
    document.body.replaceChildren(el("p", { id: "failed", textContent: String(error.message || error) }));
    console.error(error);
});
