#!/bin/sh
# stitch on channels thrown at random over one another, with and without an island, either one first: always a
# sound mesh, hardly a sharp triangle.
. "${0%/*}/../tap.sh"
. "$TESTS/channels.sh"

channel main 0 0 200 0 40 10 4 >main.hm
island main.hm 80 120 -9 9 >ring.hm
: >all
failed=0
for i in $(seq 120); do
    set -- $(awk -v i="$i" 'BEGIN { srand(i * 13); rand(); x = -20 + 240 * rand(); y = -40 + 80 * rand()
        a = 6.2831853 * rand(); l = 20 + 140 * rand()
        print x, y, x + l * cos(a), y + l * sin(a), 6 + 30 * rand(), 4 + 8 * rand(), 2 + 4 * rand() }')
    channel b "$@" >b.hm
    for pair in "main.hm b.hm" "b.hm main.hm" "ring.hm b.hm" "b.hm ring.hm"; do
        if stitch -c $pair >out.hm 2>said && stitch -c out.hm >/dev/null 2>&1; then
            angles out.hm $pair >>all
        else
            echo "# $i: $pair: $(tail -1 said)"
            failed=$((failed + 1))
        fi
    done
done
true_that "all stitched, without fault" "$failed == 0"
true_that "under 15 degrees: $(awk '{ n += $1; poor += $3 } END { print poor " of " n }' all) triangles" \
    "$(awk '{ n += $1; poor += $3 } END { print (n > 5000) * 100 * poor / n }' all) <= 1"

channel main 0 0 300 0 40 10 4 >main.hm
: >all
for i in $(seq 60); do
    set -- $(awk -v i="$i" 'BEGIN { srand(i * 7); rand(); x = 220 + 60 * rand()
        y = (rand() - .5) * (i % 3 == 0 ? 4 : i % 3 == 1 ? .5 : 0); a = (rand() - .5) * (i % 2 ? .1 : .01)
        w = 40 + (rand() - .5) * (i % 4 == 0 ? 0 : i % 4 == 1 ? .4 : 3)
        print x, y, x + 250, y + 250 * a, w, 7 + 6 * rand(), 3 + 3 * rand() }')
    channel on "$@" >on.hm
    stitch main.hm on.hm >out.hm 2>said && angles out.hm main.hm on.hm >>all
done
true_that "end to end: $(awk '{ n += $1; poor += $3 } END { print poor " of " n }' all) triangles under 15 degrees" \
    "$(awk 'END { print NR }' all) == 60 && $(awk '{ n += $1; poor += $3 } END { print 100 * poor / n }' all) <= 1"
done_testing
