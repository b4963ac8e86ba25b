// SPDX-License-Identifier: MIT
"use strict";

// Drawing with WebGL 2. Nodes are stored in a texture, and so are the sides: quads or triangles with four
// node numbers and a colour. The vertex shader looks them up by vertex number. Instanced drawing would do the
// same, but takes 20 µs for each instance without a graphics card.

const kRow = 2048; // texels in a row of a texture
const kHiddenEdges = 15,
    kHatched = 16,
    kFaint = 32; // flags of a side; in the first four bits, bit k: edge k is not drawn

const kNodeOf = `
uniform highp sampler2D uNodes;
ivec2 texel(int n) { return ivec2(n % ${kRow}, n / ${kRow}); }
vec3 nodeAt(uint n) { return texelFetch(uNodes, texel(int(n)), 0).xyz; }
`;

const kSideVertex = `#version 300 es
precision highp float;
precision highp int;
${kNodeOf}
uniform mat4 uMatrix;
uniform mat3 uTurn;
uniform float uScale;
uniform highp usampler2D uSides;
uniform highp usampler2D uColours;
out vec3 vPlace;
out vec4 vEdge;
flat out uint vColour;
flat out int vSide;
// Distance of a corner from each edge; edge k runs from corner k to the next.
const vec4 kQuad[4] = vec4[4](vec4(0, 1, 1, 0), vec4(0, 0, 1, 1), vec4(1, 0, 0, 1), vec4(1, 1, 0, 0));
const vec4 kTriangle[4] = vec4[4](vec4(0, 1, 1, 0), vec4(0, 0, 1, 1), vec4(1, 0, 1, 0), vec4(1, 0, 1, 0));
void main() {
  int corner = gl_VertexID % 4;
  vSide = gl_VertexID / 4;
  uvec4 nodes = texelFetch(uSides, texel(vSide), 0);
  vec3 at = nodeAt(nodes[corner]);
  vEdge = nodes[2] == nodes[3] ? kTriangle[corner] : kQuad[corner];
  vPlace = uTurn * at / uScale;
  vColour = texelFetch(uColours, texel(vSide), 0).x;
  gl_Position = uMatrix * vec4(at, 1);
}`;

const kSideFragment = `#version 300 es
precision highp float;
precision highp int;
uniform int uHover;
uniform float uEdges;
uniform float uFlat;
in vec3 vPlace;
in vec4 vEdge;
flat in uint vColour;
flat in int vSide;
out vec4 oColour;
void main() {
  vec3 colour = vec3(float(vColour & 255u), float(vColour >> 8 & 255u), float(vColour >> 16 & 255u)) / 255.0;
  uint flags = vColour >> 24;
  vec3 normal = normalize(cross(dFdx(vPlace), dFdy(vPlace)));
  if (normal.z < 0.0) normal = -normal;
  float light = 0.52 + 0.40 * max(dot(normal, normalize(vec3(-0.25, 0.45, 0.86))), 0.0) + 0.10 * normal.z;
  if (!gl_FrontFacing) light *= uFlat;
  colour *= light;
  if ((flags & ${kHatched}u) != 0u && mod(gl_FragCoord.x + gl_FragCoord.y, 9.0) < 2.0) colour *= 0.72;
  if ((flags & ${kFaint}u) != 0u) colour = mix(colour, vec3(0.97), 0.55);
  if (vSide == uHover) colour = mix(colour, vec3(1.0), 0.35);
  if (uEdges > 0.0) {
    vec4 width = fwidth(vEdge);
    vec4 shown = clamp((0.95 - vEdge / max(width, 1e-6)) / 0.85, 0.0, 1.0);
    shown *= clamp((0.45 - width) / 0.33, 0.0, 1.0);
    shown *= vec4(equal(uvec4(flags) & uvec4(1, 2, 4, 8), uvec4(0)));
    float line = max(max(shown.x, shown.y), max(shown.z, shown.w));
    colour = mix(colour, vec3(0.08, 0.11, 0.15), line * uEdges);
  }
  oColour = vec4(colour, 1);
}`;

const kPickFragment = `#version 300 es
precision highp float;
precision highp int;
in vec3 vPlace;
in vec4 vEdge;
flat in uint vColour;
flat in int vSide;
out vec4 oColour;
void main() {
  int id = vSide + 1;
  oColour = vec4(float(id & 255), float(id >> 8 & 255), float(id >> 16 & 255), float(id >> 24 & 255)) / 255.0;
}`;

const kLineVertex = `#version 300 es
precision highp float;
precision highp int;
${kNodeOf}
uniform mat4 uMatrix;
uniform vec2 uSize;
uniform float uNearer;
uniform highp usampler2D uLines;
out vec4 vColour;
void main() {
  uvec4 line = texelFetch(uLines, texel(gl_VertexID / 4), 0);
  int corner = gl_VertexID % 4;
  vec4 from = uMatrix * vec4(nodeAt(line.x), 1), to = uMatrix * vec4(nodeAt(line.y), 1);
  vec2 along = (to.xy - from.xy) * uSize;
  float length = length(along);
  along = length > 1e-6 ? along / length : vec2(1, 0);
  float half_width = float(line.z >> 24) * 0.25;
  float side = corner == 0 || corner == 3 ? -1.0 : 1.0;
  bool end = corner > 1;
  vec4 at = end ? to : from;
  vec2 shift = vec2(-along.y, along.x) * side + along * (end ? 1.0 : -1.0);
  at.xy += shift * half_width * 2.0 / uSize;
  at.z -= uNearer;
  vColour = vec4(float(line.z & 255u), float(line.z >> 8 & 255u), float(line.z >> 16 & 255u), 255.0) / 255.0;
  gl_Position = at;
}`;

const kLineFragment = `#version 300 es
precision highp float;
in vec4 vColour;
out vec4 oColour;
void main() { oColour = vColour; }`;

const kSideTextures = { uNodes: "uNodes", uSides: "uSides", uColours: "uColours" };
const kCoarseTextures = { uNodes: "uNodes", uSides: "coarse sides", uColours: "coarse colours" };
const kBackground = [0.965, 0.969, 0.976, 1];

// Measured on two cores without a graphics card: a side takes 0.4 µs, and four samples per pixel take three
// times as long as one.
const kSlow = 30; // [ms] if a complete picture takes longer, moving pictures are drawn coarser
const kMovingSides = 20000, // limits for a moving picture
    kMovingPixels = 300000;
const kPiece = 16384; // sides drawn at a time in a picture that does not move

class Drawing {
    constructor(canvas, nodes) {
        const gl = canvas.getContext("webgl2", { antialias: false });
        if (!gl) throw new Error("This page needs WebGL 2, which the browser does not offer here.");
        this.gl = gl;
        this.canvas = canvas;
        this.sides = this.program(kSideVertex, kSideFragment);
        this.picking = this.program(kSideVertex, kPickFragment);
        this.lines = this.program(kLineVertex, kLineFragment);
        this.textures = {};
        this.targets = {};
        this.buffers = {};
        this.single = gl.createBuffer();
        this.strips = { buffer: gl.createBuffer(), quads: 0 };
        this.closed = false; // closed skin, oriented outward: sides that face away are not drawn
        this.sideCount = this.lineCount = this.topCount = 0;
        this.hover = -1;
        this.edges = 0.7;
        this.back = 0.8;
        this.asked = 0; // number of requests
        this.whole = false; // whether the picture shown is complete
        this.slow = null; // whether a complete picture takes long; null: unknown
        this.fine = this.coarse = null;
        this.nodes = nodes;
        this.putNodes(nodes);
    }

    program(vertex, fragment) {
        const gl = this.gl,
            program = gl.createProgram();
        for (const [kind, source] of [
            [gl.VERTEX_SHADER, vertex],
            [gl.FRAGMENT_SHADER, fragment],
        ]) {
            const shader = gl.createShader(kind);
            gl.shaderSource(shader, source);
            gl.compileShader(shader);
            if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS))
                throw new Error(gl.getShaderInfoLog(shader));
            gl.attachShader(program, shader);
        }
        gl.linkProgram(program);
        if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
        const places = {};
        for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
            const name = gl.getActiveUniform(program, i).name;
            places[name] = gl.getUniformLocation(program, name);
        }
        return { program, places };
    }

    // Store `values`, `channels` of them in each texel, in the texture `name`.
    put(name, internal, format, type, channels, values) {
        const gl = this.gl,
            rows = Math.max(1, Math.ceil(values.length / channels / kRow));
        if (rows > gl.getParameter(gl.MAX_TEXTURE_SIZE))
            throw new Error("The mesh is too large for the graphics of this browser.");
        const whole = rows * kRow * channels;
        let filled = values;
        if (values.length !== whole) {
            filled = new values.constructor(whole);
            filled.set(values);
        }
        this.textures[name] ??= gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, this.textures[name]);
        gl.texImage2D(gl.TEXTURE_2D, 0, internal, kRow, rows, 0, format, type, filled);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    }
    putNodes(nodes) {
        this.put("uNodes", this.gl.RGB32F, this.gl.RGB, this.gl.FLOAT, 3, nodes);
    }

    // Set the first `n` sides, four nodes each. The array is kept and read until another one is set.
    putSides(sides, n) {
        this.sideNodes = sides;
        this.sideCount = n;
        this.fine = this.coarse = null;
        this.putWords("uSides", 4, sides.subarray(0, 4 * n));
    }
    // Set the colours of the sides, with flags in the highest byte.
    putColours(colours) {
        this.colours = colours;
        if (this.coarse) this.coarse.painted = false;
        this.putWords("uColours", 1, colours.subarray(0, this.sideCount));
    }
    putWords(name, channels, words) {
        const gl = this.gl,
            four = channels === 4;
        this.put(
            name,
            four ? gl.RGBA32UI : gl.R32UI,
            four ? gl.RGBA_INTEGER : gl.RED_INTEGER,
            gl.UNSIGNED_INT,
            channels,
            words,
        );
    }

    // --- skins: sides sorted into parts --------------------

    makeSkin(sides, n, textures) {
        const gl = this.gl,
            parts = new Parts(this.nodes, sides, n, this.closed);
        const indices = (this.buffers[textures.uSides] ??= gl.createBuffer());
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, indices);
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, parts.indices, gl.STATIC_DRAW);
        return { parts, textures, indices };
    }
    // All sides; they are sorted when first drawn.
    fineSkin() {
        this.fine ??= this.makeSkin(this.sideNodes, this.sideCount, kSideTextures);
        return this.fine;
    }
    // Coarser skins. Each has about a quarter of the sides of the previous one. Sides have colours but no
    // edges.
    coarseSkin(halvings) {
        if (this.coarse?.halvings !== halvings) {
            const { area, count } = this.fineSkin().parts;
            const found = coarsen(this.nodes, this.sideNodes, count, 2 ** halvings * Math.sqrt(area / count));
            this.putWords("coarse sides", 4, found.sides);
            this.coarse = {
                ...this.makeSkin(found.sides, found.from.length, kCoarseTextures),
                halvings,
                ...found,
            };
        }
        if (!this.coarse.painted) {
            const colours = Uint32Array.from(this.coarse.from, s => this.colours[s] | (kHiddenEdges << 24));
            this.putWords("coarse colours", 1, colours);
            this.coarse.painted = true;
        }
        return this.coarse;
    }

    // Set lines, three words each: two nodes, and a colour with twice the width in pixels in the highest
    // byte. `top`: drawn in front of everything.
    putLines(words, top = false) {
        const texels = new Uint32Array((4 * words.length) / 3);
        for (let i = 0; i < words.length / 3; i++)
            for (let k = 0; k < 3; k++) texels[4 * i + k] = words[3 * i + k];
        this.putWords(top ? "top" : "lines", 4, texels);
        if (top) this.topCount = words.length / 3;
        else this.lineCount = words.length / 3;
    }

    // Index buffer of two triangles for each of at least `n` quads; with four vertices,
    // each corner is looked up once.
    makeStrips(n) {
        const gl = this.gl,
            quads = 2 ** Math.ceil(Math.log2(n)),
            indices = new Uint32Array(6 * quads);
        for (let i = 0; i < quads; i++)
            indices.set([4 * i, 4 * i + 1, 4 * i + 2, 4 * i, 4 * i + 2, 4 * i + 3], 6 * i);
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.strips.buffer);
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
        this.strips.quads = quads;
    }

    // Draw the quads that `ranges` select in `indices`. `textures` maps each sampler of the program to the
    // name of its texture.
    draw(program, textures, indices, ranges, camera, size, more = {}) {
        const gl = this.gl,
            u = program.places;
        gl.useProgram(program.program);
        Object.entries(textures).forEach(([name, texture], unit) => {
            gl.activeTexture(gl.TEXTURE0 + unit);
            gl.bindTexture(gl.TEXTURE_2D, this.textures[texture]);
            gl.uniform1i(u[name], unit);
        });
        gl.uniformMatrix4fv(u.uMatrix, false, camera.matrix(size[0] / size[1]));
        if (u.uTurn) gl.uniformMatrix3fv(u.uTurn, false, camera.turnMatrix());
        if (u.uScale) gl.uniform1f(u.uScale, camera.scale);
        if (u.uSize) gl.uniform2f(u.uSize, size[0], size[1]);
        if (u.uHover) gl.uniform1i(u.uHover, textures === kSideTextures ? this.hover : -1);
        for (const [name, value] of Object.entries(more)) gl.uniform1f(u[name], value);
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, indices);
        for (const [first, n] of ranges) gl.drawElements(gl.TRIANGLES, 6 * n, gl.UNSIGNED_INT, 24 * first);
        gl.activeTexture(gl.TEXTURE0);
    }

    // Number of pixels of the window.
    size() {
        const ratio = window.devicePixelRatio || 1;
        const { clientWidth, clientHeight } = this.canvas;
        return [clientWidth, clientHeight].map(x => Math.max(1, Math.round(ratio * x)));
    }
    // Set the number of pixels of the canvas, which the browser scales to the window.
    fit(size) {
        const canvas = this.canvas,
            [width, height] = size;
        if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    }

    // Draw to the target `name` from now on; it is created with `size` if needed.
    into(name, size, samples, background) {
        const gl = this.gl;
        this.targets[name] ??= {
            frame: gl.createFramebuffer(),
            colour: gl.createRenderbuffer(),
            depth: gl.createRenderbuffer(),
            size: [0, 0],
        };
        const target = this.targets[name];
        gl.bindFramebuffer(gl.FRAMEBUFFER, target.frame);
        if (target.size[0] !== size[0] || target.size[1] !== size[1]) {
            for (const [buffer, format, at] of [
                [target.colour, gl.RGBA8, gl.COLOR_ATTACHMENT0],
                [target.depth, gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT],
            ]) {
                gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
                gl.renderbufferStorageMultisample(gl.RENDERBUFFER, samples, format, ...size);
                gl.framebufferRenderbuffer(gl.FRAMEBUFFER, at, gl.RENDERBUFFER, buffer);
            }
            target.size = size;
        }
        this.begin(size, background);
    }
    begin(size, background) {
        const gl = this.gl;
        gl.viewport(0, 0, ...size);
        gl.enable(gl.DEPTH_TEST);
        gl.depthFunc(gl.LEQUAL);
        if (background) {
            gl.clearColor(...background);
            gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        }
    }
    // Copy a target to the screen.
    show(name) {
        const gl = this.gl,
            { frame, size } = this.targets[name];
        this.fit(size);
        gl.bindFramebuffer(gl.READ_FRAMEBUFFER, frame);
        gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
        gl.blitFramebuffer(0, 0, ...size, 0, 0, ...size, gl.COLOR_BUFFER_BIT, gl.NEAREST);
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    }
    // Wait until drawing has finished.
    finish() {
        const gl = this.gl;
        this.into("wait", [1, 1], 0, kBackground);
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    }

    drawSkin(skin, ranges, camera, size) {
        const gl = this.gl;
        if (this.closed) gl.enable(gl.CULL_FACE);
        this.draw(this.sides, skin.textures, skin.indices, ranges, camera, size, {
            uEdges: skin.from ? 0 : this.edges,
            uFlat: this.back,
        });
        gl.disable(gl.CULL_FACE);
    }
    drawLines(camera, size) {
        const gl = this.gl,
            ratio = window.devicePixelRatio || 1,
            pixels = [size[0] / ratio, size[1] / ratio];
        for (const [lines, n, nearer] of [
            ["lines", this.lineCount, 0.0008],
            ["top", this.topCount, 0],
        ]) {
            if (!n) continue;
            if (n > this.strips.quads) this.makeStrips(n);
            if (!nearer) gl.disable(gl.DEPTH_TEST);
            const textures = { uNodes: "uNodes", uLines: lines },
                all = [[0, n]];
            this.draw(this.lines, textures, this.strips.buffer, all, camera, pixels, { uNearer: nearer });
        }
    }

    // Draw. If a complete picture takes long, a moving one is drawn coarser, and a still one in pieces, one
    // piece in each frame. Returns whether the picture is, or will become, complete.
    render(camera, moving) {
        const size = this.size();
        this.asked++;
        this.whole = false;
        const skin = this.fineSkin();
        if (this.slow === null) {
            this.drawStill(camera, size, skin, [[0, Math.min(1, this.sideCount)]]); // compiles the programs
            this.finish();
            const start = performance.now();
            this.drawStill(camera, size, skin, skin.parts.seen(camera, size[0] / size[1]));
            this.finish();
            this.slow = performance.now() - start > kSlow;
            return true;
        }
        if (this.slow && moving) {
            this.drawMoving(camera, size);
            return false;
        }
        const ranges = skin.parts.seen(camera, size[0] / size[1]);
        if (this.slow && sidesIn(ranges) > kPiece) this.drawPieces(camera, size, skin, ranges, this.asked);
        else this.drawStill(camera, size, skin, ranges);
        return true;
    }
    drawStill(camera, size, skin, ranges) {
        this.into("still", size, 4, kBackground);
        this.drawSkin(skin, ranges, camera, size);
        this.drawLines(camera, size);
        this.show("still");
        this.whole = true;
    }
    async drawPieces(camera, size, skin, ranges, own) {
        let piece = [],
            background = kBackground;
        const draw = () => {
            this.into("still", size, 4, background);
            background = null;
            this.drawSkin(skin, piece, camera, size);
            piece = [];
        };
        for (const [first, n] of ranges)
            for (let at = first; at < first + n; at += kPiece) {
                piece.push([at, Math.min(kPiece, first + n - at)]);
                if (sidesIn(piece) < kPiece) continue;
                draw();
                this.finish();
                await new Promise(requestAnimationFrame);
                if (own !== this.asked) return;
            }
        draw();
        this.drawLines(camera, size);
        this.show("still");
        this.whole = true;
    }
    // Highlight the side under the pointer, instead of `before`. If a complete picture takes long, only these
    // two are drawn again; returns false if everything must be drawn.
    liftSide(camera, before) {
        if (!this.slow) return false;
        if (!this.whole) return true;
        const gl = this.gl,
            size = this.targets.still.size;
        for (const side of [before, this.hover]) {
            if (side < 0) continue;
            const v = 4 * side;
            gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.single);
            const corners = Uint32Array.of(v, v + 1, v + 2, v, v + 2, v + 3);
            gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, corners, gl.STREAM_DRAW);
            this.into("still", size, 4);
            this.drawSkin({ textures: kSideTextures, indices: this.single }, [[0, 1]], camera, size);
        }
        this.drawLines(camera, size);
        this.show("still");
        return true;
    }
    drawMoving(camera, size) {
        const share = Math.min(1, Math.sqrt(kMovingPixels / (size[0] * size[1]))),
            less = size.map(x => Math.max(1, Math.round(x * share))),
            aspect = size[0] / size[1];
        let skin = this.fineSkin(),
            ranges = skin.parts.seen(camera, aspect);
        const times = sidesIn(ranges) / kMovingSides;
        if (times > 1) {
            skin = this.coarseSkin(Math.ceil(Math.log2(times) / 2));
            ranges = skin.parts.seen(camera, aspect);
        }
        this.fit(less);
        this.gl.bindFramebuffer(this.gl.FRAMEBUFFER, null);
        this.begin(less, kBackground);
        this.drawSkin(skin, ranges, camera, less);
        this.drawLines(camera, size);
    }

    // The number of the side at each pixel of a picture of `size`, from 0; 2**32 - 1:
    // none. `only`: for a single pixel.
    shown(camera, size, only) {
        const gl = this.gl,
            area = only ? [...only, 1, 1] : [0, 0, ...size];
        this.into("picked", size, 0);
        if (only) {
            gl.enable(gl.SCISSOR_TEST);
            gl.scissor(...area);
        }
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        const skin = this.fineSkin(),
            window = [0, 1].flatMap(k => [area[k], area[k] + area[k + 2]].map(x => (2 * x) / size[k] - 1));
        const ranges = skin.parts.seen(camera, size[0] / size[1], window);
        this.draw(this.picking, kSideTextures, skin.indices, ranges, camera, size);
        gl.disable(gl.SCISSOR_TEST);
        const bytes = new Uint8Array(4 * area[2] * area[3]);
        gl.readPixels(...area, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        return new Uint32Array(bytes.buffer).map(id => id - 1);
    }

    // The side at a point of the window; -1: none.
    pick(camera, x, y) {
        const box = this.canvas.getBoundingClientRect();
        const size = [Math.max(1, Math.round(box.width)), Math.max(1, Math.round(box.height))];
        const at = [Math.floor(x - box.left), size[1] - 1 - Math.floor(y - box.top)];
        if (at[0] < 0 || at[1] < 0 || at[0] >= size[0] || at[1] >= size[1]) return -1;
        const found = this.shown(camera, size, at)[0];
        return found < this.sideCount ? found : -1;
    }
}
