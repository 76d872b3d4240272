#!/bin/sh
# The chain on real terrain.
. "${0%/*}/tap.sh"

# value ROW COLUMN: a word of a quality report's row
value() {
    awk -v row="$1" -v column="$2" '$1 == row { print $column; exit }' report
}

# The Danube near Deggendorf: spacing 0.6 to 20 m, a bed with guide dams, rough banks drawn by hand.
if need_data danube_deggendorf/points.xyz; then
    points=$DATA/danube_deggendorf/points.xyz
    lines=$TESTS/danube_lines.txt
    ok "Danube: bsgrid" bsgrid -d 5 -g 60 -o dem.hm "$points"
    ok "Danube: slope" slope -o slope.hm dem.hm
    ok "Danube: breaklines" breaklines -s 8 -l 100 -r 12 -o breaklines.hm slope.hm
    ok "Danube: bsmesh" bsmesh -c 25/8 -e 20/8 -o regular.hm "$lines" breaklines.hm "$points"
    ok "Danube: stitch the river" stitch -o river.hm regular.hm "$points"
    ok "Danube: trimesh" trimesh -l 10 -L 30 -o flood.hm "$points" breaklines.hm "$lines" river.hm
    ok "Danube: stitch all" stitch -o hybrid.hm river.hm flood.hm
    ok "Danube: a valid mesh" quality --check valid -o report hybrid.hm "$points"
    true_that "Danube: nodes" "$(awk '/^v/ { n++ } END { print n }' hybrid.hm) < 47543 / 2"
    true_that "Danube: points compared" "$(value compared 2) > 46000"
    true_that "Danube: RMSE, m" "$(value all 8) < 0.45"
fi

# Farmland with a bank and a ditch, eight points a square metre: breaklines and irregular mesh.
if need_data lidarhd_farmland_dense/points_ground.xyz.gz; then
    gzip -dc "$DATA/lidarhd_farmland_dense/points_ground.xyz.gz" >farmland.xyz
    ok "farmland: bsgrid" bsgrid -d 1 -o dem.hm farmland.xyz
    ok "farmland: slope" slope -o slope.hm dem.hm
    ok "farmland: breaklines" breaklines -s 10 -l 30 -r 4 -o breaklines.hm slope.hm
    true_that "farmland: breaklines found" "$(grep -c '^>' breaklines.hm) >= 4"
    ok "farmland: trimesh" trimesh -l 3 -L 8 -o mesh.hm farmland.xyz breaklines.hm
    ok "farmland: a valid mesh" quality --check valid,green'>='97% -o report mesh.hm farmland.xyz
    true_that "farmland: nodes" "$(awk '/^v/ { n++ } END { print n }' mesh.hm) < 6000"
    true_that "farmland: RMSE, m" "$(value all 8) < 0.06"
fi
done_testing
