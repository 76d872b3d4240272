#!/bin/sh
# The case studies of the paper, small: which of their goals are met (make casestudies: whole, with pictures).
. "${0%/*}/tap.sh"

ok "junction: all goals" "$TESTS/study/junction" junction small
grep -q '^14 ok, 0 missed' tap.out
report $? "a row a goal: $(tail -1 tap.out)"

if need_data danube_deggendorf/points.xyz; then
    HM_DATA=$DATA ok "danube: all goals" "$TESTS/study/danube" danube small
    grep -q '^14 ok, 0 missed' tap.out
    report $? "a row a goal: $(tail -1 tap.out)"
fi
done_testing
