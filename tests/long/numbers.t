#!/bin/sh
# Reading and printing of numbers, with ten times as many random ones.
B=${B:-${0%/*}/../../build} HM_LONG=1
export HM_LONG
exec "$B/test/test_num"
