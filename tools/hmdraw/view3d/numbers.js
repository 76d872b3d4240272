"use strict";
/* What the page says about an element or a node: rows of a name and a text, where a text may be a
 * list of elements or nodes to go to. */

const FLAGS = ["boundary", "breakline", "fixed"]; // bits 1, 2, 4 of hybridmesh(5)

/* Digits behind the point that tell multiples of a step apart. */
function digitsOf(step) {
    return Math.max(0, Math.round(-Math.log10(step)));
}

function coordinate(model, node, c) {
    const { origin, step } = model.info;
    return (origin[c] + model.steps[3 * node + c] * step[c]).toFixed(digitsOf(step[c]));
}

/* Of the corners as places: area in the plane, smallest angle there, steepness of the plane through
 * three corners (a quadrilateral's diagonals). */
function measures(places) {
    const n = places.length;
    let area = 0, least = 180;
    places.forEach((p, k) => {
        const q = places[(k + 1) % n], o = places[(k + n - 1) % n];
        area += (p[0] - places[0][0]) * (q[1] - places[0][1]) -
                (q[0] - places[0][0]) * (p[1] - places[0][1]);
        const a = [q[0] - p[0], q[1] - p[1]], b = [o[0] - p[0], o[1] - p[1]];
        const angle = Math.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
        least = Math.min(least, (angle < 0 ? angle + 2 * Math.PI : angle) * 180 / Math.PI);
    });
    const far = n - 1;
    const u = [0, 1, 2].map(c => places[n - 2][c] - places[0][c]);
    const v = [0, 1, 2].map(c => places[far][c] - places[far === 3 ? 1 : 0][c]);
    const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const slope = Math.atan2(Math.hypot(normal[0], normal[1]), Math.abs(normal[2])) * 180 / Math.PI;
    return { area: area / 2, least, slope };
}

function nameOf(mesh, model) {
    return model.info.meshes.length > 1 ? " of " + mesh.name : "";
}

function elementRows(model, k) {
    const { unit, colourings: [material] } = model.info;
    const corners = model.cornersOf(model.rank[k]);
    const { area, least, slope } = measures(Array.from(corners, node => model.placeOf(node)));
    const rows = [
        ["material", material.classes[model.classes[0][k]].text],
        ["nodes", Array.from(corners, node => ({ node, text: model.nodeNumber[node] }))],
        ["heights", Array.from(corners, node => coordinate(model, node, 2)).join("  ")],
        ["area", area.toPrecision(4) + " " + unit + "²"],
        ["smallest angle", least.toFixed(1) + "°"],
        ["slope", slope.toFixed(1) + "°"]];
    const residual = model.residuals.get(k);
    if (residual)
        rows.push(["measurements", String(residual.n)],
                  ["residual, RMS", residual.rms.toFixed(3) + " " + unit],
                  ["worst", residual.worst.toFixed(3) + " " + unit]);
    const mesh = model.meshOf("firstElement", k);
    return { title: "Element " + model.elementNumber[k] + nameOf(mesh, model), rows };
}

function nodeRows(model, k) {
    const flags = FLAGS.filter((name, bit) => model.flags[k] >> bit & 1);
    const mesh = model.meshOf("firstNode", k), owner = model.owners[k];
    const rows = ["x", "y", "z"].map((name, c) =>
        [name, coordinate(model, k, c) + " " + model.info.unit]);
    rows.push(["flags", flags.join(", ") || "none"]);
    if (owner > 0)
        rows.push(["regular mesh", mesh.owners.split(/\s+/)[owner - 1] || String(owner)]);
    return { title: "Node " + model.nodeNumber[k] + nameOf(mesh, model), rows };
}

/* Pieces of lines around an element, or a diamond about a node, `size` across. */
function outlineOf(model, element) {
    const places = Array.from(model.cornersOf(model.rank[element]), node => model.placeOf(node));
    return new Float32Array(places.flatMap((p, k) => [...p, ...places[(k + 1) % places.length]]));
}

function markOf(model, node, size) {
    const [x, y, z] = model.placeOf(node), r = size / 2;
    const rim = [[x - r, y, z], [x, y - r, z], [x + r, y, z], [x, y + r, z]];
    return new Float32Array(rim.flatMap((p, k) => [...p, ...rim[(k + 1) % 4]]));
}
