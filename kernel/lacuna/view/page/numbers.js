// SPDX-License-Identifier: MIT
"use strict";

// Decodes the numbers of the page: deflated varints in base 64, as packed by
// kernel/lacuna/view/detail/base64.h.
async function inflate(text) {
    const letters = atob(text),
        bytes = new Uint8Array(letters.length);
    for (let i = 0; i < bytes.length; i++) bytes[i] = letters.charCodeAt(i);
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

async function unpack(text, count, stride, linear) {
    const bytes = await inflate(text),
        numbers = new Int32Array(count);
    for (let i = 0, at = 0; i < count; i++) {
        let code = 0,
            factor = 1,
            byte;
        do {
            byte = bytes[at++];
            code += (byte & 127) * factor;
            factor *= 128;
        } while (byte > 127);
        const missed = code % 2 ? -(code + 1) / 2 : code / 2;
        const expected =
            linear && i >= 2 * stride
                ? 2 * numbers[i - stride] - numbers[i - 2 * stride]
                : i >= stride
                  ? numbers[i - stride]
                  : i > 0
                    ? numbers[i - 1]
                    : 0;
        numbers[i] = expected + missed;
    }
    return numbers;
}

// Coordinates of nodes relative to the centre of the object, into `out` from node `base` on.
async function unpackNodes(packed, data, out, base) {
    for (let k = 0; k < 3; k++) {
        const whole = await unpack(packed.axes[k], packed.count, packed.stride, true);
        const shift = data.low[k] - data.centre[k];
        for (let i = 0; i < packed.count; i++) out[3 * (base + i) + k] = whole[i] * data.step + shift;
    }
}

// --- vectors --------------------

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const times = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const plus = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const unit = a => {
    const n = Math.hypot(...a);
    return n > 0 ? times(a, 1 / n) : [0, 0, 1];
};

// A number with few digits, for reading.
function digits(x, n = 4) {
    if (x === null || !isFinite(x)) return "–";
    if (x === 0 || Math.abs(x) < 1e-12) return "0";
    const size = Math.abs(x);
    return size >= 1e6 || size < 1e-4 ? x.toExponential(n - 1) : String(Number(x.toPrecision(n)));
}
const place = p => "(" + p.map(x => digits(x)).join(", ") + ")";
const count = n => n.toLocaleString("en").replace(/,/g, "\u202f");
const things = (n, one, many = one + "s") => count(n) + " " + (n === 1 ? one : many);

// --- colours --------------------

// Red, green and blue as one word, as drawing expects it; flags are in the highest byte.
const word = (colour, flags = 0) => (colour[0] | (colour[1] << 8) | (colour[2] << 16) | (flags << 24)) >>> 0;
const css = colour => `rgb(${colour[0]}, ${colour[1]}, ${colour[2]})`;
function onRamp(ramp, at) {
    const x = Math.min(Math.max(at, 0), 1) * (ramp.length - 1),
        low = Math.min(Math.floor(x), ramp.length - 2);
    return ramp[low].map((c, k) => Math.round(c * (1 - x + low) + ramp[low + 1][k] * (x - low)));
}
