"use strict";
/* The scene as the page holds it: numbers of variable length (seven bits a byte, the lowest first,
 * the eighth bit: more follows; signed ones as 2n or -2n-1), in base64. scene.c writes them. */

class Numbers {
    constructor(id) {
        this.bytes = Numbers.base64(document.getElementById("data-" + id).textContent);
        this.at = 0;
    }

    static base64(text) {
        const value = new Uint8Array(128);
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/".split("")
            .forEach((letter, k) => { value[letter.charCodeAt(0)] = k; });
        const padding = text.endsWith("==") ? 2 : text.endsWith("=") ? 1 : 0;
        const bytes = new Uint8Array(text.length / 4 * 3);
        for (let i = 0, k = 0; i < text.length; i += 4) {
            const four = value[text.charCodeAt(i)] << 18 | value[text.charCodeAt(i + 1)] << 12 |
                value[text.charCodeAt(i + 2)] << 6 | value[text.charCodeAt(i + 3)];
            bytes[k++] = four >> 16;
            bytes[k++] = four >> 8 & 255;
            bytes[k++] = four & 255;
        }
        return bytes.subarray(0, bytes.length - padding);
    }

    get more() {
        return this.at < this.bytes.length;
    }

    unsigned() {
        let v = 0, power = 1;
        for (;;) {
            if (!this.more)
                throw new Error("The page is not whole.");
            const byte = this.bytes[this.at++];
            v += (byte & 127) * power; // not by shifts: some exceed 32 bits
            if (byte < 128)
                return v;
            power *= 128;
        }
    }

    signed() {
        const v = this.unsigned();
        return v % 2 ? -(v + 1) / 2 : v / 2;
    }

    /* Fill an array from runs: a value and how often it comes. */
    runs(array) {
        for (let k = 0; k < array.length;) {
            const value = this.unsigned(), end = k + this.unsigned();
            array.fill(value, k, end);
            k = end;
        }
        return array;
    }

    /* Ascending numbers from runs: how many are left out, how many come. */
    ascending(array, from, to) {
        for (let k = from, number = 0; k < to;) {
            number += this.unsigned();
            for (let n = this.unsigned(); n > 0; n--)
                array[k++] = number++;
        }
    }
}

class Model {
    constructor(info) {
        this.info = info;
        const count = kind => info.meshes.reduce((sum, mesh) => sum + mesh[kind], 0);
        this.nodes = count("nodes");
        this.elements = count("elements");
        this.readNodes();
        this.readElements();
        this.readNumbers();
        this.readResiduals();
        this.readLines();
        this.classes = info.colourings.map((colouring, k) =>
            new Numbers("classes-" + k).runs(new Uint16Array(this.elements)));
    }

    /* Places in steps from the origin, exact, and about the middle in single precision. */
    readNodes() {
        const numbers = new Numbers("nodes"), last = [0, 0, 0];
        this.steps = new Int32Array(3 * this.nodes);
        for (let k = 0; k < this.steps.length; k++)
            this.steps[k] = last[k % 3] += numbers.signed();
        const least = [Infinity, Infinity, Infinity], most = [-Infinity, -Infinity, -Infinity];
        for (let k = 0; k < this.steps.length; k++) {
            least[k % 3] = Math.min(least[k % 3], this.steps[k]);
            most[k % 3] = Math.max(most[k % 3], this.steps[k]);
        }
        const step = this.info.step;
        this.middle = least.map((v, c) => (v + most[c]) / 2);
        this.size = least.map((v, c) => (most[c] - v) * step[c]);
        this.places = new Float32Array(3 * this.nodes);
        for (let k = 0; k < this.places.length; k++)
            this.places[k] = (this.steps[k] - this.middle[k % 3]) * step[k % 3];
        const marks = new Numbers("marks");
        this.flags = marks.runs(new Uint32Array(this.nodes));
        this.owners = marks.runs(new Uint32Array(this.nodes));
    }

    /* Four corners an element, in the order in which they are drawn: triangles first. */
    readElements() {
        const n = this.elements;
        const corners = new Numbers("corners").runs(new Uint8Array(n));
        this.triangles = corners.reduce((sum, c) => sum + (c === 3), 0);
        this.corners = new Uint32Array(4 * n);
        this.rank = new Uint32Array(n); // of an element among those drawn
        this.drawn = new Uint32Array(n); // and the reverse
        const numbers = new Numbers("elements");
        for (let k = 0, first = 0, t = 0, q = this.triangles; k < n; k++) {
            const rank = corners[k] === 3 ? t++ : q++;
            this.rank[k] = rank;
            this.drawn[rank] = k;
            this.corners[4 * rank] = first += numbers.signed();
            for (let c = 1; c < corners[k]; c++)
                this.corners[4 * rank + c] = first + numbers.signed();
        }
    }

    /* What nodes and elements are called in the streams that they come from. */
    readNumbers() {
        const numbers = new Numbers("numbers");
        this.nodeNumber = new Uint32Array(this.nodes);
        this.elementNumber = new Uint32Array(this.elements);
        let node = 0, element = 0;
        for (const mesh of this.info.meshes) {
            mesh.firstNode = node;
            mesh.firstElement = element;
            numbers.ascending(this.nodeNumber, node, node += mesh.nodes);
            numbers.ascending(this.elementNumber, element, element += mesh.elements);
        }
    }

    /* For elements with measurements: how many, the root mean square and the worst, in steps. */
    readResiduals() {
        const numbers = new Numbers("residuals");
        this.residuals = new Map();
        for (let k = 0; numbers.more;) {
            k += numbers.unsigned();
            this.residuals.set(k, { n: numbers.unsigned(), rms: numbers.unsigned() * 1e-4,
                                    worst: numbers.signed() * 1e-4 });
        }
    }

    /* Pieces of lines: six coordinates each. */
    readLines() {
        const numbers = new Numbers("lines"), last = [0, 0, 0];
        this.lines = this.info.lines.map(set => {
            const pieces = [];
            for (let l = 0; l < set.count; l++) {
                let before = null;
                for (let n = numbers.unsigned(); n > 0; n--) {
                    const here = last.map((v, c) =>
                        ((last[c] = v + numbers.signed()) - this.middle[c]) * this.info.step[c]);
                    if (before)
                        pieces.push(...before, ...here);
                    before = here;
                }
            }
            return new Float32Array(pieces);
        });
    }

    cornersOf(rank) {
        return this.corners.slice(4 * rank, 4 * rank + (rank < this.triangles ? 3 : 4));
    }

    placeOf(node) {
        return Array.from(this.places.subarray(3 * node, 3 * node + 3));
    }

    /* Of all elements in the plane. */
    area() {
        let sum = 0;
        const p = this.places, n = this.corners;
        for (let k = 0; k < this.elements; k++) {
            const a = 3 * n[4 * k];
            const edge = (c, axis) => p[3 * n[4 * k + c] + axis] - p[a + axis];
            const cross = (b, c) => edge(b, 0) * edge(c, 1) - edge(c, 0) * edge(b, 1);
            sum += Math.abs(cross(1, 2)) + (k < this.triangles ? 0 : Math.abs(cross(2, 3)));
        }
        return sum / 2;
    }

    /* The mesh that holds a node or an element. */
    meshOf(first, k) {
        return this.info.meshes.findLast(mesh => mesh[first] <= k);
    }

    /* The node or element of that number in a mesh, or -1. */
    find(kind, mesh, number) {
        const [names, first, count] = kind === "node"
            ? [this.nodeNumber, mesh.firstNode, mesh.nodes]
            : [this.elementNumber, mesh.firstElement, mesh.elements];
        const k = names.subarray(first, first + count).indexOf(number);
        return k < 0 ? -1 : first + k;
    }
}
