// SPDX-License-Identifier: MIT
"use strict";

// Lets large skins be rotated without a graphics card: invisible parts are skipped, and a coarser skin can be
// drawn during motion.

const kPartSides = 512; // most sides of a part; smaller parts need more calls, 20 µs each
const kDirections = 54; // nine for each side of a cube
const kSpots = 4096; // 16 in each direction
const kNeverAway = 2; // larger than the sine of any angle
const kRounding = 1e-3; // far above the rounding of single precision
// Pairs of corners whose differences give a normal by their cross product: for
// the side, and for its triangles.
const kSpans = [
    [0, 2, 1, 3],
    [0, 1, 0, 2],
    [0, 2, 0, 3],
];

// Sides of four nodes each, sorted into parts of close sides; in a closed skin, the sides
// of a part have similar normals.
class Parts {
    constructor(nodes, sides, n, closed) {
        this.count = n;
        this.box(nodes, sides);
        const order = this.sort(nodes, sides, closed);
        this.indices = new Uint32Array(6 * n);
        for (let i = 0, at = 0; i < n; i++) {
            const v = 4 * order[i];
            this.indices[at++] = v;
            this.indices[at++] = v + 1;
            this.indices[at++] = v + 2;
            this.indices[at++] = v;
            this.indices[at++] = v + 2;
            this.indices[at++] = v + 3;
        }
        this.bound(nodes, sides, order, closed);
    }

    box(nodes, sides) {
        this.low = [Infinity, Infinity, Infinity];
        this.high = [-Infinity, -Infinity, -Infinity];
        for (let i = 0; i < 4 * this.count; i++)
            for (let k = 0, at = 3 * sides[i]; k < 3; k++, at++) {
                if (nodes[at] < this.low[k]) this.low[k] = nodes[at];
                if (nodes[at] > this.high[k]) this.high[k] = nodes[at];
            }
    }

    // Sort sides by direction of their normals, then by position; `starts`: where each direction begins.
    sort(nodes, sides, closed) {
        const n = this.count,
            keys = new Uint32Array(n),
            from = new Uint32Array(kDirections * kSpots + 1),
            perSpot = this.low.map((low, k) => 15.999 / Math.max(this.high[k] - low, 1e-30)),
            normal = [0, 0, 0];
        this.area = 0;
        for (let s = 0; s < n; s++) {
            this.area += normalOf(nodes, sides, s, 0, normal) / 2;
            const a = 3 * sides[4 * s],
                c = 3 * sides[4 * s + 2];
            let spot = 0;
            for (let k = 0; k < 3; k++) {
                const at = ((nodes[a + k] + nodes[c + k]) / 2 - this.low[k]) * perSpot[k];
                spot |= kSpread[at & 15] << k;
            }
            keys[s] = (closed ? directionOf(normal) * kSpots : 0) + spot;
            from[keys[s] + 1]++;
        }
        for (let k = 0; k < from.length - 1; k++) from[k + 1] += from[k];
        this.starts = new Set();
        for (let d = 1; d < kDirections; d++) this.starts.add(from[d * kSpots]);
        const order = new Uint32Array(n);
        for (let s = 0; s < n; s++) order[from[keys[s]]++] = s;
        return order;
    }

    // For each part: its first side, its bounding sphere, its mean normal, and the sine of the largest angle
    // between a normal and the mean.
    bound(nodes, sides, order, closed) {
        const firsts = [],
            rows = [],
            normal = [0, 0, 0];
        for (let first = 0, last; first < this.count; first = last) {
            last = first + 1;
            while (last < this.count && last - first < kPartSides && !this.starts.has(last)) last++;
            const low = [Infinity, Infinity, Infinity],
                high = [-Infinity, -Infinity, -Infinity],
                mean = [0, 0, 0];
            for (let i = first; i < last; i++) {
                const s = 4 * order[i];
                for (let c = s; c < s + 4; c++)
                    for (let k = 0, at = 3 * sides[c]; k < 3; k++, at++) {
                        if (nodes[at] < low[k]) low[k] = nodes[at];
                        if (nodes[at] > high[k]) high[k] = nodes[at];
                    }
                normalOf(nodes, sides, order[i], 0, normal);
                for (let k = 0; k < 3; k++) mean[k] += normal[k];
            }
            const axis = unit(mean);
            let least = closed ? 1 : -1;
            for (let i = first; i < last && least > 0; i++)
                for (let triangle = 1; triangle < 3; triangle++)
                    if (normalOf(nodes, sides, order[i], triangle, normal) > 0)
                        least = Math.min(least, dot(normal, axis));
            const centre = low.map((x, k) => (x + high[k]) / 2);
            firsts.push(first);
            rows.push(
                ...centre,
                Math.hypot(...high.map((x, k) => x - centre[k])),
                ...axis,
                least > 0 ? Math.sqrt(Math.max(0, 1 - least * least)) : kNeverAway,
            );
        }
        firsts.push(this.count);
        this.firsts = Uint32Array.from(firsts);
        this.rows = Float32Array.from(rows);
    }

    // Ranges of sides that may be visible, as (first side, number of sides) in the order of this object.
    // `area`: smallest and largest x, then y, of the part of the window. Consecutive parts are merged to one
    // range.
    seen(camera, aspect, area = [-1, 1, -1, 1]) {
        const [right, up, back] = camera.axes,
            ranges = [],
            { firsts, rows } = this;
        let next = -1;
        for (let p = 0, at = 0; p + 1 < firsts.length; p++, at += 8) {
            const faces = rows[at + 4] * back[0] + rows[at + 5] * back[1] + rows[at + 6] * back[2];
            if (faces < -rows[at + 7] - kRounding) continue;
            const v = [0, 1, 2].map(k => rows[at + k] - camera.centre[k]),
                reach = (1 + kRounding) * rows[at + 3];
            const x = dot(right, v),
                y = dot(up, v),
                wide = camera.scale * aspect;
            if (x + reach < area[0] * wide || x - reach > area[1] * wide) continue;
            if (y + reach < area[2] * camera.scale || y - reach > area[3] * camera.scale) continue;
            const sides = firsts[p + 1] - firsts[p];
            if (firsts[p] === next) ranges[ranges.length - 1][1] += sides;
            else ranges.push([firsts[p], sides]);
            next = firsts[p + 1];
        }
        return ranges;
    }
}

const sidesIn = ranges => ranges.reduce((sum, range) => sum + range[1], 0);

// The four bits of a number, spread to every third bit.
const kSpread = Array.from(
    { length: 16 },
    (_, x) => (x & 1) | ((x & 2) << 2) | ((x & 4) << 4) | ((x & 8) << 6),
);

// Unit normal of side `s`, or of one of its triangles, into `out`; returns twice the area.
function normalOf(nodes, sides, s, which, out) {
    const [i, j, k, l] = kSpans[which],
        a = 3 * sides[4 * s + i],
        b = 3 * sides[4 * s + j],
        c = 3 * sides[4 * s + k],
        d = 3 * sides[4 * s + l];
    const ux = nodes[b] - nodes[a],
        uy = nodes[b + 1] - nodes[a + 1],
        uz = nodes[b + 2] - nodes[a + 2];
    const vx = nodes[d] - nodes[c],
        vy = nodes[d + 1] - nodes[c + 1],
        vz = nodes[d + 2] - nodes[c + 2];
    const x = uy * vz - uz * vy,
        y = uz * vx - ux * vz,
        z = ux * vy - uy * vx;
    const size = Math.sqrt(x * x + y * y + z * z),
        by = size > 0 ? 1 / size : 0;
    out[0] = x * by;
    out[1] = y * by;
    out[2] = z * by;
    return size;
}

// Number of the direction closest to a unit normal. Each side of a cube is divided into nine directions.
function directionOf(normal) {
    let axis = 0;
    for (let k = 1; k < 3; k++) if (Math.abs(normal[k]) > Math.abs(normal[axis])) axis = k;
    const size = Math.abs(normal[axis]) || 1,
        third = k => Math.min(2, Math.floor((normal[(axis + k) % 3] / size + 1) * 1.5));
    return ((2 * axis + (normal[axis] < 0)) * 3 + third(1)) * 3 + third(2);
}

// Vertex clustering @cite rossignac_1993_clustering: merges the nodes in each cube of size `step`, and
// returns the remaining sides with their original numbers. The remaining node is on a feature edge of the
// skin if the cube has one, else the node closest to the centre of the cube, so corners stay sharp. A closed
// skin stays closed.
function coarsen(nodes, sides, n, step) {
    // Nodes of the skin, numbered in order of occurrence, and the sum of the unit normals around each.
    const numberOf = new Int32Array(nodes.length / 3).fill(-1),
        nodeOf = new Int32Array(4 * n),
        bends = new Float32Array(16 * n),
        normal = [0, 0, 0];
    let count = 0;
    for (let s = 0; s < n; s++) {
        normalOf(nodes, sides, s, 0, normal);
        for (let i = 4 * s; i < 4 * s + 4; i++) {
            let own = numberOf[sides[i]];
            if (own < 0) {
                own = numberOf[sides[i]] = count;
                nodeOf[count++] = sides[i];
            }
            for (let k = 0; k < 3; k++) bends[4 * own + k] += normal[k];
            bends[4 * own + 3]++;
        }
    }
    // The cube of each node, in a hash table; and the remaining node of each cube.
    let size = 1;
    while (size < 2 * count) size *= 2;
    const table = new Int32Array(size).fill(-1),
        cubes = new Int32Array(3 * count),
        cubeOf = new Int32Array(count),
        stays = new Int32Array(count),
        best = new Float32Array(count).fill(-Infinity),
        at = [0, 0, 0];
    let made = 0;
    for (let own = 0; own < count; own++) {
        let off = 0;
        for (let k = 0; k < 3; k++) {
            const x = nodes[3 * nodeOf[own] + k] / step + 0.37; // keeps grid nodes off the cube faces
            at[k] = Math.floor(x);
            off += (x - at[k] - 0.5) ** 2;
        }
        // Large primes, to spread neighbouring cubes in the table.
        const hash =
            Math.imul(at[0], 73856093) ^ Math.imul(at[1], 19349663) ^ Math.imul(at[2], 83492791);
        let slot = hash & (size - 1);
        for (; ; slot = (slot + 1) & (size - 1)) {
            const c = 3 * table[slot];
            if (c < 0 || (cubes[c] === at[0] && cubes[c + 1] === at[1] && cubes[c + 2] === at[2])) break;
        }
        if (table[slot] < 0) {
            cubes.set(at, 3 * made);
            table[slot] = made++;
        }
        const cube = (cubeOf[own] = table[slot]);
        const b = 4 * own,
            sum = bends[b] * bends[b] + bends[b + 1] * bends[b + 1] + bends[b + 2] * bends[b + 2],
            bend = 1 - Math.sqrt(sum) / bends[b + 3];
        const worth = bend > 0.1 ? bend : -off;
        if (worth > best[cube]) {
            best[cube] = worth;
            stays[cube] = nodeOf[own];
        }
    }
    const kept = new Uint32Array(4 * n),
        from = new Uint32Array(n),
        ring = [0, 0, 0, 0];
    let left = 0;
    for (let s = 0; s < n; s++) {
        let corners = 0;
        for (let i = 0; i < 4; i++) {
            const cube = cubeOf[numberOf[sides[4 * s + i]]];
            if (corners === 0 || cube !== ring[corners - 1]) ring[corners++] = cube;
        }
        while (corners > 1 && ring[corners - 1] === ring[0]) corners--;
        if (corners < 3 || (corners === 4 && (ring[0] === ring[2] || ring[1] === ring[3]))) continue;
        for (let i = 0; i < 4; i++) kept[4 * left + i] = stays[ring[Math.min(i, corners - 1)]];
        from[left++] = s;
    }
    return { sides: kept.slice(0, 4 * left), from: from.slice(0, left) };
}
