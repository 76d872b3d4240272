#!/bin/sh
# tests/run: what it adds up, and that nothing gets lost.
. "${0%/*}/tap.sh"

# a_test NAME LINE …: an executable that prints the lines
a_test() {
    name=$1
    shift
    { echo '#!/bin/sh'; for line; do echo "echo '$line'"; done; } >"$name"
    chmod +x "$name"
}
mkdir one two
a_test one/a.t 'ok 1 - right' '# status 2, wanted 1' 'ok 2 # SKIP no data' 1..2
a_test two/a.t 'ok 1 - right' 'not ok 2 - wrong' 1..2
echo 'exit 1' >>two/a.t
a_test two/b.t 'ok 1 - right, then it dies'
echo 'exit 3' >>two/b.t
last() {
    "$TESTS/run" "$@" | tail -n 1
}
[ "$(last)" = "0 passed, 0 failed, 0 skipped" ]
report $? "no tests are no tests"
[ "$(last "$WORK/one/a.t")" = "1 passed, 0 failed, 1 skipped" ]
report $? "one"
[ "$(last "$WORK/one/a.t" "$WORK/two/a.t")" = "2 passed, 1 failed, 1 skipped" ]
report $? "two of the same name"
[ "$(last "$WORK/two/b.t")" = "1 passed, 1 failed, 0 skipped" ]
report $? "one that dies has failed"
[ "$(last "$WORK/none.t" "$WORK/one/a.t")" = "1 passed, 1 failed, 1 skipped" ]
report $? "one that is not there has failed"
"$TESTS/run" "$WORK/none.t" >out
true_that "and that is the exit status" "$? == 1"
done_testing
