#!/bin/sh
# Stages swapped for other programs, by the recipes of hybridmesh(7), "SWAPPING A STAGE": each block of
# commands there runs where its programs are, and what comes out is held against our own.
. "${0%/*}/tap.sh"

"$TESTS/small_chain" . >chain.log 2>&1 || { sed 's/^/# /' chain.log; report 1 "small chain"; }
"$TESTS/classroom/stages" case >chain.log 2>&1 || { sed 's/^/# /' chain.log; report 1 "classroom"; }
printf '> boundary=1 closed=1\n0 0\n70 0\n70 30\n0 30\n' >case/outline.txt

# the blocks, roff escapes undone, without prompts
sed -n '/^\.Sh SWAPPING/,/^\.Sh THE TRI/p' "$TESTS/../man/hybridmesh.7" | sed -e 's/\\-/-/g' -e 's/\\e/\\/g' |
    awk '/^\.Bd/ { name = "block" ++n; on = 1; next } /^\.Ed/ { on = 0 } on { sub(/^\$ /, ""); print >name }'
true_that "recipes" "$(ls block* | wc -l) == 10"
# recipe WORD: run the block with that word, if its programs are there (that of Gmsh with the classroom case)
recipe() {
    block=$PWD/$(grep -l -- "$1" block* | head -n 1)
    for program in gdaldem gdal_grid gdal_translate gdal_contour ogr2ogr gmt gmsh; do
        if grep -Eq "(^|[| ])$program " "$block" && ! command -v $program >/dev/null; then
            skip "$program is not there"
            return 1
        fi
    done
    folder=.
    [ "$1" != gmsh ] || folder=case
    (cd $folder && sh -e "$block") >log 2>&1
    report $? "the recipe with $1"
}
# apart OURS THEIRS FIELD: how many nodes of two grids have that field, the mean and greatest difference
apart() {
    awk -v f="$3" '/^#/ { next } NR == FNR { z[$1, $2] = $f; next }
        ($1, $2) in z && z[$1, $2] != "nan" && $f != "nan" {
            d = z[$1, $2] - $f; if (d < 0) d = -d; if (d > m) m = d; s += d; n++ }
        END { print n + 0, n ? s / n : 9, m + 0 }' "$1" "$2"
}
# near A B: the number of vertices of A, and the greatest distance from one to the nearest of B
cat >near.awk <<'END'
function cell(x, y) { return int(x - 544000) SUBSEP int(y - 5971000) }
/^#/ { next }
/^>/ { last = ""; next }
FILENAME == other { k = cell($1, $2); at[k] = at[k] " " $1 "," $2; next }
{
    best = 9
    for (i = -1; i <= 1; i++) for (j = -1; j <= 1; j++) {
        n = split(at[cell($1 + i, $2 + j)], p, " ")
        for (q = 1; q <= n; q++) {
            split(p[q], v, ",")
            d = sqrt((v[1] - $1) ^ 2 + (v[2] - $2) ^ 2)
            if (d < best) best = d
        }
    }
    if (best > worst) worst = best
    vertices++
}
END { print vertices + 0, worst + 0 }
END
near() {
    awk -v other="$2" -f near.awk "$2" "$1"
}
# ahead A B: the share of segments of B that run as those of A from the same vertex
ahead() {
    awk '/^#/ { next } /^>/ { last = ""; next } { here = sprintf("%.3f %.3f", $1, $2) }
        NR == FNR { if (last != "") { split(last, a); x[last] = $1 - a[1]; y[last] = $2 - a[2] } last = here; next }
        last != "" && last in x { split(last, a); n++; if (x[last] * ($1 - a[1]) + y[last] * ($2 - a[2]) > 0) s++ }
        { last = here }
        END { print (n > 1000 ? s / n : 0.5) }' "$1" "$2"
}
within() { # NAME "COUNT … DISTANCE" LEAST-COUNT MOST-DISTANCE
    true_that "$1" "${2%% *} > $3 && ${2##* } < $4"
}

# --- slope: GDAL's Horn is ours; its breaklines run where ours do ---
if recipe gdaldem; then
    cp other.hm gdaldem.hm
    slope --quiet -m horn dem.hm | breaklines --quiet -s 13 -l 30 -r 0.5 >ours.hm
    # away from the grid's border, where GDAL gives no slope
    within "breaklines by it, by ours" "$(awk '/^[#>]/ || ($1 > 545030 && $1 < 545450 && $2 > 5972030 && $2 < 5972290)' gdaldem.hm >inner.hm
        near inner.hm ours.hm)" 300 0.5
fi

# --- grids: the triangles of GDAL, the spline of GMT ---
if recipe gdal_grid; then
    bsgrid --quiet -k 1 -n 0 -d 2 survey.xyz >tin.hm
    hmconv grid.asc >theirs.hm
    set -- $(apart tin.hm theirs.hm 3)
    true_that "heights of its triangles, mean" "$1 > 37000 && $2 < 0.005"
    # and with an origin to the last digit
    awk '!/^#/ { printf "%.2f %.2f %s\n", $1 - 545000, $2 - 5972000, $3 }' survey.xyz >near.xyz
    hmconv --quiet -t geojson near.xyz >near.geojson
    gdal_grid -q -a linear:radius=0:nodata=-9999 -outsize 241 159 -txe -1 481 -tye 319 1 -ot Float64 near.geojson near.tif
    gdal_translate -q -of AAIGrid -co DECIMAL_PRECISION=12 near.tif near.asc
    bsgrid --quiet -k 1 -n 0 -d 2 near.xyz >tin.hm
    hmconv near.asc >theirs.hm
    set -- $(apart tin.hm theirs.hm 3)
    true_that "with an origin, all of them" "$1 > 37000 && $3 < 1e-9"
fi
if recipe "gmt surface"; then
    hmconv surface.asc >theirs.hm
    set -- $(apart dem.hm theirs.hm 3)
    true_that "heights of its surface, mean" "$1 > 37000 && $2 < 0.1"
    ok "its breaklines" sh -c 'test $(grep -c "^>" other.hm) -ge 8'
fi

# --- breaklines are contours of the slope: the same crossings (equation 8) ---
breaklines --quiet -s 13 -l 0 -w 0 slope.hm >ours.hm
if recipe gdal_contour; then
    within "our vertices are its own" "$(near ours.hm contours.gmt)" 3000 1e-5
    true_that "turned, they have the steep side where ours do" "$(ahead ours.hm other.txt) > 0.97"
    true_that "as they come, on the other" "$(ahead ours.hm contours.gmt) < 0.03"
fi
if recipe pscontour; then
    within "our vertices are among GMT's" "$(near ours.hm other.txt)" 3000 1e-5
fi

# --- the floodplain by Gmsh, stitched, judged ---
if recipe gmsh; then
    ok "one valid mesh, nothing lost" sh -c 'quality --quiet -c valid case/hybrid.hm case/points.xyz >report'
    true_that "its area is the outline's" "$(awk '/area .* m2/ { for (i = 1; i < NF; i++) if ($i == "area") print $(i + 1) }' report | head -n 1) == 2100"
    # the smallest angle of Gmsh's own triangles, by awk
    quality --quiet case/flood.hm case/points.xyz >report
    awk '/^v/ { x[n + 0] = $2; y[n++] = $3 }
        function angle(a, b, c) {
            return atan2((x[b]-x[a])*(y[c]-y[a])-(x[c]-x[a])*(y[b]-y[a]), (x[b]-x[a])*(x[c]-x[a])+(y[b]-y[a])*(y[c]-y[a]))
        }
        /^t/ { for (k = 2; k <= 4; k++) { e = angle($k, $((k - 1) % 3 + 2), $(k % 3 + 2)) * 45 / atan2(1, 1); if (!m || e < m) m = e } }
        END { print m }' case/flood.hm >smallest
    true_that "smallest angle of its mesh" "($(cat smallest) - $(awk '/^ *smallest angle +[0-9]/ { print $3; exit }' report)) ^ 2 < 1e-6"
fi

recipe "hybrid.2dm" && ok "a report" grep -q "Verdicts" quality.txt

# --- GeoTIFF, GeoPackage, shapefile: there and back ---
if recipe dem.tif; then
    hmconv dem.asc >theirs.hm
    set -- $(apart dem.hm theirs.hm 3)
    true_that "heights through GeoTIFF" "$1 == 37999 && $3 < 1e-5"
fi
for way in gpkg shp; do
    if recipe lines.$way; then
        hmconv -p 9 breaklines.hm | grep -v '^#' >want
        hmconv -p 9 other.hm | grep -v '^#' >got
        same "lines through $way" want got
    fi
done
done_testing
