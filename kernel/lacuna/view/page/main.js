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
    // If finding the side under the pointer takes longer than this (large mesh, no graphics card), do it only
    // when the pointer rests.
    const slow = 25; // [ms]
    let asked = false,
        moving = false,
        settling = 0,
        page = null,
        took = 0,
        resting = 0;
    const stage = {
        box,
        canvas,
        // Draw once before the next frame, however often drawing is requested. When nothing moves, draw the
        // complete picture.
        change(moves = false) {
            moving ||= moves;
            if (asked || !page) return;
            asked = true;
            requestAnimationFrame(() => {
                clearTimeout(settling);
                const whole = page.drawing.render(page.camera, moving);
                asked = moving = false;
                page.moved(whole);
                showScale(scale, page.camera, canvas.clientHeight);
                if (!whole) settling = setTimeout(() => stage.change(), 150);
            });
        },
        flyTo(centre, size, from) {
            const camera = page.camera,
                start = performance.now();
            const old = { centre: camera.centre, scale: camera.scale, back: camera.axes[2] },
                back = unit(from);
            const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
            const step = now => {
                const t = still ? 1 : Math.min((now - start) / 450, 1),
                    s = t * t * (3 - 2 * t);
                camera.look(plus(times(old.back, 1 - s), times(back, s)));
                camera.centre = plus(times(old.centre, 1 - s), times(centre, s));
                camera.scale = old.scale * (size / old.scale) ** s;
                stage.change(true);
                stage.flying = t < 1;
                if (stage.flying) requestAnimationFrame(step);
            };
            stage.flying = true;
            if (still) step(start);
            else requestAnimationFrame(step);
        },
    };
    function over(x, y) {
        const start = performance.now(),
            before = page.drawing.hover;
        showTip(tip, page.over(x, y), x, y);
        took = performance.now() - start;
        if (page.drawing.hover !== before && !page.drawing.liftSide(page.camera, before)) stage.change();
    }
    const kind = data.kind === "cells" ? CellsPage : FacesPage;
    page = await kind.make(data, stage, document.getElementById("panel"));
    handle(canvas, page.camera, {
        change: () => {
            clearTimeout(resting);
            showTip(tip, null);
            stage.change(true);
        },
        over: (x, y) => {
            clearTimeout(resting);
            if (took > slow) showTip(tip, null);
            resting = setTimeout(() => over(x, y), took > slow ? 200 : 0);
        },
        click: (x, y) => page.click(x, y),
    });
    new ResizeObserver(() => stage.change()).observe(canvas);
    stage.change();
    window.lacunaPage = page; // for the console and for tests
}

start().catch(error => {
    document.body.replaceChildren(el("p", { id: "failed", textContent: String(error.message || error) }));
    console.error(error);
});
