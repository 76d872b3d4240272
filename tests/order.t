#!/bin/sh
# A survey is one terrain, however its points are spread over files and ordered in them: an L-shaped
# tile and the rest, overlapping at their border, either first, or backwards.
. "${0%/*}/tap.sh"

hmsurvey -n 20000 . >/dev/null
awk '!/^#/ { rest = $1 > 545350 && $2 > 5972150
             print >(rest ? "rest.xyz" : "l.xyz")
             if (!rest && NR % 50 == 0) print $1, $2, $3 + NR % 7 / 10 >"rest.xyz" }' survey.xyz
awk '{ line[NR] = $0 } END { for (i = NR; i > 0; i--) print line[i] }' l.xyz >backwards.xyz
cat l.xyz rest.xyz >one.xyz

# chain NAME POINTS …: the products in NAME.1, NAME.2, …
chain() {
    name=$1
    shift
    bsgrid --quiet -d 2 -o "$name.1" "$@" &&
        bsgrid --quiet -d 2 -f points -o "$name.2" "$@" &&
        bsmesh --quiet -c 15/6 -e 12/5 -o "$name.3" lines.txt breaklines.hm "$@" &&
        stitch --quiet -c -o "$name.4" "$name.3" "$@" &&
        trimesh --quiet -l 6 -L 15 -o "$name.5" "$@" breaklines.hm lines.txt "$name.4" &&
        trimesh --quiet -m delaunay -o "$name.6" "$@" breaklines.hm lines.txt "$name.4"
}

bsgrid --quiet -d 2 one.xyz | slope | breaklines --quiet -s 8 -l 30 -r 6 >breaklines.hm
ok "one file" chain one one.xyz
ok "two, the L first" chain two l.xyz rest.xyz
ok "the L last" chain last rest.xyz l.xyz
ok "the L backwards" chain backwards rest.xyz backwards.xyz
k=0
for product in bsgrid "bsgrid -f points" bsmesh stitch trimesh "trimesh -m delaunay"; do
    k=$((k + 1))
    for way in two last backwards; do
        same "$product: the same bytes, $way" one.$k $way.$k
    done
done
says=$(trimesh -l 6 -o said.hm rest.xyz l.xyz 2>&1)
true_that "points at one place are counted: $(echo "$says" | head -n 1)" \
    "$(echo "$says" | awk '/points at the place of another: their mean/ { print $2 }') == $(cat rest.xyz l.xyz | wc -l) - $(cut -d ' ' -f 1,2 one.xyz | sort -u | wc -l)"

# What a grid knows comes before the measurements, in every tool.
printf '#hm 1 grid text\n#size 2 2\n#origin 544000 5971000\n#step 3000 3000\n#fields x y z\n#data\n' >flat.hm
printf '544000 5971000 7\n547000 5971000 7\n544000 5974000 7\n547000 5974000 7\n#end\n' >>flat.hm
bsmesh --quiet -c 15/6 -e 12/5 lines.txt breaklines.hm one.xyz flat.hm >level.hm
true_that "bsmesh: a grid comes first" "$(awk '/^v/ && ($4 - 7) ^ 2 > 1e-18' level.hm | wc -l) == 0"
stitch --quiet -c -w 25 two.3 one.xyz flat.hm >level.hm
true_that "stitch: in the gap" "$(awk '/^v/ && $4 == 7' level.hm | wc -l) > 0"
trimesh --quiet -l 6 one.xyz flat.hm >level.hm
true_that "trimesh: everywhere" "$(awk '/^v/ && $4 != 7' level.hm | wc -l) == 0"
done_testing
