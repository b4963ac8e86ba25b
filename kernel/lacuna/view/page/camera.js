// SPDX-License-Identifier: MIT
"use strict";

// A camera with parallel projection, so that lengths can be compared; rotates, pans and zooms.
class Camera {
    constructor(radius, aspect) {
        this.radius = radius; // radius of the object
        this.centre = [0, 0, 0];
        this.look([1, -1.6, 0.9]);
        this.fit(aspect);
    }

    // Look from `direction` at the centre, with z upwards if possible.
    look(direction) {
        const back = unit(direction);
        const up = Math.abs(back[2]) > 0.98 ? [0, 1, 0] : [0, 0, 1];
        const right = unit(cross(up, back));
        this.axes = [right, cross(back, right), back];
    }
    fit(aspect) {
        this.centre = [0, 0, 0];
        this.scale = (1.04 * this.radius) / Math.min(1, aspect); // half the height of the window
    }
    turn(dx, dy) {
        const [right, up] = this.axes;
        for (const [axis, angle] of [
            [up, -dx],
            [right, -dy],
        ]) {
            const c = Math.cos(angle),
                s = Math.sin(angle);
            this.axes = this.axes.map(v =>
                plus(plus(times(v, c), times(cross(axis, v), s)), times(axis, dot(axis, v) * (1 - c))),
            );
        }
        const back = unit(this.axes[2]),
            across = unit(cross(this.axes[1], back));
        this.axes = [across, cross(back, across), back];
    }
    // Pan by fractions of half the window's height.
    move(dx, dy) {
        const [right, up] = this.axes;
        this.centre = plus(this.centre, plus(times(right, -dx * this.scale), times(up, -dy * this.scale)));
    }
    // Zoom about a point of the window, given in fractions of half its height from the centre.
    zoom(factor, x, y) {
        const scale = Math.min(Math.max(this.scale * factor, this.radius * 1e-5), this.radius * 20);
        const left = this.scale - scale;
        this.scale = scale;
        this.centre = plus(this.centre, plus(times(this.axes[0], x * left), times(this.axes[1], y * left)));
    }
    turnMatrix() {
        const [r, u, b] = this.axes;
        return [r[0], u[0], b[0], r[1], u[1], b[1], r[2], u[2], b[2]];
    }
    matrix(aspect) {
        const [r, u, b] = this.axes,
            s = 1 / this.scale,
            depth = -1 / (4 * this.radius + this.scale);
        const rows = [times(r, s / aspect), times(u, s), times(b, depth)];
        const t = rows.map(row => -dot(row, this.centre));
        return [
            rows[0][0],
            rows[1][0],
            rows[2][0],
            0,
            rows[0][1],
            rows[1][1],
            rows[2][1],
            0,
            rows[0][2],
            rows[1][2],
            rows[2][2],
            0,
            t[0],
            t[1],
            t[2],
            1,
        ];
    }
    // Pixel coordinates of a point in a window of `width` × `height`.
    project(at, width, height) {
        const v = plus(at, times(this.centre, -1)),
            s = height / 2 / this.scale;
        return [width / 2 + dot(this.axes[0], v) * s, height / 2 - dot(this.axes[1], v) * s];
    }
}

// Handles mouse, touch pad and keys. Calls `on.change` after every change, `on.click(x, y)`, `on.over(x, y)`.
function handle(canvas, camera, on) {
    let last = null,
        moved = 0,
        mode = "turn";
    canvas.tabIndex = 0;
    canvas.addEventListener("contextmenu", event => event.preventDefault());
    canvas.addEventListener("pointerdown", event => {
        last = [event.clientX, event.clientY];
        moved = 0;
        mode = event.button !== 0 || event.shiftKey ? "move" : "turn";
        if (event.isTrusted) canvas.setPointerCapture(event.pointerId); // scripted events have no pointer
    });
    canvas.addEventListener("pointermove", event => {
        if (!last) return on.over(event.clientX, event.clientY);
        const dx = event.clientX - last[0],
            dy = event.clientY - last[1];
        moved += Math.abs(dx) + Math.abs(dy);
        if (moved < 4) return;
        last = [event.clientX, event.clientY];
        const half = canvas.clientHeight / 2;
        if (mode === "turn") camera.turn((dx / half) * 1.6, (dy / half) * 1.6);
        else camera.move(dx / half, -dy / half);
        on.change();
    });
    canvas.addEventListener("pointerup", event => {
        if (last && moved < 4 && event.button === 0) on.click(event.clientX, event.clientY);
        last = null;
    });
    canvas.addEventListener("pointerleave", () => on.over(-1, -1));
    canvas.addEventListener(
        "wheel",
        event => {
            event.preventDefault();
            const box = canvas.getBoundingClientRect(),
                half = box.height / 2;
            camera.zoom(
                Math.exp(event.deltaY * 0.0015),
                (event.clientX - box.left - box.width / 2) / half,
                (box.top + half - event.clientY) / half,
            );
            on.change();
        },
        { passive: false },
    );
    window.addEventListener("keydown", event => {
        if (/^(INPUT|TEXTAREA|SELECT)$/.test(event.target.tagName) || event.ctrlKey || event.metaKey) return;
        const looks = {
            x: [1, 0, 0],
            y: [0, -1, 0],
            z: [0, 0, 1],
            X: [-1, 0, 0],
            Y: [0, 1, 0],
            Z: [0, 0, -1],
            i: [1, -1.6, 0.9],
        };
        if (event.key in looks) camera.look(looks[event.key]);
        else if (event.key === "f") camera.fit(canvas.clientWidth / canvas.clientHeight);
        else return;
        on.change();
    });
}
