#!/bin/sh
# The chain on a million points: valid, faithful, the same bytes for one thread and for several.
. "${0%/*}/../tap.sh"

hmsurvey -n 1200000 . 2>/dev/null
true_that "a million points" "$(wc -l <survey.xyz) >= 1000000"

# chain THREADS FOLDER: the tour
chain() {
    mkdir -p "$2" &&
        bsgrid -j "$1" -d 1 survey.xyz >"$2/dem.hm" &&
        slope -j "$1" "$2/dem.hm" >"$2/slope.hm" &&
        breaklines -j "$1" -s 13 -l 30 -r 4 "$2/slope.hm" >"$2/breaklines.hm" &&
        bsmesh -j "$1" -c 10/8 -e 8/3 lines.txt "$2/breaklines.hm" survey.xyz >"$2/regular.hm" &&
        stitch -j "$1" -c "$2/regular.hm" survey.xyz >"$2/river.hm" &&
        trimesh -j "$1" -l 4 -L 10 survey.xyz "$2/breaklines.hm" lines.txt "$2/river.hm" >"$2/flood.hm" &&
        stitch -j "$1" "$2/river.hm" "$2/flood.hm" >"$2/hybrid.hm" &&
        quality -j "$1" -c valid "$2/hybrid.hm" survey.xyz >"$2/quality.txt"
}
ok "the chain runs, its mesh is valid" chain 1 one
ok "and on three threads" chain 3 three
for product in dem.hm slope.hm breaklines.hm regular.hm river.hm flood.hm hybrid.hm quality.txt; do
    same "one thread as three: $product" one/$product three/$product
done
ok "the mesh fits the ground" quality -c 'rmse<=0.15,red<=5%' one/hybrid.hm survey.xyz
for product in dem hybrid; do
    ok "text, binary, text: $product" sh -c "hmconv -b one/$product.hm | hmconv | cmp - one/$product.hm"
done
done_testing
