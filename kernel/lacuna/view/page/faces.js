// SPDX-License-Identifier: MIT
"use strict";

// Models and open volumes: faces to select for a recipe.

// Named roles, or faces whose roles are determined automatically.
const kRoles = ["source", "target", "walls", "faces"];
const kFreeEdge = [214, 39, 40],
    kEdge = [40, 50, 60],
    kVoidEdge = [190, 110, 10],
    kWallFree = [148, 20, 140],
    kChosen = [30, 140, 140];

class FacesPage {
    static async make(data, stage, panel) {
        const page = new FacesPage();
        Object.assign(page, { data, stage, panel });
        page.nodes = new Float32Array(3 * data.nodes.count);
        await unpackNodes(data.nodes, data, page.nodes, 0);
        page.sides = await unpack(data.sides, 4 * data.sideCount, 4);
        page.edgePoints = await unpack(data.edgePoints, data.edgePointCount, 1);
        page.faceOf = new Int32Array(data.sideCount);
        data.faces.forEach((face, f) => page.faceOf.fill(f, face.first, face.first + face.sides));
        page.role = data.faces.map(face => face.role);
        page.chosenRole = "source";
        page.drawing = new Drawing(stage.canvas, page.nodes);
        page.drawing.back = 0.72;
        page.camera = new Camera(data.radius, stage.canvas.clientWidth / stage.canvas.clientHeight);
        page.drawing.putSides(Uint32Array.from(page.sides), data.sideCount);
        page.colours = new Uint32Array(data.sideCount);
        page.facesOfEdge = data.edges.map(() => []);
        data.faces.forEach((face, f) => face.edges.forEach(e => page.facesOfEdge[e].push(f)));
        page.buildPanel();
        page.paint();
        return page;
    }

    buildPanel() {
        const { data, panel } = this;
        panel.append(
            el("h1", { textContent: data.title }),
            el("p", { textContent: data.facts.join(" · ") }),
            el("p", { className: "quiet", textContent: "Lengths are in the unit of the file." }),
            ...data.notes.map(note => el("p", { className: "quiet", textContent: note })),
        );
        const choose = section(panel, "Click faces to make them");
        this.roleChoice = choice(
            kRoles.map(r => [r, r]),
            this.chosenRole,
            value => {
                this.chosenRole = value;
            },
        );
        choose.append(
            this.roleChoice.row,
            el("p", {
                className: "quiet",
                textContent:
                    "A second click takes a face out. Keys 1 to 4 change the role. " +
                    "If you choose faces alone, their likely roles are found.",
            }),
        );
        this.recipe = el("textarea", { readOnly: true, spellcheck: false, id: "recipe" });
        this.copied = el("span", { className: "quiet" });
        choose.append(
            this.recipe,
            row(
                el("button", { textContent: "Copy", id: "copy", onclick: () => this.copy() }),
                el("button", {
                    textContent: "Clear",
                    onclick: () => {
                        this.role.fill(null);
                        this.tolerance = null;
                        this.paint();
                    },
                }),
                this.copied,
            ),
        );
        this.listCavities();
        this.state = section(panel, "What is open");
        this.listGaps();
        this.legend = section(panel, "Legend");
        const names = section(panel, "Faces");
        this.faceButtons = data.faces.map((face, f) =>
            el(
                "button",
                {
                    className: "link",
                    onclick: () => this.flyTo(f),
                    onmouseenter: () => this.lift(f),
                    onmouseleave: () => this.lift(-1),
                },
                this.title(face),
                el("span", {
                    className: "quiet",
                    textContent: `  ${face.void ? face.geometry : face.kind}, area ${digits(face.area)}`,
                }),
            ),
        );
        names.append(...this.faceButtons);
        window.addEventListener("keydown", event => {
            const role = kRoles[Number(event.key) - 1];
            if (role && event.target.tagName !== "TEXTAREA") this.roleChoice.set(role);
        });
        this.labels = el("div", { id: "labels" });
        this.stage.box.append(this.labels);
        this.labelOf = data.faces.map(face =>
            el("div", {
                textContent: (face.void ? "void " : "") + face.tag + (face.name ? ` ${face.name}` : ""),
            }),
        );
    }

    // A line of a list: pointing at it highlights its face, clicking selects it.
    offer(words, quiet, seen, taken) {
        return el(
            "button",
            {
                className: "link",
                onclick: taken,
                onmouseenter: () => this.liftEdges(seen()),
                onmouseleave: () => this.lift(-1),
            },
            words,
            el("span", { className: "quiet", textContent: `  ${quiet}` }),
        );
    }

    listCavities() {
        const { data } = this;
        if (data.cavities.length === 0) return;
        const numberOf = new Map(data.faces.map((face, f) => [face.tag, f]));
        this.cavityButtons = data.cavities.map(cavity => {
            const faces = cavity.faces.map(tag => numberOf.get(tag));
            const some = cavity.faces.slice(0, 12).join(", ") + (faces.length > 12 ? ", …" : "");
            return this.offer(
                `${cavity.kind}, faces ${some}`,
                `likely class ${cavity.class}, volume ${digits(cavity.volume)}`,
                () => faces.flatMap(f => data.faces[f].edges),
                () => {
                    this.role.fill(null);
                    faces.forEach(f => {
                        this.role[f] = "faces";
                    });
                    this.paint();
                },
            );
        });
        section(this.panel, "Cavities").append(...this.cavityButtons);
    }

    listGaps() {
        const { data } = this;
        if (data.gaps.length === 0) return;
        this.gapButtons = data.gaps.map(gap => {
            const [own, other] = gap.edges.map(e => data.edges[e].tag);
            return this.offer(
                `edges ${own} and ${other}`,
                `at most ${digits(gap.width)} apart; tolerance = ${gap.tolerance} sews them`,
                () => gap.edges,
                () => {
                    this.tolerance = this.tolerance === gap.tolerance ? null : gap.tolerance;
                    this.paint();
                },
            );
        });
        section(this.panel, "Gaps").append(...this.gapButtons);
    }

    title(face) {
        return (face.void ? "void face " : "face ") + face.tag + (face.name ? ` "${face.name}"` : "");
    }

    // --- the recipe --------------------

    recipeText() {
        const { data } = this;
        const tags = role =>
            data.faces.filter((face, f) => this.role[f] === role && !face.void).map(face => face.tag);
        const lines = kRoles
            .filter(role => tags(role).length > 0)
            .map(role => `  ${role} = { ${tags(role).join(", ")} },`);
        const load = this.tolerance
            ? `lacuna.load(${luaText(data.path || "…")}, { tolerance = ${this.tolerance} })`
            : `lacuna.load ${luaText(data.path)}`;
        const path = data.path || this.tolerance ? [`local model = ${load}`] : [];
        if (lines.length === 0) return this.tolerance ? path[0] : "";
        return [
            ...(path.length ? ['local lacuna = require "lacuna"'] : []),
            ...path,
            "local void = model:open_volume {",
            ...lines,
            "}",
            ...(data.path
                ? [
                      "local mesh = void:sweep {}",
                      `mesh:write ${luaText(meshName(data.path))}`,
                      "print(mesh, mesh:quality().min_scaled_jacobian)",
                  ]
                : []),
        ].join("\n");
    }
    copy() {
        const done = () => {
            this.copied.textContent = "copied";
            setTimeout(() => {
                this.copied.textContent = "";
            }, 1500);
        };
        const byHand = () => {
            this.recipe.select();
            if (document.execCommand("copy")) done();
        };
        if (navigator.clipboard) navigator.clipboard.writeText(this.recipe.value).then(done, byHand);
        else byHand();
    }

    // Edges used once by the selected faces, and vertices on the rims of the ends that are on no wall.
    // Without a selection, edges used once by all faces.
    openOf() {
        const { data, role } = this,
            some = role.some(r => r !== null);
        const uses = data.edges.map(
            (_, e) => this.facesOfEdge[e].filter(f => !some || role[f] !== null).length,
        );
        const free = data.edges.map((_, e) => uses[e] === 1);
        const onWall = new Set(),
            onEnd = new Set();
        data.faces.forEach((face, f) => {
            if (role[f] === null) return;
            for (const e of face.edges)
                for (const v of [data.edges[e].from, data.edges[e].to])
                    if (role[f] === "walls") onWall.add(v);
                    else if (role[f] === "faces") continue;
                    else if (free[e] || this.facesOfEdge[e].some(o => role[o] === "walls")) onEnd.add(v);
        });
        const ends = role.includes("source") || role.includes("target");
        return { free, wallFree: ends ? [...onEnd].filter(v => !onWall.has(v)) : [], some };
    }

    // --- the picture --------------------

    paint() {
        const { data } = this,
            palette = data.palette;
        const { free, wallFree, some } = this.openOf();
        const colours = data.faces.map((face, f) => {
            const role = this.role[f];
            const colour = role ? palette[role] || kChosen : face.void ? palette.void : palette.given;
            return word(colour, (face.void ? kHatched : 0) | (some && role === null ? kFaint : 0));
        });
        for (let s = 0; s < data.sideCount; s++) {
            const f = this.faceOf[s],
                quads = s - data.faces[f].first < data.faces[f].quads;
            this.colours[s] = (colours[f] | (quads ? 0 : 15 << 24)) >>> 0;
        }
        this.drawing.putColours(this.colours);
        const lines = [];
        data.edges.forEach((edge, e) => {
            const mark = free[e] ? word(kFreeEdge, 10) : edge.void ? word(kVoidEdge, 6) : word(kEdge, 4);
            for (let i = edge.first; i + 1 < edge.first + edge.points; i++)
                lines.push(this.edgePoints[i], this.edgePoints[i + 1], mark);
        });
        this.drawing.putLines(lines);
        this.wallFree = wallFree;
        this.recipe.value = this.recipeText();
        const freeCount = free.filter(x => x).length;
        this.state.replaceChildren(
            el("p", {
                textContent: some
                    ? `The chosen faces leave ${things(freeCount, "free edge")} and ${things(
                          wallFree.length,
                          "vertex of an end",
                          "vertices of the ends",
                      )} without a wall.`
                    : freeCount > 0
                      ? `${things(freeCount, "edge")} of one face alone.`
                      : "No free edge: the faces form a closed skin.",
            }),
        );
        const hatched = data.faces.some(face => face.void);
        const line = (colour, text) =>
            row(el("span", { style: { width: "22px", borderTop: `3px solid ${css(colour)}` } }), text);
        this.legend.replaceChildren(
            ...kRoles.filter(r => this.role.includes(r)).map(r => row(swatch(palette[r] || kChosen), r)),
            row(swatch(palette.given), "given face"),
            ...(hatched
                ? [row(swatch([240, 240, 240], true), "hatched: made when the volume was closed")]
                : []),
            ...(freeCount ? [line(kFreeEdge, "free edge")] : []),
            ...(wallFree.length ? [row(swatch(kWallFree), "vertex of an end on no wall")] : []),
        );
        this.stage.change();
    }

    lift(f) {
        this.lifted = f;
        this.liftEdges(f >= 0 ? this.data.faces[f].edges : []);
    }

    liftEdges(edges) {
        const lines = [];
        for (const e of edges) {
            const edge = this.data.edges[e];
            for (let i = edge.first; i + 1 < edge.first + edge.points; i++)
                lines.push(this.edgePoints[i], this.edgePoints[i + 1], word([20, 60, 200], 12));
        }
        this.drawing.putLines(lines, true);
        this.stage.change();
    }

    flyTo(f) {
        const face = this.data.faces[f],
            centre = plus(face.centre, times(this.data.centre, -1));
        const from =
            Math.hypot(...face.normal) > 0.3
                ? plus(unit(face.normal), times(this.camera.axes[2], 0.35))
                : this.camera.axes[2];
        this.stage.flyTo(centre, Math.max(0.05 * this.data.radius, 0.9 * face.reach), from);
    }

    // "radius 3". A face of another kind also gets the surface that it lies on: "a cylinder of radius 3".
    round(face) {
        const size = `radius ${digits(face.radius)}`;
        return [face.fits, "torus"].includes(face.kind) ? size : `a ${face.fits} of ${size}`;
    }

    over(x, y) {
        const side = x < 0 ? -1 : this.drawing.pick(this.camera, x, y);
        const f = side < 0 ? -1 : this.faceOf[side];
        if (f !== this.lifted) this.lift(f);
        if (f < 0) return null;
        const { data } = this,
            face = data.faces[f],
            { free } = this.openOf();
        const some = face.neighbours.slice(0, 12).join(", ") + (face.neighbours.length > 12 ? ", …" : "");
        const freeEdges = face.edges.filter(e => free[e]).length;
        return [
            this.title(face) + (this.role[f] ? ` – ${this.role[f]}` : ""),
            face.void
                ? `void, closed: ${face.geometry}`
                : face.kind + (face.radius ? `, ${this.round(face)}` : ""),
            face.axis ? `axis ${place(face.axis)}` : "",
            `area ${digits(face.area)}`,
            `centre ${place(face.centre)}`,
            Math.hypot(...face.normal) > 0.3 ? `normal ${place(face.normal)}` : "",
            face.low ? `box ${place(face.low)} to ${place(face.high)}` : "",
            `${things(new Set(face.edges).size, "edge")}, ${things(face.loops, "loop")}` +
                (freeEdges ? `, ${freeEdges} free` : ""),
            some ? `next to ${some}` : "no neighbours",
            face.use || "",
            face.quads ? `came with ${things(face.quads, "quad")}` : "",
            face.groups.length ? `in ${face.groups.join(", ")}` : "",
            face.regions.length ? `bounds ${face.regions.join(", ")}` : "",
        ];
    }

    click(x, y) {
        const side = this.drawing.pick(this.camera, x, y);
        if (side < 0) return false;
        const f = this.faceOf[side];
        if (this.data.faces[f].void) return false;
        const alone = r => r === "faces";
        this.role = this.role.map(r => (alone(r) === alone(this.chosenRole) ? r : null)); // no mixture
        this.role[f] = this.role[f] === this.chosenRole ? null : this.chosenRole;
        this.paint();
        return true;
    }

    // Labels are placed where most of a face is visible, according to a small picture of the faces. There are
    // none while the picture is incomplete.
    moved(whole) {
        this.labels.style.visibility = whole ? "visible" : "hidden";
        if (!whole) return;
        const box = this.stage.canvas.getBoundingClientRect(),
            share = Math.min(1, 320 / box.width);
        const size = [
            Math.max(1, Math.round(box.width * share)),
            Math.max(1, Math.round(box.height * share)),
        ];
        const shown = this.drawing.shown(this.camera, size),
            n = this.data.faces.length;
        const sum = Array.from({ length: n }, () => [0, 0, 0]),
            best = new Array(n).fill(null);
        const each = then =>
            shown.forEach((side, at) => {
                if (side < this.data.sideCount)
                    then(this.faceOf[side], at % size[0], Math.floor(at / size[0]));
            });
        each((f, x, y) => {
            sum[f][0] += x;
            sum[f][1] += y;
            sum[f][2]++;
        });
        each((f, x, y) => {
            const apart = Math.hypot(x - sum[f][0] / sum[f][2], y - sum[f][1] / sum[f][2]);
            if (best[f] === null || apart < best[f][2]) best[f] = [x, y, apart];
        });
        const labels = [];
        best.forEach((at, f) => {
            if (at === null || sum[f][2] < 12) return;
            const label = this.labelOf[f];
            label.style.left = `${(at[0] + 0.5) / share}px`;
            label.style.top = `${(size[1] - at[1] - 0.5) / share}px`;
            label.className = this.role[f] ? "chosen" : "";
            labels.push(label);
        });
        for (const v of this.wallFree) {
            const [x, y] = this.camera.project(
                this.nodes.subarray(3 * this.data.vertices[v].point, 3 * this.data.vertices[v].point + 3),
                box.width,
                box.height,
            );
            labels.push(
                el("div", {
                    className: "vertex",
                    title: String(this.data.vertices[v].tag),
                    style: {
                        left: `${x}px`,
                        top: `${y}px`,
                        width: "11px",
                        height: "11px",
                        padding: 0,
                        borderRadius: "50%",
                        background: css(kWallFree),
                    },
                }),
            );
        }
        this.labels.replaceChildren(...labels);
    }
}

// "part.msh" of "folder/part.step".
const meshName = path => path.replace(/^.*\//, "").replace(/\.[^.]*$/, "") + ".msh";

// A text as a Lua string.
function luaText(text) {
    return (
        '"' +
        text
            .replace(/[\\"]/g, "\\$&")
            .replace(/[\u0000-\u001f]/g, c => `\\${String(c.charCodeAt(0)).padStart(3, "0")}`) +
        '"'
    );
}
