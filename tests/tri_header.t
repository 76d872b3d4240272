#!/bin/sh
# The worked example in hm_tri.h is a program that does what it says.
. "${0%/*}/tap.sh"

sed -n '/^ \* A whole program/,/^ \* Memory/s/^ \*     //p' "$TESTS/../libcommon/hm_tri.h" >example.c
case $B in */san) san=-fsanitize=address,undefined ;; *) san= ;; esac
ok "it compiles" sh -c "${CC:-cc} -std=c11 -Wall -Werror $san -I '$TESTS/../libcommon' \
    -o example example.c '$B/libhm.a' -pthread -lm"
ok "it runs" ./example
echo 84 >expected
./example >got
same "it prints the area without the pond" expected got
done_testing
