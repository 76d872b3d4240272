# How regular meshes came out: awk -v size="NAME CONTROL ALONG ACROSS NAME …" -f regular.awk breaklines.hm regular.hm
# Control: distance of control points along; along and across: of the elements asked for, m. Prints a line a
# surface: its name, the 95th percentile of the distance of its banks from the breaklines they were moved to in
# control distances (0 without such), the median edge ratio over the one asked for, and the part of its triangles, in %, whose
# smallest angle is under 0.8 atan(across / along): of meshes that are whole only outside sharp bends, in
# which a bank turns, over a control distance to either side, on a radius smaller than the river is wide there;
# of the surface `faced` without those at its cut. Last the part of the triangles that were counted for that, in %.
BEGIN {
    n = split(size, word)
    for (i = 1; i <= n; i += 4) {
        control[word[i]] = word[i + 1]
        along[word[i]] = word[i + 2]
        across[word[i]] = word[i + 3]
    }
    cell = 30
    degrees = 45 / atan2(1, 1)
}
/^#hm/ { kind = $3; nodes = 0; left = "" }
/^#name/ { begin($2) }
/^#end/ && kind == "mesh" { finish() }
/^#/ { next }
kind == "lines" && /^>/ { left = ""; next }
kind == "lines" {
    if (left != "")
        segment(left, below, $1, $2)
    left = $1; below = $2
    next
}
/^v/ { x[nodes] = $2; y[nodes] = $3; bank[nodes] = int($5 / 2) % 2
    cut[nodes] = $5 == 5 && faced == surface; nodes++ }
/^t/ { ta[triangles] = $2; tb[triangles] = $3; tc[triangles++] = $4 }

function segment(ax, ay, bx, by,    steps, i, place) { # into the cells that it passes, about
    steps = int(sqrt((bx - ax) ^ 2 + (by - ay) ^ 2) / cell * 2) + 1
    for (i = 0; i <= steps; i++) {
        place = int((ax + (bx - ax) * i / steps) / cell) "," int((ay + (by - ay) * i / steps) / cell)
        if (index(list[place], " " segments " ") == 0)
            list[place] = list[place] " " segments " "
    }
    sx[segments] = ax; sy[segments] = ay; ex[segments] = bx; ey[segments] = by
    segments++
}
function off(px, py,    best, i, j, k, m, one, s, dx, dy, t, d) { # from the nearest breakline
    best = cell
    for (i = -1; i <= 1; i++) for (j = -1; j <= 1; j++) {
        m = split(list[(int(px / cell) + i) "," (int(py / cell) + j)], one, " ")
        for (k = 1; k <= m; k++) {
            s = one[k]; dx = ex[s] - sx[s]; dy = ey[s] - sy[s]
            t = dx * dx + dy * dy > 0 ? ((px - sx[s]) * dx + (py - sy[s]) * dy) / (dx * dx + dy * dy) : 0
            t = t < 0 ? 0 : t > 1 ? 1 : t
            d = sqrt((sx[s] + t * dx - px) ^ 2 + (sy[s] + t * dy - py) ^ 2)
            if (d < best) best = d
        }
    }
    return best
}
function begin(name) { surface = name; bads = 0; offs = 0; ratios = 0; counted = 0; triangles = 0; split("", edge) }
# Nodes are numbered section by section, `columns` in each, as long as the mesh is whole: 0 when it is not.
function count_columns(    sum, product, m) {
    product = triangles / 2
    sum = nodes - product - 1
    if (sum * sum < 4 * product)
        return 0
    m = int((sum - sqrt(sum * sum - 4 * product)) / 2 + 1.5)
    return nodes % m == 0 && (m - 1) * (nodes / m - 1) == product ? m : 0
}
function turn(a, b, c,    ux, uy, wx, wy) { # of the way a-b-c, radians
    ux = x[b] - x[a]; uy = y[b] - y[a]; wx = x[c] - x[b]; wy = y[c] - y[b]
    ux = atan2(ux * wy - uy * wx, ux * wx + uy * wy)
    return ux < 0 ? -ux : ux
}
function is_sharp(i, columns,    k, side, a, b, c) { # the section that begins with node i * columns
    k = int(control[surface] / along[surface] + 0.5)
    k = k < 1 ? 1 : k
    if (i < k || (i + k + 1) * columns > nodes)
        return 0
    for (side = 0; side < 2; side++) {
        a = (i - k) * columns + side * (columns - 1); b = i * columns + side * (columns - 1)
        c = (i + k) * columns + side * (columns - 1)
        if (turn(a, b, c) * length_(i * columns, (i + 1) * columns - 1) * 2 > length_(a, b) + length_(b, c))
            return 1
    }
    return 0
}
function measure_triangles(    columns, i, k, section) {
    columns = surface == faced ? 0 : count_columns()
    split("", sharp)
    for (i = 0; columns && i < nodes / columns; i++)
        sharp[i] = is_sharp(i, columns)
    for (k = 0; k < triangles; k++) {
        section = 0
        if (columns) {
            i = ta[k] < tb[k] ? ta[k] : tb[k]
            i = i < tc[k] ? i : tc[k]
            section = int(i / columns)
        }
        triangle(ta[k], tb[k], tc[k], columns && (sharp[section] || sharp[section + 1]))
    }
}
function length_(a, b) { return sqrt((x[b] - x[a]) ^ 2 + (y[b] - y[a]) ^ 2) }
function angle(a, b, c) { # opposite a, by the sides
    c = (b * b + c * c - a * a) / (2 * b * c)
    return atan2(sqrt(c < 1 && c > -1 ? 1 - c * c : 0), c) * degrees
}
function triangle(a, b, c, bend,    l, m, s, t) {
    side(a, b); side(b, c); side(c, a)
    l = length_(a, b); m = length_(b, c); s = length_(c, a) # longest, middle and shortest
    if (m > l) { t = l; l = m; m = t }
    if (s > m) { t = m; m = s; s = t }
    if (m > l) { t = l; l = m; m = t }
    if (cut[a] || cut[b] || cut[c])
        return
    ratio[ratios++] = m / s
    counted += !bend
    if (!bend && angle(s, m, l) < 0.8 * atan2(across[surface], along[surface]) * degrees)
        bads++
}
function side(a, b) { # a piece of a bank between control points that were moved
    if (!bank[a] || !bank[b] || (a, b) in edge)
        return
    edge[a, b] = edge[b, a] = 1
    distance[offs++] = off(x[a], y[a])
    distance[offs++] = off((x[a] + x[b]) / 2, (y[a] + y[b]) / 2)
}
function quantile(v, n, part,    i, j, k, t, gap) { # sorts v (Shell)
    for (gap = int(n / 2); gap > 0; gap = int(gap / 2))
        for (i = gap; i < n; i++) {
            t = v[i]
            for (j = i; j >= gap && v[j - gap] > t; j -= gap) v[j] = v[j - gap]
            v[j] = t
        }
    k = int(part * n)
    return n > 0 ? v[k < n ? k : n - 1] : 0
}
function finish() {
    measure_triangles()
    printf "%s %.4f %.4f %.3f %.0f\n", surface, quantile(distance, offs, 0.95) / control[surface],
        quantile(ratio, ratios, 0.5) * across[surface] / along[surface], counted ? 100 * bads / counted : 0, 100 * counted / triangles
}
