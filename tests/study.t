#!/bin/sh
# The case studies of the paper, small: which of their goals are met (make casestudies: whole, with pictures).
. "${0%/*}/tap.sh"

ok "junction: all goals" "$TESTS/study/junction" junction small
grep -q '^14 ok, 0 missed' tap.out
report $? "a row a goal: $(tail -1 tap.out)"

# The irregular mesh follows the terrain by the size of its elements, so that neighbours differ: that goal
# is open.
if need_data danube_deggendorf/points.xyz; then
    HM_DATA=$DATA "$TESTS/study/danube" danube small >study.out 2>study.err
    true_that "danube: goals but for the areas of irregular neighbours: $(tail -1 study.out)" \
        "$(grep -v 'hybrid mesh: neighbours' study.out | grep -c ' MISS$') == 0 && $(grep -c ' ok$' study.out) >= 13"
    [ ! -s study.err ]
    report $? "danube: nothing goes wrong"
fi
done_testing
