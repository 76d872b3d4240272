#!/bin/sh
# 50,000 small dirty drawings, triangulated by hm_tri and by CGAL. Skipped where CGAL is not installed
# (tests/deps bench does that).
B=${B:-${0%/*}/../../build}
HERE=${0%/*}
printf '#include <CGAL/version.h>\n' | ${CXX:-c++} -E -x c++ - >/dev/null 2>&1 || {
    echo 'ok 1 # SKIP CGAL is not installed'
    echo 1..1
    exit 0
}
tmp=$(mktemp -d) || exit 2
trap 'rm -rf "$tmp"' EXIT
case $B in */san) san=-fsanitize=address,undefined ;; *) san= ;; esac
${CXX:-c++} -std=c++17 -O2 -DNDEBUG $san -I "$HERE/../../libcommon" -o "$tmp/compare_cdt" \
    "$HERE/compare_cdt.cc" "$B/libhm.a" -lgmp -lmpfr -pthread -lm || exit 2
"$tmp/compare_cdt" "$@"
