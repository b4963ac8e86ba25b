// SPDX-License-Identifier: MIT
"use strict";

// Drawing by WebGL 2 alone. Nodes lie in a texture, and so do the sides that are drawn, a quad or triangle
// each: four numbers of nodes, and a colour. Vertices look up what they need by their number. Instances could
// do the same, but take 20 µs each where the browser has no graphics card.

const kRow = 2048; // texels a row of a texture
const kHiddenEdges = 15,
    kHatched = 16,
    kFaint = 32; // flags of a side; the first four bits: edge k is not drawn

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
// How far a corner is from each edge; edge k runs from corner k to the next.
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
  vec4 width = fwidth(vEdge);
  float line = 0.0;
  for (int k = 0; k < 4; ++k) {
    if ((flags >> uint(k) & 1u) != 0u) continue;
    float apart = vEdge[k] / max(width[k], 1e-6);
    float shown = (1.0 - smoothstep(0.1, 0.95, apart)) * (1.0 - smoothstep(0.12, 0.45, width[k]));
    line = max(line, shown);
  }
  colour = mix(colour, vec3(0.08, 0.11, 0.15), line * uEdges);
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

class Drawing {
    constructor(canvas, nodes) {
        const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: false });
        if (!gl) throw new Error("This page needs WebGL 2, which the browser does not offer here.");
        this.gl = gl;
        this.canvas = canvas;
        this.sides = this.program(kSideVertex, kSideFragment);
        this.picking = this.program(kSideVertex, kPickFragment);
        this.lines = this.program(kLineVertex, kLineFragment);
        this.textures = {};
        this.indices = gl.createBuffer();
        this.indexCount = 0;
        this.closed = false; // skins that are closed and face outward hide what faces away
        this.sideCount = this.lineCount = this.topCount = 0;
        this.hover = -1;
        this.edges = 0.7;
        this.back = 0.8;
        this.putNodes(nodes);
        this.makeTarget();
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

    // Put `values`, `channels` of them a texel, into the texture `name`.
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

    makeTarget() {
        const gl = this.gl;
        this.target = gl.createFramebuffer();
        this.targetColour = gl.createRenderbuffer();
        this.targetDepth = gl.createRenderbuffer();
        this.targetSize = [0, 0];
    }

    // The first `n` sides: four nodes of each.
    putSides(nodes, n) {
        const gl = this.gl;
        this.put("uSides", gl.RGBA32UI, gl.RGBA_INTEGER, gl.UNSIGNED_INT, 4, nodes.subarray(0, 4 * n));
        this.sideCount = n;
    }
    // Their colours, flags in the highest byte.
    putColours(colours) {
        const gl = this.gl;
        this.put(
            "uColours",
            gl.R32UI,
            gl.RED_INTEGER,
            gl.UNSIGNED_INT,
            1,
            colours.subarray(0, this.sideCount),
        );
    }

    // Words of lines: two nodes, a colour whose highest byte is twice the width in pixels. `top`: over all.
    putLines(words, top = false) {
        const gl = this.gl,
            texels = new Uint32Array((4 * words.length) / 3);
        for (let i = 0; i < words.length / 3; i++)
            for (let k = 0; k < 3; k++) texels[4 * i + k] = words[3 * i + k];
        this.put(top ? "top" : "lines", gl.RGBA32UI, gl.RGBA_INTEGER, gl.UNSIGNED_INT, 4, texels);
        if (top) this.topCount = words.length / 3;
        else this.lineCount = words.length / 3;
    }

    // Two triangles for each of `n` quads and more: four vertices, so that a corner is looked up once.
    makeIndices(n) {
        const gl = this.gl,
            quads = 2 ** Math.ceil(Math.log2(n)),
            indices = new Uint32Array(6 * quads);
        for (let i = 0; i < quads; i++)
            indices.set([4 * i, 4 * i + 1, 4 * i + 2, 4 * i, 4 * i + 2, 4 * i + 3], 6 * i);
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.indices);
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
        this.indexCount = indices.length;
    }

    // Draw `n` quads by a program that looks them up in `textures`, by the names of its uniforms.
    draw(program, textures, n, camera, size, more = {}) {
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
        if (u.uHover) gl.uniform1i(u.uHover, this.hover);
        for (const [name, value] of Object.entries(more)) gl.uniform1f(u[name], value);
        if (6 * n > this.indexCount) this.makeIndices(n);
        gl.drawElements(gl.TRIANGLES, 6 * n, gl.UNSIGNED_INT, 0);
        gl.activeTexture(gl.TEXTURE0);
    }

    fit() {
        const ratio = window.devicePixelRatio || 1,
            canvas = this.canvas;
        const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
        const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
        if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
        return [width, height];
    }

    render(camera) {
        const gl = this.gl,
            size = this.fit();
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        gl.viewport(0, 0, ...size);
        gl.clearColor(0.965, 0.969, 0.976, 1);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        gl.enable(gl.DEPTH_TEST);
        gl.depthFunc(gl.LEQUAL);
        if (this.closed) gl.enable(gl.CULL_FACE);
        this.draw(this.sides, kSideTextures, this.sideCount, camera, size, {
            uEdges: this.edges,
            uFlat: this.back,
        });
        gl.disable(gl.CULL_FACE);
        const ratio = window.devicePixelRatio || 1,
            pixels = [size[0] / ratio, size[1] / ratio];
        if (this.lineCount)
            this.draw(this.lines, { uNodes: "uNodes", uLines: "lines" }, this.lineCount, camera, pixels, {
                uNearer: 0.0008,
            });
        if (this.topCount) {
            gl.disable(gl.DEPTH_TEST);
            this.draw(this.lines, { uNodes: "uNodes", uLines: "top" }, this.topCount, camera, pixels, {
                uNearer: 0,
            });
        }
    }

    // Which side each pixel of a picture of `size` shows, from 0; 2**32 - 1: none. `only`: a single pixel.
    shown(camera, size, only) {
        const gl = this.gl;
        gl.bindFramebuffer(gl.FRAMEBUFFER, this.target);
        if (this.targetSize[0] !== size[0] || this.targetSize[1] !== size[1]) {
            for (const [buffer, format, at] of [
                [this.targetColour, gl.RGBA8, gl.COLOR_ATTACHMENT0],
                [this.targetDepth, gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT],
            ]) {
                gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
                gl.renderbufferStorage(gl.RENDERBUFFER, format, ...size);
                gl.framebufferRenderbuffer(gl.FRAMEBUFFER, at, gl.RENDERBUFFER, buffer);
            }
            this.targetSize = size;
        }
        gl.viewport(0, 0, ...size);
        if (only) {
            gl.enable(gl.SCISSOR_TEST);
            gl.scissor(only[0], only[1], 1, 1);
        }
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        gl.enable(gl.DEPTH_TEST);
        this.draw(this.picking, kSideTextures, this.sideCount, camera, size);
        gl.disable(gl.SCISSOR_TEST);
        const area = only ? [...only, 1, 1] : [0, 0, ...size];
        const bytes = new Uint8Array(4 * area[2] * area[3]);
        gl.readPixels(...area, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        return new Uint32Array(bytes.buffer).map(id => id - 1);
    }

    // The side under a place of the window; -1: none.
    pick(camera, x, y) {
        const box = this.canvas.getBoundingClientRect();
        const size = [Math.max(1, Math.round(box.width)), Math.max(1, Math.round(box.height))];
        const at = [Math.floor(x - box.left), size[1] - 1 - Math.floor(y - box.top)];
        if (at[0] < 0 || at[1] < 0 || at[0] >= size[0] || at[1] >= size[1]) return -1;
        const found = this.shown(camera, size, at)[0];
        return found < this.sideCount ? found : -1;
    }
}
