"use strict";
/* The page: what the user does with the pointer, the keys and the panel. */

const element = id => document.getElementById(id);

function make(tag, text, parent, className = "") {
    const made = document.createElement(tag);
    made.textContent = text;
    made.className = className;
    parent.append(made);
    return made;
}

class Page {
    constructor() {
        const info = JSON.parse(element("scene").textContent);
        this.model = new Model(info);
        this.canvas = element("canvas");
        this.renderer = new Renderer(this.canvas, this.model);
        this.camera = new Camera(this.model);
        this.picked = null; // {element} or {node}
        this.fillPanel(info);
        this.listenToPanel();
        this.listenToPointer();
        this.listenToKeys();
        this.listenToGraphics();
        new ResizeObserver(() => this.resize()).observe(this.canvas);
        this.resize();
        this.camera.home();
        this.redraw();
    }

    /* --- drawing --- */

    resize() {
        this.canvas.width = Math.max(1, Math.round(this.canvas.clientWidth * devicePixelRatio));
        this.canvas.height = Math.max(1, Math.round(this.canvas.clientHeight * devicePixelRatio));
        this.camera.aspect = this.canvas.width / this.canvas.height;
        /* beside the panel, where there is room */
        const covered = element("panel").offsetWidth / this.canvas.clientWidth;
        this.camera.aside = covered < 0.4 ? covered : 0;
        this.redraw();
    }

    redraw() {
        if (this.waiting)
            return;
        this.waiting = true;
        requestAnimationFrame(() => {
            this.waiting = false;
            const { picked, model, camera } = this;
            const marked = !picked ? null
                : picked.node === undefined ? outlineOf(model, picked.element)
                : markOf(model, picked.node, camera.distance / 60);
            this.renderer.draw(camera, marked);
            element("needle").setAttribute("transform",
                `rotate(${camera.turn * 180 / Math.PI}) scale(1 ${0.3 + 0.7 * Math.sin(camera.rise)})`);
        });
    }

    /* --- the panel --- */

    fillPanel(info) {
        document.title = info.title;
        element("title").textContent = info.title;
        [info.height.title, ...info.colourings.map(c => c.title)].forEach((text, k) => {
            make("option", text, element("colouring")).value = k - 1;
        });
        element("colouring").value = info.start;
        info.meshes.forEach((mesh, k) => make("option", mesh.name, element("find-mesh")).value = k);
        element("find-mesh").hidden = info.meshes.length < 2;
        info.lines.filter(set => set.count).forEach(set => this.lineEntry(set));
        element("lines-label").hidden = !info.lines.some(set => set.count);
        this.setStretch(this.usualStretch());
        this.setColouring();
    }

    lineEntry(set) {
        const entry = make("div", "", element("lines-legend"), "entry");
        make("span", "", entry, "stroke").style.borderTop = `${set.width}px solid ${set.colour}`;
        make("span", set.text, entry);
    }

    setColouring() {
        const k = Number(element("colouring").value), legend = element("legend");
        this.renderer.colour(k < 0 ? null : k);
        legend.replaceChildren();
        if (k < 0) {
            this.rampLegend(legend);
        } else {
            const count = new Float64Array(this.model.info.colourings[k].classes.length);
            this.model.classes[k].forEach(c => { count[c]++; });
            this.model.info.colourings[k].classes.forEach((c, i) => {
                if (!count[i])
                    return;
                const entry = make("div", "", legend, "entry");
                make("span", "", entry, "swatch").style.background = c.colour;
                make("span", c.text, entry);
                make("span", count[i].toLocaleString("en").replaceAll(",", " "), entry, "count");
            });
        }
        this.redraw();
    }

    rampLegend(legend) {
        const { ramp, height } = this.model.info, [lo, hi] = height.range;
        const bar = make("div", "", legend);
        bar.id = "ramp";
        const canvas = make("canvas", "", bar), ticks = make("div", "", bar);
        ticks.id = "ramp-ticks";
        canvas.width = 1;
        canvas.height = 128;
        const context = canvas.getContext("2d");
        for (let y = 0; y < 128; y++) {
            context.fillStyle = `rgb(${rampColour(ramp, 1 - y / 127)})`;
            context.fillRect(0, y, 1, 1);
        }
        height.ticks.forEach(([value, text]) => {
            const part = hi > lo ? (value - lo) / (hi - lo) : 0.5;
            make("span", text, ticks).style.top = `${100 * (1 - part)}%`;
        });
    }

    /* The slider has a step for each of 1, 1.1 … 100 times, alike in ratio. */
    setStretch(stretch) {
        this.camera.stretch = stretch;
        element("stretch").value = 50 * Math.log10(stretch);
        element("stretch-value").textContent = `× ${Number(stretch.toPrecision(2))}`;
        this.redraw();
    }

    /* Relief of a fifteenth of a square as large as the mesh can be seen well. */
    usualStretch() {
        const [lo, hi] = this.model.info.height.range;
        const wanted = Math.sqrt(this.model.area()) / 15 / Math.max(hi - lo, 1e-9);
        return [20, 10, 5, 3, 2, 1].find(s => s <= wanted) ?? 1;
    }

    listenToPanel() {
        const { renderer, camera } = this;
        const act = (id, event, what) => element(id).addEventListener(event, e => {
            what(e);
            this.redraw();
        });
        renderer.wires = renderer.showLines = true;
        act("colouring", "change", () => this.setColouring());
        act("wires", "change", e => { renderer.wires = e.target.checked; });
        act("lines", "change", e => { renderer.showLines = e.target.checked; });
        act("stretch", "input", e => {
            const before = camera.stretch;
            this.setStretch(10 ** (e.target.value / 50));
            camera.target[2] *= camera.stretch / before;
        });
        act("home", "click", () => camera.home());
        act("top", "click", () => camera.top());
        act("north", "click", () => { camera.turn = 0; });
        act("find", "submit", e => {
            e.preventDefault();
            this.find();
        });
    }

    find() {
        const kind = element("find-kind").value;
        const mesh = this.model.info.meshes[element("find-mesh").value || 0];
        const text = element("find-number").value.trim();
        const k = /^[0-9]+$/.test(text) ? this.model.find(kind, mesh, Number(text)) : -1;
        if (k < 0)
            this.show({ title: `No ${kind} ${text}`, rows: [] }, null);
        else
            this.goTo({ [kind]: k });
    }

    /* Show a node or an element, and bring it before the eye. */
    goTo(picked) {
        const { model, camera } = this;
        const nodes = picked.node === undefined
            ? Array.from(model.cornersOf(model.rank[picked.element])) : [picked.node];
        const places = nodes.map(node => model.placeOf(node));
        const middle = [0, 1, 2].map(c => places.reduce((sum, p) => sum + p[c], 0) / places.length);
        camera.target = [middle[0], middle[1], middle[2] * camera.stretch];
        camera.distance = Math.min(camera.distance, 0.2 * camera.wholeDistance());
        this.pick(picked);
    }

    /* --- what is picked --- */

    pick(picked) {
        const { model } = this;
        this.show(picked.node === undefined ? elementRows(model, picked.element)
                                            : nodeRows(model, picked.node), picked);
    }

    show({ title, rows }, picked) {
        this.picked = picked;
        element("picked").hidden = false;
        element("picked-title").textContent = title;
        element("picked-rows").replaceChildren();
        for (const [name, value] of rows) {
            const row = make("tr", "", element("picked-rows"));
            make("td", name, row);
            const cell = make("td", Array.isArray(value) ? "" : value, row);
            if (Array.isArray(value))
                value.forEach(({ node, text }) => {
                    make("a", text, cell).addEventListener("click", () => this.pick({ node }));
                    cell.append(" ");
                });
        }
        this.redraw();
    }

    hide() {
        this.picked = null;
        element("picked").hidden = true;
        this.redraw();
    }

    /* The corner within eight pixels of a place on the canvas, else the element there. */
    pickAt(x, y) {
        const { model, canvas, camera } = this, scale = devicePixelRatio;
        const k = this.renderer.elementAt(camera, Math.floor(x * scale),
                                          canvas.height - 1 - Math.floor(y * scale));
        if (k < 0)
            return this.hide();
        let nearest = null, least = 8;
        for (const node of model.cornersOf(model.rank[k])) {
            const at = camera.project(model.placeOf(node));
            if (!at)
                continue;
            const distance = Math.hypot((at[0] + 1) / 2 * canvas.clientWidth - x,
                                        (1 - at[1]) / 2 * canvas.clientHeight - y);
            if (distance < least)
                [nearest, least] = [node, distance];
        }
        this.pick(nearest === null ? { element: k } : { node: nearest });
    }

    /* --- the pointer --- */

    listenToPointer() {
        const { canvas } = this, down = new Map();
        let moved = 0;
        canvas.addEventListener("contextmenu", e => e.preventDefault());
        canvas.addEventListener("pointerdown", e => {
            canvas.setPointerCapture(e.pointerId);
            if (down.size === 0)
                moved = 0;
            down.set(e.pointerId, { x: e.clientX, y: e.clientY });
            canvas.classList.add("turning");
        });
        canvas.addEventListener("pointermove", e => {
            const from = down.get(e.pointerId);
            if (!from)
                return;
            const others = [...down.entries()].filter(([id]) => id !== e.pointerId).map(([, p]) => p);
            moved += Math.abs(e.clientX - from.x) + Math.abs(e.clientY - from.y);
            down.set(e.pointerId, { x: e.clientX, y: e.clientY });
            if (moved > 4)
                this.drag(from, { x: e.clientX, y: e.clientY }, others[0],
                          e.shiftKey || e.buttons === 2 || e.buttons === 4);
        });
        const up = e => {
            down.delete(e.pointerId);
            if (down.size === 0)
                canvas.classList.remove("turning");
            if (e.type === "pointerup" && e.button === 0 && moved <= 4)
                this.pickAt(e.clientX, e.clientY);
        };
        canvas.addEventListener("pointerup", up);
        canvas.addEventListener("pointercancel", up);
        canvas.addEventListener("wheel", e => {
            e.preventDefault();
            this.zoomAt(Math.exp(Math.max(-300, Math.min(300, e.deltaY)) * 0.0015 *
                                 (e.deltaMode === 1 ? 20 : 1)), e.clientX, e.clientY);
        }, { passive: false });
    }

    /* One pointer turns, or moves the target; two move and zoom. */
    drag(from, to, other, moves) {
        const high = this.canvas.clientHeight;
        const x = (to.x - from.x) / high, y = (to.y - from.y) / high;
        if (other) {
            const before = Math.hypot(from.x - other.x, from.y - other.y);
            const after = Math.hypot(to.x - other.x, to.y - other.y);
            this.camera.shift(x / 2, -y / 2);
            this.zoomAt(before / Math.max(after, 1), (to.x + other.x) / 2, (to.y + other.y) / 2);
        } else if (moves) {
            this.camera.shift(x, -y);
        } else {
            this.camera.rotate(-4 * x, 3 * y);
        }
        this.redraw();
    }

    zoomAt(factor, x, y) {
        const { canvas, camera } = this;
        camera.zoom(factor, 2 * x / canvas.clientWidth - 1, 1 - 2 * y / canvas.clientHeight);
        this.redraw();
    }

    listenToKeys() {
        const keys = {
            ArrowLeft: c => c.rotate(0.1, 0), ArrowRight: c => c.rotate(-0.1, 0),
            ArrowUp: c => c.rotate(0, 0.1), ArrowDown: c => c.rotate(0, -0.1),
            "+": c => c.zoom(0.8, 0, 0), "-": c => c.zoom(1.25, 0, 0),
            n: c => { c.turn = 0; }, t: c => c.top(), Home: c => c.home() };
        this.canvas.addEventListener("keydown", e => {
            if (e.key === "Escape")
                this.hide();
            if (!keys[e.key] || e.ctrlKey || e.altKey || e.metaKey)
                return;
            e.preventDefault();
            keys[e.key](this.camera);
            this.redraw();
        });
    }

    /* After sleep, or when short of memory, browsers take the graphics away, and may give them back. */
    listenToGraphics() {
        this.canvas.addEventListener("webglcontextlost", e => {
            e.preventDefault(); // else they never come back
            fail("The browser has taken the graphics away. If they do not come back, load the page again.");
        });
        this.canvas.addEventListener("webglcontextrestored", () => {
            element("failure").hidden = true;
            this.renderer.load();
            this.setColouring();
        });
    }
}

function fail(text) {
    element("failure").hidden = false;
    element("failure").textContent = text;
}

try {
    new Page();
} catch (failure) {
    fail(failure.message);
}
