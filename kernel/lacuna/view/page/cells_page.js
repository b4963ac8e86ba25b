// SPDX-License-Identifier: MIT
"use strict";

// The page of a mesh.

class CellsPage {
    static async make(data, stage, panel) {
        const page = new CellsPage();
        Object.assign(page, { data, stage, panel });
        let total = 0;
        for (const r of data.regions) total += r.nodes.count + (r.middles ? r.middles.nodes.count : 0);
        page.nodes = new Float32Array(3 * total);
        page.regions = [];
        let base = 0,
            first = 0;
        for (const r of data.regions) {
            const cells = await (r.swept ? SweptCells.load(r, data) : ListedCells.load(r));
            await unpackNodes(r.nodes, data, page.nodes, base);
            if (r.middles) await unpackNodes(r.middles.nodes, data, page.nodes, base + r.nodes.count);
            Object.assign(cells, {
                base,
                first,
                mask: new Uint8Array(cells.count),
                height: new Float32Array(cells.count),
                shown: true,
            });
            base += cells.nodeCount;
            first += cells.count;
            page.regions.push(cells);
        }
        page.cellCount = first;
        page.layers = Math.max(1, ...page.regions.map(r => r.layers));
        page.drawing = new Drawing(stage.canvas, page.nodes);
        page.drawing.closed = true;
        page.camera = new Camera(data.radius, stage.canvas.clientWidth / stage.canvas.clientHeight);
        page.sideNodes = new Uint32Array(4 * 4096);
        page.colours = new Uint32Array(4096);
        page.sideCell = new Int32Array(4096);
        page.sidePatch = new Int32Array(4096);
        page.hidden = new Uint8Array(data.patches.length);
        page.cut = { axis: "off", at: 0, flip: false, normal: [0, 0, 1] };
        page.range = [1, page.layers];
        page.picked = -1;
        page.measure();
        page.buildPanel();
        page.recut();
        return page;
    }

    // Compute minimum, mean and histogram of the quality, and find the worst cells, at most one in each
    // column.
    measure() {
        const bins = new Array(20).fill(0),
            worst = [];
        let sum = 0,
            n = 0,
            least = Infinity;
        for (const region of this.regions) {
            for (let c = 0; c < region.count; c++) {
                const value = region.values[c];
                if (value === kNoValue) continue;
                n++;
                sum += value;
                if (value < least) least = value;
                bins[Math.min(19, Math.max(0, Math.floor((value + 10000) / 1000)))]++;
                if (worst.length < 10 || value < worst[9].value) {
                    const column = region.columnOf(c),
                        known = worst.findIndex(w => w.region === region && w.column === column);
                    if (known >= 0 && worst[known].value <= value) continue;
                    if (known >= 0) worst.splice(known, 1);
                    let at = worst.length;
                    while (at > 0 && worst[at - 1].value > value) at--;
                    worst.splice(at, 0, { region, c, column, value });
                    if (worst.length > 10) worst.pop();
                }
            }
        }
        this.quality = { n, least: least / 10000, mean: sum / n / 10000, bins, worst };
        // Lower end of the colour range: the smallest value rounded down to a tenth, at most 0.5.
        this.low = n > 0 ? Math.min(0.5, Math.floor(least / 1000) / 10) : 0;
    }

    // --- the panel --------------------

    buildPanel() {
        const { data, panel, quality } = this;
        panel.append(
            el("h1", { textContent: data.title }),
            el("p", { textContent: data.facts.join(" · ") }),
            el("p", { className: "quiet", textContent: "Lengths are in the unit of the model." }),
        );
        const colours = [
            ["quality", "quality"],
            ["groups", "groups"],
            ["origin", "given / void"],
        ];
        if (this.layers > 1) colours.splice(1, 0, ["layer", "layer"]);
        if (this.regions.length > 1) colours.push(["region", "region"]);
        if (!data.patches.some(p => p.void))
            colours.splice(
                colours.findIndex(c => c[0] === "origin"),
                1,
            );
        if (quality.n === 0) colours.splice(0, 1);
        this.colourBy = colours[0][0];
        this.colourChoice = choice(colours, this.colourBy, value => {
            this.colourBy = value;
            this.paint();
        });
        section(panel, "Colour by").append(this.colourChoice.row);
        this.legend = section(panel, "Legend");
        this.buildCut();
        if (this.layers > 1) this.buildLayers();
        if (quality.n > 0) this.buildQuality();
        if (this.regions.length > 1) this.buildRegions();
        const drawn = section(panel, "Drawing");
        drawn.append(
            row(
                el(
                    "label",
                    {},
                    el("input", {
                        type: "checkbox",
                        checked: true,
                        onchange: event => {
                            this.drawing.edges = event.target.checked ? 0.7 : 0;
                            this.stage.change();
                        },
                    }),
                    " sides of cells",
                ),
            ),
        );
    }

    buildCut() {
        const box = section(this.panel, "Cut");
        const slider = range(0, 1, 0.001, 0.5, value => {
            this.cut.at = value;
            this.setCut();
        });
        const text = el("span", { className: "number" });
        const options = [
            ["off", "off"],
            ["x", "x"],
            ["y", "y"],
            ["z", "z"],
            ["view", "as seen"],
        ];
        const axes = choice(options, "off", value => {
            this.cut.axis = value;
            if (value === "view") this.cut.normal = this.camera.axes[2].slice();
            if (value !== "off" && value !== "view")
                this.cut.normal = [0, 1, 2].map(k => +(k === "xyz".indexOf(value)));
            this.cut.measured = false;
            this.cut.at = 0.5;
            this.setCut();
        });
        const flip = el("input", {
            type: "checkbox",
            onchange: event => {
                this.cut.flip = event.target.checked;
                this.setCut();
            },
        });
        box.append(axes.row, row(slider, text), row(el("label", {}, flip, " the other half")));
        this.cutControls = { axes, slider, flip, text };
    }

    buildLayers() {
        const box = section(this.panel, "Layers");
        const text = el("span", { className: "number" });
        const sliders = [0, 1].map(k =>
            range(1, this.layers, 1, this.range[k], value => {
                this.range[k] = value;
                if (this.range[0] > this.range[1]) this.range[1 - k] = value;
                this.showLayers();
                this.recut();
            }),
        );
        box.append(row("from", sliders[0]), row("to", sliders[1]), text);
        this.layerControls = { sliders, text };
        this.showLayers();
    }
    showLayers() {
        const { sliders, text } = this.layerControls;
        sliders.forEach((slider, k) => {
            slider.value = this.range[k];
        });
        text.textContent = `${this.range[0]} to ${this.range[1]} of ${this.layers}, from the source`;
    }

    buildQuality() {
        const { bins, worst, least, mean, n } = this.quality;
        const box = section(this.panel, "Scaled Jacobian");
        const most = Math.max(...bins),
            from = bins.findIndex(b => b > 0),
            shown = bins.slice(Math.min(from, 10));
        const start = Math.min(from, 10);
        const bin = i => digits((start + i) / 10 - 1);
        box.append(
            el(
                "div",
                { className: "bars" },
                shown.map((b, i) =>
                    el("i", {
                        title: `${bin(i)} to ${bin(i + 1)}: ${things(b, "cell")}`,
                        style: {
                            height: b > 0 ? `max(2px, ${(100 * b) / most}%)` : "0",
                            backgroundColor: css(this.qualityColour((start + i + 0.5) / 10 - 1)),
                        },
                    }),
                ),
            ),
            el(
                "div",
                { className: "ends" },
                el("span", { textContent: digits(start / 10 - 1) }),
                el("span", { textContent: `least ${digits(least)}, mean ${digits(mean)}` }),
                el("span", { textContent: "1" }),
            ),
        );
        if (n < this.cellCount)
            box.append(
                el("p", {
                    className: "quiet",
                    textContent: `${things(this.cellCount - n, "cell")} are of other kinds and not measured.`,
                }),
            );
        const list = section(this.panel, "Worst cells");
        this.worstButtons = worst.map((w, i) => {
            const where = w.region.layers > 1 ? `, layer ${w.region.layerOf(w.c) + 1}` : "";
            const button = el(
                "button",
                { className: "link", onclick: () => this.flyTo(i) },
                `${digits(w.value / 10000)}  cell ${count(this.numberOf(w.region, w.c))}${where}`,
            );
            list.append(button);
            return button;
        });
    }

    buildRegions() {
        const box = section(this.panel, "Regions");
        this.regions.forEach((region, i) =>
            box.append(
                row(
                    el(
                        "label",
                        { className: "row grow" },
                        el("input", {
                            type: "checkbox",
                            checked: true,
                            onchange: event => {
                                region.shown = event.target.checked;
                                this.recut();
                            },
                        }),
                        swatch(this.kindColour(i)),
                        el("span", { className: "grow", textContent: region.name }),
                    ),
                    el("span", { className: "number", textContent: count(region.count) }),
                ),
            ),
        );
    }

    showLegend() {
        const { data } = this,
            box = this.legend;
        const ramp = (colours, low, high, name) =>
            box.replaceChildren(
                el("div", {
                    className: "ramp",
                    style: { background: `linear-gradient(to right, ${colours.map(css).join(", ")})` },
                }),
                el(
                    "div",
                    { className: "ends" },
                    el("span", { textContent: low }),
                    el("span", { textContent: name }),
                    el("span", { textContent: high }),
                ),
            );
        const by = this.colourBy;
        if (by === "quality") return ramp(data.palette.quality, digits(this.low), "1", "scaled Jacobian");
        if (by === "layer") return ramp(data.palette.order, "1", String(this.layers), "layer");
        if (by === "origin") {
            const quads = [0, 0];
            for (const p of data.patches) quads[+p.void] += p.quads;
            return box.replaceChildren(
                row(
                    swatch(data.palette.given),
                    el("span", { className: "grow", textContent: "given" }),
                    el("span", { className: "number", textContent: count(quads[0]) }),
                ),
                row(
                    swatch(data.palette.void, true),
                    el("span", { className: "grow", textContent: "void, closed" }),
                    el("span", { className: "number", textContent: count(quads[1]) }),
                ),
                row(swatch(data.palette.inside), "inside"),
            );
        }
        if (by === "region")
            return box.replaceChildren(el("p", { className: "quiet", textContent: "See Regions." }));
        box.replaceChildren(
            ...data.patches.map((p, i) =>
                row(
                    el(
                        "label",
                        { className: "row grow" },
                        el("input", {
                            type: "checkbox",
                            checked: !this.hidden[i],
                            onchange: event => {
                                this.hidden[i] = +!event.target.checked;
                                this.recut();
                            },
                        }),
                        swatch(this.kindColour(i), p.void),
                        el("span", {
                            className: "grow",
                            textContent: p.groups.join(", ") || `patch ${p.tag}`,
                        }),
                    ),
                    el("span", { className: "number", textContent: count(p.quads) }),
                ),
            ),
        );
    }

    // --- the picture --------------------

    setCut() {
        const { cut, cutControls } = this;
        const off = cut.axis === "off";
        if (!off && !cut.measured) this.measureCut();
        cutControls.slider.disabled = off;
        cutControls.slider.value = cut.at;
        const along = off ? 0 : cut.low + cut.at * (cut.high - cut.low) + dot(cut.normal, this.data.centre);
        cutControls.text.textContent = off ? "" : digits(along);
        this.recut();
    }
    // Heights of all cells along the normal of the cutting plane.
    measureCut() {
        const { cut, nodes } = this,
            [a, b, c] = cut.normal,
            ofNode = new Float32Array(nodes.length / 3);
        for (let n = 0, at = 0; n < ofNode.length; n++, at += 3)
            ofNode[n] = a * nodes[at] + b * nodes[at + 1] + c * nodes[at + 2];
        cut.low = Infinity;
        cut.high = -Infinity;
        for (const region of this.regions) {
            region.heights(ofNode, region.height);
            for (const h of region.height) {
                if (h < cut.low) cut.low = h;
                if (h > cut.high) cut.high = h;
            }
        }
        cut.measured = true;
    }

    // Find the cells that are in the visible layers with their centre on the visible side, and the sides to
    // draw.
    recut() {
        const { cut, regions, hidden } = this;
        const level = cut.axis === "off" ? 0 : cut.low + cut.at * (cut.high - cut.low);
        const slack = cut.axis === "off" ? 0 : 1e-6 * (cut.high - cut.low);
        let n = 0;
        this.kept = 0;
        const add = (region, cell, patch, i, j, k, l, flags) => {
            if (n === this.sideCell.length) this.grow();
            const { sideNodes } = this;
            sideNodes[4 * n] = i;
            sideNodes[4 * n + 1] = j;
            sideNodes[4 * n + 2] = k;
            sideNodes[4 * n + 3] = l;
            this.colours[n] = flags << 24;
            this.sideCell[n] = region.first + cell;
            this.sidePatch[n++] = patch;
        };
        regions.forEach((region, r) => {
            const mask = region.mask,
                perLayer = region.layers ? region.quadCount : region.count;
            const low = region.layers ? (this.range[0] - 1) * perLayer : 0;
            const high = region.layers ? Math.min(this.range[1] * perLayer, region.count) : region.count;
            mask.fill(0);
            if (!region.shown) return;
            if (cut.axis === "off") mask.fill(1, low, high);
            else if (cut.flip)
                for (let c = low; c < high; c++) mask[c] = +(region.height[c] >= level - slack);
            else for (let c = low; c < high; c++) mask[c] = +(region.height[c] <= level + slack);
            for (let c = low; c < high; c++) this.kept += mask[c];
            const out = new Int32Array(8),
                middle = new Int32Array(12);
            region.exposed(mask, (c, face, skin) => {
                const patch = skin ? region.patchOf(c, face) : -1;
                if (patch >= 0 && hidden[patch]) return;
                region.corners(c, out);
                const curved = region.middleNodes(c, middle);
                const [i, j, k, l] = kFaces[face],
                    seen = skin ? patch : -2,
                    plain = out[i] !== out[j] && out[j] !== out[k] && out[k] !== out[l] && out[l] !== out[i];
                if (plain && !curved) return add(region, c, seen, out[i], out[j], out[k], out[l], 0);
                for (const [nodes, flags] of sidesOf(out, face, curved ? middle : null))
                    add(region, c, seen, ...nodes, flags);
            });
        });
        this.sideCount = n;
        this.drawing.hover = -1;
        this.drawing.putSides(this.sideNodes, n);
        this.paint();
    }
    grow() {
        for (const name of ["sideNodes", "colours", "sideCell", "sidePatch"]) {
            const larger = new this[name].constructor(2 * this[name].length);
            larger.set(this[name]);
            this[name] = larger;
        }
    }

    regionOf(cell) {
        let r = this.regions.length - 1;
        while (this.regions[r].first > cell) r--;
        return r;
    }
    numberOf(region, c) {
        return region.tags ? region.tags[c] : region.first + c + 1;
    }
    kindColour(i) {
        const kinds = this.data.palette.kinds;
        return kinds[i % kinds.length];
    }
    qualityColour(value) {
        return onRamp(this.data.palette.quality, (value - this.low) / (1 - this.low));
    }

    // Colours of the visible sides.
    paint() {
        const { data, colours, sideCell, sidePatch } = this,
            by = this.colourBy,
            inside = word(data.palette.inside);
        const quality = Array.from({ length: 256 }, (_, i) => word(onRamp(data.palette.quality, i / 255)));
        const order = Array.from({ length: this.layers }, (_, i) =>
            word(onRamp(data.palette.order, this.layers > 1 ? i / (this.layers - 1) : 0)),
        );
        const patches = data.patches.map((p, i) =>
            word(
                by === "origin" ? (p.void ? data.palette.void : data.palette.given) : this.kindColour(i),
                p.void ? kHatched : 0,
            ),
        );
        const perUnit = 255 / (1 - this.low) / 10000,
            low = this.low * 10000;
        let r = 0;
        for (let s = 0; s < this.sideCount; s++) {
            while (r + 1 < this.regions.length && sideCell[s] >= this.regions[r + 1].first) r++;
            const region = this.regions[r],
                c = sideCell[s] - region.first,
                patch = sidePatch[s];
            let colour;
            if (by === "quality") {
                const value = region.values[c];
                colour =
                    value === kNoValue
                        ? inside
                        : quality[Math.min(255, Math.max(0, Math.round((value - low) * perUnit)))];
            } else if (by === "layer") {
                colour = order[region.layerOf(c)];
            } else if (by === "region") {
                colour = word(this.kindColour(r));
            } else {
                colour = patch >= 0 ? patches[patch] : inside;
            }
            colours[s] = ((colours[s] & 0x0f000000) | colour) >>> 0;
        }
        this.drawing.putColours(colours);
        this.showLegend();
        this.stage.change(true);
    }

    // --- one cell --------------------

    centreOf(region, c) {
        const corners = new Int32Array(8),
            sum = [0, 0, 0];
        region.corners(c, corners);
        for (const n of corners) for (let k = 0; k < 3; k++) sum[k] += this.nodes[3 * n + k] / 8;
        return sum;
    }
    mark(region, c) {
        const corners = new Int32Array(8),
            middle = new Int32Array(12),
            lines = [],
            colour = word([200, 0, 90], 10);
        region.corners(c, corners);
        const curved = region.middleNodes(c, middle);
        kSides.forEach(([a, b], k) => {
            if (corners[a] === corners[b]) return;
            if (curved) lines.push(corners[a], middle[k], colour, middle[k], corners[b], colour);
            else lines.push(corners[a], corners[b], colour);
        });
        this.drawing.putLines(lines, true);
    }
    // Cut just beyond a cell, turn the camera to it and zoom in.
    flyTo(i) {
        const { region, c } = this.quality.worst[i],
            centre = this.centreOf(region, c);
        this.worstButtons.forEach((button, k) => button.classList.toggle("on", k === i));
        this.range = [1, this.layers];
        if (this.layerControls) this.showLayers();
        if (this.cut.axis === "off")
            ((this.cut.axis = "z"), (this.cut.normal = [0, 0, 1]), (this.cut.measured = false));
        this.cutControls.axes.set(this.cut.axis, true);
        if (!this.cut.measured) this.measureCut();
        this.cut.at = (region.height[c] - this.cut.low) / Math.max(this.cut.high - this.cut.low, 1e-30);
        this.setCut();
        this.mark(region, c);
        const corners = new Int32Array(8);
        region.corners(c, corners);
        let size = 0;
        for (const n of corners)
            size = Math.max(size, Math.hypot(...[0, 1, 2].map(k => this.nodes[3 * n + k] - centre[k])));
        const out = times(this.cut.normal, this.cut.flip ? -1 : 1);
        const aside = Math.abs(out[2]) > 0.9 ? [0.35, -0.55, 0] : [0.25, -0.2, 0.45];
        this.stage.flyTo(centre, 7 * size, plus(out, aside));
    }

    over(x, y) {
        const side = x < 0 ? -1 : this.drawing.pick(this.camera, x, y);
        this.drawing.hover = side;
        if (side < 0) return null;
        const region = this.regions[this.regionOf(this.sideCell[side])],
            c = this.sideCell[side] - region.first;
        const patch = this.sidePatch[side],
            value = region.values[c];
        return [
            `cell ${count(this.numberOf(region, c))}${this.regions.length > 1 ? " of " + region.name : ""}`,
            region.layers > 1 ? `layer ${region.layerOf(c) + 1} of ${region.layers}` : "",
            value === kNoValue ? "" : `scaled Jacobian ${digits(value / 10000)}`,
            patch >= 0
                ? this.data.patches[patch].groups.join(", ") +
                  (this.data.patches[patch].void ? " (void, closed)" : "")
                : patch === -2
                  ? "inside"
                  : "skin",
            `centre ${place(plus(this.centreOf(region, c), this.data.centre))}`,
        ];
    }
    click() {
        return false;
    }
    moved() {}
}

// The quads and triangles that draw a face of a cell, with flags for edges that are not edges of the cell.
function sidesOf(corners, face, middle) {
    const four = kFaces[face].map(k => corners[k]),
        edges = kFaceSides[face];
    const kept = [0, 1, 2, 3].filter(k => four[k] !== four[(k + 1) % 4]);
    if (kept.length < 3) return [];
    if (middle) {
        const between = edges.map(e => middle[e]);
        return [
            [[...kept.map(k => between[k]), ...(kept.length === 3 ? [between[kept[2]]] : [])], 15],
            ...kept.map((k, i) => [
                [between[kept[(i + kept.length - 1) % kept.length]], four[k], between[k], between[k]],
                8,
            ]),
        ];
    }
    // Keep corner k if the side from it to the next has a length.
    const nodes = kept.map(k => four[k]);
    if (nodes.length === 3) nodes.push(nodes[2]);
    return [[nodes, 0]];
}
