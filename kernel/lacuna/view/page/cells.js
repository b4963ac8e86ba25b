// SPDX-License-Identifier: MIT
"use strict";

// The cells of a mesh. After a cut and a selection of layers, the remaining cells are drawn whole.

// Corners of the faces of a hexahedron and, for each face, its edges, as in mesh/second_order.h. Other cells
// are hexahedra with repeated corners.
const kFaces = [
    [0, 4, 7, 3],
    [1, 2, 6, 5],
    [0, 1, 5, 4],
    [3, 7, 6, 2],
    [0, 3, 2, 1],
    [4, 5, 6, 7],
];
const kFaceSides = [
    [8, 7, 11, 3],
    [1, 10, 5, 9],
    [0, 9, 4, 8],
    [11, 6, 10, 2],
    [3, 2, 1, 0],
    [4, 5, 6, 7],
];
const kSides = [
    [0, 1],
    [1, 2],
    [2, 3],
    [3, 0],
    [4, 5],
    [5, 6],
    [6, 7],
    [7, 4],
    [0, 4],
    [1, 5],
    [2, 6],
    [3, 7],
];
const kFaceOfQuadSide = [2, 1, 3, 0]; // face of the cell over each side of its quad
const kNoValue = -32768,
    kNoFace = -(2 ** 31);

// The cells of a sweep: cell (layer l, quad q) has the number l · quads + q. Nothing is stored for each cell.
class SweptCells {
    static async load(r, data) {
        const cells = new SweptCells();
        Object.assign(cells, {
            name: r.name,
            layers: r.layers,
            perLayer: r.perLayer,
            quadCount: r.quadCount,
            count: r.quadCount * r.layers,
            nodeCount: r.nodes.count + (r.middles ? r.middles.nodes.count : 0),
        });
        cells.quads = await unpack(r.quads, 4 * r.quadCount, 4);
        cells.sourcePatch = await unpack(r.sourcePatch, r.quadCount, 1);
        cells.targetPatch = await unpack(r.targetPatch, r.quadCount, 1);
        const rim = await unpack(r.rim, 2 * r.rimCount, 2);
        cells.rimCount = r.rimCount;
        cells.wallPatch = await unpack(r.wallPatch, r.rimCount * r.layers, r.rimCount);
        cells.values = Int16Array.from(await unpack(r.values, cells.count, r.quadCount));
        if (r.middles) {
            cells.middles = {
                first: r.nodes.count,
                full: r.middles.full,
                sides: r.middles.sideCount,
                sideOf: await unpack(r.middles.sideOf, 4 * r.quadCount, 4),
            };
            const m = cells.middles;
            m.onLevel = m.sides + (m.full ? r.quadCount : 0);
            m.period = m.onLevel + r.perLayer + (m.full ? m.sides + r.quadCount : 0);
        }
        // For each side of a quad: the neighbouring quad, or -2 - r for side r of the rim.
        cells.across = new Int32Array(4 * r.quadCount).fill(-1);
        const open = new Map(),
            key = (a, b) => a * r.perLayer + b;
        for (let i = 0; i < r.rimCount; i++) open.set(key(rim[2 * i], rim[2 * i + 1]), -2 - i);
        const own = new Map(),
            q = cells.quads;
        for (let s = 0; s < q.length; s++) {
            const a = q[s],
                b = q[s % 4 === 3 ? s - 3 : s + 1];
            if (a === b) continue;
            const other = own.get(key(b, a));
            if (other !== undefined) {
                cells.across[s] = other >> 2;
                cells.across[other] = s >> 2;
                own.delete(key(b, a));
            } else {
                own.set(key(a, b), s);
            }
        }
        for (const [k, s] of own) cells.across[s] = open.get(k) ?? -1;
        return cells;
    }

    layerOf(c) {
        return Math.floor(c / this.quadCount);
    }
    columnOf(c) {
        return c % this.quadCount;
    }
    corners(c, out) {
        const q = 4 * (c % this.quadCount),
            low = this.base + this.layerOf(c) * this.perLayer;
        for (let k = 0; k < 4; k++) {
            out[k] = low + this.quads[q + k];
            out[k + 4] = out[k] + this.perLayer;
        }
    }
    // Middle nodes of the twelve edges; false: the cells are of order 1.
    middleNodes(c, out) {
        const m = this.middles;
        if (!m) return false;
        const q = c % this.quadCount,
            layer = this.layerOf(c),
            low = this.base + m.first + layer * m.period;
        for (let k = 0; k < 4; k++) {
            out[k] = low + m.sideOf[4 * q + k];
            out[k + 4] = out[k] + m.period;
            out[k + 8] = low + m.onLevel + this.quads[4 * q + k];
        }
        return true;
    }
    patchOf(c, face) {
        const q = c % this.quadCount,
            layer = this.layerOf(c);
        if (face === 4) return layer === 0 ? this.sourcePatch[q] : -1;
        if (face === 5) return layer === this.layers - 1 ? this.targetPatch[q] : -1;
        const rim = -2 - this.across[4 * q + kFaceOfQuadSide.indexOf(face)];
        return rim >= 0 ? this.wallPatch[layer * this.rimCount + rim] : -1;
    }
    // Call emit(cell, face, whether it belongs to the skin) for the faces that only one cell of `mask` has.
    exposed(mask, emit) {
        const n = this.quadCount,
            across = this.across,
            q = this.quads;
        for (let layer = 0, c = 0; layer < this.layers; layer++) {
            const low = layer * n;
            for (let i = 0; i < n; i++, c++) {
                if (!mask[c]) continue;
                if (layer === 0) emit(c, 4, true);
                else if (!mask[c - n]) emit(c, 4, false);
                if (layer === this.layers - 1) emit(c, 5, true);
                else if (!mask[c + n]) emit(c, 5, false);
                for (let k = 0, s = 4 * i; k < 4; k++, s++) {
                    const other = across[s];
                    if (other >= 0 ? !mask[low + other] : q[s] !== q[k === 3 ? s - 3 : s + 1])
                        emit(c, kFaceOfQuadSide[k], other < 0);
                }
            }
        }
    }
    // Mean height of the corners of each cell, from the heights of all nodes.
    heights(ofNode, out) {
        const n = this.quadCount,
            q = this.quads;
        for (let layer = 0, c = 0; layer < this.layers; layer++) {
            const low = this.base + layer * this.perLayer,
                high = low + this.perLayer;
            for (let i = 0, s = 0; i < n; i++, c++, s += 4)
                out[c] =
                    0.125 *
                    (ofNode[low + q[s]] +
                        ofNode[low + q[s + 1]] +
                        ofNode[low + q[s + 2]] +
                        ofNode[low + q[s + 3]] +
                        ofNode[high + q[s]] +
                        ofNode[high + q[s + 1]] +
                        ofNode[high + q[s + 2]] +
                        ofNode[high + q[s + 3]]);
        }
    }
}

// Cells listed in a file, eight corners each.
class ListedCells {
    static async load(r) {
        const cells = new ListedCells();
        Object.assign(cells, { name: r.name, count: r.count, layers: 0, nodeCount: r.nodes.count });
        cells.corner = await unpack(r.cells, 8 * r.count, 8);
        if (r.curved) cells.middles = await unpack(r.sideMiddles, 12 * r.count, 12);
        cells.values = Int16Array.from(await unpack(r.values, r.count, 1));
        cells.tags = await unpack(r.tags, r.count, 1);
        const sides = await unpack(r.sides, 4 * r.sideCount, 4),
            patch = await unpack(r.sidePatch, r.sideCount, 1);
        cells.join(sides, patch);
        return cells;
    }

    // Find neighbours: faces are chained by their lowest corner, then compared by all corners.
    join(sides, patch) {
        const n = this.count,
            corner = this.corner;
        this.across = new Int32Array(6 * n).fill(-1);
        const head = new Int32Array(this.nodeCount).fill(-1),
            next = new Int32Array(6 * n + patch.length).fill(-1);
        const nodes = (f, out) => {
            if (f >= 6 * n) {
                for (let k = 0; k < 4; k++) out[k] = sides[4 * (f - 6 * n) + k];
            } else {
                const cell = 8 * Math.floor(f / 6),
                    face = kFaces[f % 6];
                for (let k = 0; k < 4; k++) out[k] = corner[cell + face[k]];
            }
            for (let i = 1; i < 4; i++)
                for (let k = i; k > 0 && out[k] < out[k - 1]; k--)
                    [out[k], out[k - 1]] = [out[k - 1], out[k]];
            let distinct = 1;
            for (let k = 1; k < 4; k++) if (out[k] !== out[k - 1]) out[distinct++] = out[k];
            for (let k = distinct; k < 4; k++) out[k] = -1;
            return distinct >= 3;
        };
        const own = new Int32Array(4),
            other = new Int32Array(4);
        for (let f = 0; f < 6 * n + patch.length; f++) {
            if (!nodes(f, own)) {
                if (f < 6 * n) this.across[f] = kNoFace;
                continue;
            }
            let found = -1,
                before = -1;
            for (let g = head[own[0]]; g >= 0 && found < 0; before = g, g = next[g]) {
                nodes(g, other);
                if (own[1] === other[1] && own[2] === other[2] && own[3] === other[3]) found = g;
                if (found >= 0) break;
            }
            if (found < 0) {
                if (f < 6 * n) {
                    next[f] = head[own[0]];
                    head[own[0]] = f;
                }
            } else if (f >= 6 * n) {
                this.across[found] = -2 - patch[f - 6 * n];
            } else {
                this.across[f] = Math.floor(found / 6);
                this.across[found] = Math.floor(f / 6);
                if (before < 0) head[own[0]] = next[found];
                else next[before] = next[found];
            }
        }
    }

    layerOf() {
        return 0;
    }
    columnOf(c) {
        return c;
    }
    corners(c, out) {
        for (let k = 0; k < 8; k++) out[k] = this.base + this.corner[8 * c + k];
    }
    middleNodes(c, out) {
        if (!this.middles || this.middles[12 * c] < 0) return false;
        for (let k = 0; k < 12; k++) out[k] = this.base + this.middles[12 * c + k];
        return true;
    }
    patchOf(c, face) {
        const p = -2 - this.across[6 * c + face];
        return p >= 0 ? p : -1;
    }
    exposed(mask, emit) {
        for (let c = 0, f = 0; c < this.count; c++) {
            if (!mask[c]) {
                f += 6;
                continue;
            }
            for (let k = 0; k < 6; k++, f++) {
                const other = this.across[f];
                if (other === kNoFace) continue;
                if (other < 0) emit(c, k, true);
                else if (!mask[other]) emit(c, k, false);
            }
        }
    }
    heights(ofNode, out) {
        for (let c = 0, at = 0; c < this.count; c++) {
            let sum = 0;
            for (let k = 0; k < 8; k++, at++) sum += ofNode[this.base + this.corner[at]];
            out[c] = sum / 8;
        }
    }
}
