#!/bin/sh
# The worked example in hm_tri.h is a program that does what it says, made of just the files that
# hybridmesh.7 names.
. "${0%/*}/tap.sh"

LIB=$TESTS/../libcommon
# The section of the manual has patterns behind .Pa, which are file names once they are in $LIB.
sed -n '/^\.Sh THE TRIANGULATION IN OTHER PROGRAMS/,/^\.Sh EXAMPLES/s/^\.Pa \(hm_[^ ]*\.[[a-z]*]*\).*/\1/p' \
    "$TESTS/../man/hybridmesh.7" | sort -u >patterns
true_that "the manual names files" "$(wc -l <patterns) == 7"
mkdir kernel
while read -r pattern; do
    cp "$LIB"/$pattern kernel/ || echo "$pattern names nothing" # the pattern is to be expanded
done <patterns >missing 2>&1
ok "all of which are there" test ! -s missing
sed -n '/^ \* A whole program/,/^ \* Memory/s/^ \*     //p' "$LIB/hm_tri.h" >example.c
case $B in */san) san=-fsanitize=address,undefined ;; *) san= ;; esac
ok "the example compiles with them alone" sh -c "${CC:-cc} -std=c11 -D_POSIX_C_SOURCE=200809L -O0 \
    -ffp-contract=off -Wall -Werror $san -I kernel -o example example.c kernel/*.c -pthread -lm"
ok "it runs" ./example
echo 84 >expected
./example >got
same "it prints the area without the pond" expected got
done_testing
