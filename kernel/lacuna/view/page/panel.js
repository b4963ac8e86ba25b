// SPDX-License-Identifier: MIT
"use strict";

// The panel next to the picture. Texts of the input become text nodes, never markup.

function el(name, properties = {}, ...inside) {
    const element = document.createElement(name);
    for (const [key, value] of Object.entries(properties)) {
        if (key === "style") Object.assign(element.style, value);
        else if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
        else element[key] = value;
    }
    for (const child of inside.flat()) if (child !== null) element.append(child);
    return element;
}

const row = (...inside) => el("div", { className: "row" }, ...inside);
const swatch = (colour, hatched) =>
    el("span", { className: "swatch" + (hatched ? " void" : ""), style: { backgroundColor: css(colour) } });

function section(panel, title) {
    const box = el("div");
    panel.append(el("h2", { textContent: title }), box);
    return box;
}

// A row of buttons, one of which is active.
function choice(options, chosen, onchange) {
    const buttons = options.map(([value, text]) =>
        el("button", { textContent: text, onclick: () => set(value) }),
    );
    function set(value, quiet) {
        options.forEach(([own], i) => buttons[i].classList.toggle("on", own === value));
        if (!quiet) onchange(value);
    }
    set(chosen, true);
    return { row: row(...buttons), set };
}

function range(min, max, step, value, oninput) {
    return el("input", {
        type: "range",
        min,
        max,
        step,
        value,
        oninput: event => oninput(Number(event.target.value)),
    });
}

// A scale: a bar of a round length.
function showScale(box, camera, height) {
    const pixels = height / 2 / camera.scale,
        ideal = 110 / pixels;
    const ten = 10 ** Math.floor(Math.log10(ideal));
    const length = ten * (ideal / ten >= 5 ? 5 : ideal / ten >= 2 ? 2 : 1);
    box.replaceChildren(digits(length), el("i", { style: { width: `${length * pixels}px` } }));
    box.title = "in the unit of the model's lengths";
}

function showTip(tip, lines, x, y) {
    tip.style.display = lines ? "block" : "none";
    if (!lines) return;
    tip.textContent = lines.filter(line => line).join("\n");
    const stage = tip.parentElement.getBoundingClientRect();
    tip.style.left = `${Math.min(x - stage.left + 14, stage.width - tip.offsetWidth - 6)}px`;
    tip.style.top = `${Math.min(y - stage.top + 14, stage.height - tip.offsetHeight - 6)}px`;
}
