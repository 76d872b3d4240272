# channels.sh: straight regular meshes, and what tests ask of meshes stitched from them.

# channel NAME X0 Y0 X1 Y1 WIDTH ALONG ACROSS [quads|triangles [ROLE]]: a straight regular mesh
channel() {
    awk -v name="$1" -v x0="$2" -v y0="$3" -v x1="$4" -v y1="$5" -v width="$6" -v along="$7" \
        -v across="$8" -v kind="${9:-triangles}" -v role="${10:-regular}" 'BEGIN {
        length_ = sqrt((x1 - x0) ^ 2 + (y1 - y0) ^ 2)
        n = int(length_ / along + .5); m = int(width / across + .5)
        ux = (x1 - x0) / length_; uy = (y1 - y0) / length_
        printf "#hm 1 mesh text\n#name %s\n#role %s\n%s#units m m m\n#data\n", name, role,
            role == "regular" ? "#owners " name "\n" : ""
        for (j = 0; j <= m; j++) for (i = 0; i <= n; i++) {
            s = length_ * i / n; t = width * (j / m - .5)
            x = x0 + ux * s - uy * t; y = y0 + uy * s + ux * t
            printf "v %.9g %.9g %.9g %d %d\n", x, y, .01 * x - .02 * y + 5,
                i == 0 || j == 0 || i == n || j == m, role == "regular"
        }
        for (j = 0; j < m; j++) for (i = 0; i < n; i++) {
            a = j * (n + 1) + i; b = a + 1; c = b + n + 1; d = a + n + 1
            if (kind == "quads") printf "q %d %d %d %d 0\n", a, b, c, d
            else if ((i + j) % 2) printf "t %d %d %d 0\nt %d %d %d 0\n", a, b, c, a, c, d
            else printf "t %d %d %d 0\nt %d %d %d 0\n", a, b, d, b, c, d
        }
        print "#end" }'
}

area() { # of the elements of a mesh
    awk '/^v/ { x[n + 0] = $2; y[n++] = $3 }
        /^[tq]/ { k = /^t/ ? 3 : 4
            for (i = 0; i < k; i++) { a = $(2 + i); b = $(2 + (i + 1) % k); s += x[a] * y[b] - x[b] * y[a] } }
        END { printf "%.17g", s / 2 }' "$1"
}

elements() { # one line an element, by coordinates, from its lowest corner on
    awk '/^#hm/ { n = 0 } /^v/ { p[n++ + 0] = $2 "," $3 }
        /^[tq]/ { k = /^t/ ? 3 : 4; low = 0
            for (i = 1; i < k; i++) if (p[$(2 + i)] < p[$(2 + low)]) low = i
            line = ""; for (i = 0; i < k; i++) line = line " " p[$(2 + (low + i) % k)]
            print line }' "$@" | sort
}

nodes() { # x, y and z of all nodes
    awk '/^v/ { print $2, $3, $4 }' "$@" | sort -u
}

# new_inside RESULT MESH ...: nodes that no other mesh has lie inside the result, on the plane
new_inside() {
    awk 'NR == 1 { result = FILENAME } /^v/ && FILENAME == result { line[$2 " " $3] = $0 }
        /^v/ && FILENAME != result { delete line[$2 " " $3] }
        END { for (p in line) { split(line[p], v); off = v[4] - .01 * v[2] + .02 * v[3] - 5
            if (v[5] % 2 || off ^ 2 > 1e-12) { print line[p]; bad = 1 } } exit bad }' "$@"
}

# angles RESULT MESH ...: triangles of the result that no other mesh has: how many, their least angle,
# and how many are under 15 degrees
angles() {
    elements "$1" >of.result
    shift
    elements "$@" >of.others
    comm -23 of.result of.others | tr , ' ' | awk '{ least = 180
        for (i = 0; i < 3; i++) { a = 1 + 2 * i; b = 1 + 2 * ((i + 1) % 3); c = 1 + 2 * ((i + 2) % 3)
            angle = atan2($(b + 1) - $(a + 1), $b - $a) - atan2($(c + 1) - $(a + 1), $c - $a)
            angle = atan2(sin(angle), cos(angle)) * 180 / atan2(0, -1)
            if (angle < 0) angle = -angle
            if (angle < least) least = angle }
        n++; if (n == 1 || least < most) most = least; if (least < 15) poor++ }
        END { print n + 0, most + 0, poor + 0 }'
}

# An independent look: positive areas, edges used once each way, all nodes used, one piece (Euler:
# nodes - edges + elements = pieces - holes, with HOLES given).
sound() {
    awk -v holes="${2:-0}" -v pieces="${3:-1}" '/^v/ { x[n + 0] = $2; y[n++] = $3 }
        /^[tq]/ { k = /^t/ ? 3 : 4; elements++; s = 0
            for (i = 0; i < k; i++) {
                a = $(2 + i); b = $(2 + (i + 1) % k); used[a] = 1
                if (++edge[a, b] > 1) { print "edge twice", a, b; bad = 1 }
                if (!((b, a) in edge)) edges++
                s += x[a] * y[b] - x[b] * y[a] }
            if (s <= 0) { print "area", $0; bad = 1 } }
        END { for (i = 0; i < n; i++) if (!(i in used)) { print "unused", i; bad = 1 }
            if (n - edges + elements != pieces - holes) { print "Euler", n - edges + elements; bad = 1 }
            exit bad }' "$1"
}

# island MESH W E S N: the mesh without the elements whose centres lie in that window, nor nodes only they use
island() {
    awk -v w="$2" -v e="$3" -v s="$4" -v n="$5" '/^v/ { line[k] = $0; x[k] = $2; y[k++] = $3; next }
        /^t/ { cx = (x[$2] + x[$3] + x[$4]) / 3; cy = (y[$2] + y[$3] + y[$4]) / 3
            if (cx > w && cx < e && cy > s && cy < n) next
            t[m++] = $0; used[$2] = used[$3] = used[$4] = 1; next }
        /^#end/ { for (i = 0; i < k; i++) if (i in used) { number[i] = j++ + 0; print line[i] }
            for (i = 0; i < m; i++) { split(t[i], f); print "t", number[f[2]], number[f[3]], number[f[4]], f[5] } }
        { print }' k=0 m=0 "$1"
}
