"use strict";
/* The eye, which turns about a target. Lengths are those of the stretched scene; z is up. Matrices
 * are column by column, as WebGL wants them. */

class Camera {
    constructor(model) {
        this.model = model;
        this.angle = 0.5; // of view, radians, up and down
        this.aside = 0; // where the target lies on the screen, -1 .. 1 to the right
        this.stretch = 1;
        this.home();
    }

    /* The whole mesh from the south, a little from above. */
    home() {
        this.target = [0, 0, 0];
        this.turn = -0.35; // of the eye about the target, 0: in the south
        this.rise = 0.75; // of the eye over the plane, radians
        this.aspect = this.aspect || 1;
        this.distance = this.wholeDistance();
    }

    top() {
        this.turn = 0;
        this.rise = Math.PI / 2;
    }

    /* From where the box around the mesh, as turned now, fills the view. */
    wholeDistance() {
        const { right, up, back } = this.axes(), t = Math.tan(this.angle / 2);
        const wide = 0.95 * (1 - Math.abs(this.aside)) * t * this.aspect, high = 0.92 * t;
        let most = 1e-6;
        for (let corner = 0; corner < 8; corner++) {
            const p = this.model.size.map((v, c) =>
                (corner >> c & 1 ? v : -v) / 2 * (c === 2 ? this.stretch : 1));
            const along = way => way[0] * p[0] + way[1] * p[1] + way[2] * p[2];
            most = Math.max(most, along(back) + Math.abs(along(right)) / wide,
                            along(back) + Math.abs(along(up)) / high);
        }
        return most;
    }

    /* The eye's own directions: right, up, and back towards it. */
    axes() {
        const s = Math.sin(this.turn), c = Math.cos(this.turn);
        const sr = Math.sin(this.rise), cr = Math.cos(this.rise);
        return { right: [c, s, 0], up: [-s * sr, c * sr, cr], back: [s * cr, -c * cr, sr] };
    }

    matrix() {
        const { right, up, back } = this.axes();
        const eye = this.target.map((v, k) => v + back[k] * this.distance);
        const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        const f = 1 / Math.tan(this.angle / 2), near = this.distance / 50;
        const reach = this.distance + Math.hypot(...this.model.size) * this.stretch * 2;
        const far = reach * 2;
        const a = (far + near) / (near - far), b = 2 * far * near / (near - far);
        const rows = [[...right, -dot(right, eye)], [...up, -dot(up, eye)], [...back, -dot(back, eye)]];
        const p = [rows[0].map((v, k) => v * f / this.aspect - rows[2][k] * this.aside), rows[1].map(v => v * f),
                   rows[2].map((v, k) => a * v + (k === 3 ? b : 0)), rows[2].map(v => -v)];
        const m = new Float32Array(16);
        for (let column = 0; column < 4; column++)
            for (let row = 0; row < 4; row++)
                m[4 * column + row] = p[row][column];
        return m;
    }

    /* Where a place comes to lie: -1 .. 1 to the right and up; null behind the eye. */
    project(place) {
        const m = this.matrix(), v = [place[0], place[1], place[2] * this.stretch, 1];
        const to = row => v.reduce((sum, c, k) => sum + c * m[4 * k + row], 0);
        const w = to(3);
        return w > 0 ? [to(0) / w, to(1) / w] : null;
    }

    /* Turn by radians. */
    rotate(turn, rise) {
        this.turn += turn;
        this.rise = Math.min(Math.PI / 2, Math.max(0.03, this.rise + rise));
    }

    /* Move the target so that what it carries follows the pointer; x, y are parts of the height
     * of the view. */
    shift(x, y) {
        const { right, up } = this.axes();
        const reach = 2 * this.distance * Math.tan(this.angle / 2);
        for (let k = 0; k < 3; k++)
            this.target[k] -= (right[k] * x + up[k] * y) * reach;
    }

    /* Nearer (factor under 1) or farther, while what lies on the target's plane under the pointer,
     * at x, y within -1 .. 1, stays under it. */
    zoom(factor, x, y) {
        const { right, up, back } = this.axes(), t = Math.tan(this.angle / 2);
        const ray = back.map((v, k) => -v + right[k] * (x - this.aside) * t * this.aspect + up[k] * y * t);
        const least = 1e-5 * Math.hypot(...this.model.size);
        const most = 10 * this.wholeDistance();
        const distance = Math.min(most, Math.max(least, this.distance * factor));
        /* the ray meets the plane through the target that faces the eye */
        for (let k = 0; k < 3; k++)
            this.target[k] += (ray[k] + back[k]) * (this.distance - distance);
        this.distance = distance;
    }
}
