"use strict";
/* WebGL 2: the surface, lines over it, and which element lies under a pixel. */

const TEXTURE_WIDTH = 2048; // as in mesh.vert

class Renderer {
    constructor(canvas, model) {
        const gl = canvas.getContext("webgl2", { antialias: true });
        if (!gl)
            throw new Error("This browser does not show WebGL 2, which the view needs.");
        this.gl = gl;
        this.model = model;
        this.load();
    }

    /* What the graphics hold: again, when they have lost it. */
    load() {
        const { gl, model } = this;
        this.mesh = this.program("mesh.vert", "mesh.frag");
        this.pick = this.program("mesh.vert", "pick.frag");
        this.line = this.program("line.vert", "line.frag");
        this.textures = [
            this.table(gl.RGB32F, gl.RGB, gl.FLOAT, model.places, 3),
            this.table(gl.RGBA32UI, gl.RGBA_INTEGER, gl.UNSIGNED_INT, model.corners, 4),
            gl.createTexture(), // colours of elements
            this.ramp(model.info.ramp)];
        this.nothing = gl.createVertexArray();
        this.lines = model.lines.map(pieces => this.pieces(pieces));
        gl.enable(gl.DEPTH_TEST);
        gl.clearColor(1, 1, 1, 1);
    }

    program(vertex, fragment) {
        const gl = this.gl, program = gl.createProgram();
        for (const [kind, id] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
            const shader = gl.createShader(kind);
            gl.shaderSource(shader, document.getElementById(id).textContent.trim());
            gl.compileShader(shader);
            gl.attachShader(program, shader);
            if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS))
                throw new Error(id + ": " + gl.getShaderInfoLog(shader));
        }
        gl.linkProgram(program);
        if (!gl.getProgramParameter(program, gl.LINK_STATUS))
            throw new Error(gl.getProgramInfoLog(program));
        const at = {};
        for (let k = 0; k < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); k++) {
            const { name } = gl.getActiveUniform(program, k);
            at[name] = gl.getUniformLocation(program, name);
        }
        return { program, at };
    }

    /* A texture as a table of items of so many numbers, TEXTURE_WIDTH a row. */
    table(inside, format, type, data, width, texture = this.gl.createTexture()) {
        const gl = this.gl, rows = Math.max(1, Math.ceil(data.length / width / TEXTURE_WIDTH));
        const whole = new data.constructor(rows * TEXTURE_WIDTH * width);
        whole.set(data);
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.texImage2D(gl.TEXTURE_2D, 0, inside, TEXTURE_WIDTH, rows, 0, format, type, whole);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
        return texture;
    }

    ramp(stops) {
        const gl = this.gl, texture = gl.createTexture(), n = 256;
        const bytes = new Uint8Array(4 * n);
        for (let k = 0; k < n; k++)
            bytes.set([...rampColour(stops, k / (n - 1)), 255], 4 * k);
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, n, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
        return texture;
    }

    /* Pieces of lines as instances. */
    pieces(places) {
        const gl = this.gl, array = gl.createVertexArray();
        const buffer = gl.createBuffer();
        gl.bindVertexArray(array);
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.bufferData(gl.ARRAY_BUFFER, places, gl.STATIC_DRAW);
        ["from", "to"].forEach((name, k) => {
            const at = gl.getAttribLocation(this.line.program, name);
            gl.enableVertexAttribArray(at);
            gl.vertexAttribPointer(at, 3, gl.FLOAT, false, 24, 12 * k);
            gl.vertexAttribDivisor(at, 1);
        });
        gl.bindVertexArray(null);
        return { array, buffer, n: places.length / 6 };
    }

    dropPieces(pieces) {
        this.gl.deleteVertexArray(pieces.array);
        this.gl.deleteBuffer(pieces.buffer);
    }

    /* Colour elements by their classes; null: by height. */
    colour(colouring) {
        const gl = this.gl, model = this.model;
        this.byHeight = colouring === null;
        if (this.byHeight)
            return;
        const palette = model.info.colourings[colouring].classes.map(c => hexColour(c.colour));
        const bytes = new Uint8Array(4 * model.elements);
        for (let k = 0; k < model.elements; k++)
            bytes.set(palette[model.classes[colouring][k]], 4 * model.rank[k]);
        this.table(gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, bytes, 4, this.textures[2]);
    }

    drawMesh(program, camera) {
        const gl = this.gl, model = this.model, { at } = program;
        gl.useProgram(program.program);
        this.textures.forEach((texture, k) => {
            gl.activeTexture(gl.TEXTURE0 + k);
            gl.bindTexture(gl.TEXTURE_2D, texture);
        });
        ["nodes", "elements", "colours", "ramp"].forEach((name, k) => gl.uniform1i(at[name], k));
        gl.uniform1i(at.triangles, model.triangles);
        gl.uniformMatrix4fv(at.camera, false, camera.matrix());
        gl.uniform1f(at.stretch, camera.stretch);
        gl.uniform1i(at.by_height, this.byHeight);
        const heights = model.info.height.range.map(z => this.heightAboutMiddle(z));
        gl.uniform2f(at.range, heights[0], Math.max(heights[1], heights[0] + 1e-6));
        gl.uniform1f(at.wires, this.wires ? 1 : 0);
        gl.bindVertexArray(this.nothing);
        gl.drawArrays(gl.TRIANGLES, 0, 3 * (2 * model.elements - model.triangles));
    }

    heightAboutMiddle(z) {
        const { origin, step } = this.model.info;
        return z - origin[2] - this.model.middle[2] * step[2];
    }

    drawLines(camera, lines, colour, width) {
        const gl = this.gl, { program, at } = this.line;
        gl.useProgram(program);
        gl.uniformMatrix4fv(at.camera, false, camera.matrix());
        gl.uniform1f(at.stretch, camera.stretch);
        gl.uniform2f(at.screen, gl.drawingBufferWidth, gl.drawingBufferHeight);
        gl.uniform1f(at.width, width * devicePixelRatio);
        gl.uniform3fv(at.line_colour, hexColour(colour).slice(0, 3).map(v => v / 255));
        gl.bindVertexArray(lines.array);
        gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, lines.n);
    }

    /* `marked`: pieces around what is picked, or null. */
    draw(camera, marked) {
        const gl = this.gl;
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        this.drawMesh(this.mesh, camera);
        if (this.showLines)
            this.model.info.lines.forEach((set, k) =>
                this.drawLines(camera, this.lines[k], set.colour, set.width));
        if (marked) {
            const lines = this.pieces(marked);
            gl.disable(gl.DEPTH_TEST);
            this.drawLines(camera, lines, "#ffffff", 5);
            this.drawLines(camera, lines, "#c2007a", 2.5);
            gl.enable(gl.DEPTH_TEST);
            this.dropPieces(lines);
        }
    }

    /* The element drawn at a pixel of the screen, counted from below; -1 for none. */
    elementAt(camera, x, y) {
        const gl = this.gl, width = gl.drawingBufferWidth, height = gl.drawingBufferHeight;
        const frame = gl.createFramebuffer();
        const buffers = [[gl.COLOR_ATTACHMENT0, gl.RGBA8], [gl.DEPTH_ATTACHMENT, gl.DEPTH_COMPONENT24]];
        gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
        const made = buffers.map(([attachment, format]) => {
            const buffer = gl.createRenderbuffer();
            gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
            gl.renderbufferStorage(gl.RENDERBUFFER, format, width, height);
            gl.framebufferRenderbuffer(gl.FRAMEBUFFER, attachment, gl.RENDERBUFFER, buffer);
            return buffer;
        });
        gl.viewport(0, 0, width, height);
        gl.enable(gl.SCISSOR_TEST);
        gl.scissor(x, y, 1, 1);
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        this.drawMesh(this.pick, camera);
        const pixel = new Uint8Array(4);
        gl.readPixels(x, y, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
        gl.disable(gl.SCISSOR_TEST);
        gl.clearColor(1, 1, 1, 1);
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        gl.deleteFramebuffer(frame);
        made.forEach(buffer => gl.deleteRenderbuffer(buffer));
        const rank = new DataView(pixel.buffer).getUint32(0, true) - 1;
        return rank < 0 ? -1 : this.model.drawn[rank];
    }
}

/* "#rrggbb" as bytes, opaque. */
function hexColour(text) {
    const v = parseInt(text.slice(1), 16);
    return [v >> 16, v >> 8 & 255, v & 255, 255];
}

/* The colour of a ramp of hex colours at t, 0 .. 1. */
function rampColour(stops, t) {
    const place = Math.min(1, Math.max(0, t)) * (stops.length - 1);
    const k = Math.min(stops.length - 2, Math.floor(place));
    const a = hexColour(stops[k]), b = hexColour(stops[k + 1]);
    return [0, 1, 2].map(c => Math.round(a[c] + (place - k) * (b[c] - a[c])));
}
