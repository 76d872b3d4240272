# tap.sh: what a shell test needs. A test is an executable tests/NAME.t that begins with
#
#     #!/bin/sh
#     . "${0%/*}/tap.sh"
#
# (tests/long/NAME.t: /../tap.sh)
#
# runs in an empty folder of its own (removed at its end), finds the programs on PATH, and ends with
# `done_testing`.

TESTS=$(cd "${0%/*}" && pwd)
TESTS=${TESTS%/long}
: "${B:=$(cd "$TESTS/.." && pwd)/build}"
DATA=${HM_DATA:-$TESTS/../../shared/data} # real terrain; may be absent: need_data skips
PATH=$B/bin:$B/test:$PATH
LC_ALL=C
LSAN_OPTIONS="suppressions=$TESTS/lsan.supp:print_suppressions=0"
export PATH LC_ALL LSAN_OPTIONS
tap_n=0
tap_bad=0
WORK=$(mktemp -d) && cd "$WORK" || exit 2
trap 'rm -rf "$WORK"' EXIT

# report STATUS NAME: one TAP line
report() {
    tap_n=$((tap_n + 1))
    if [ "$1" -eq 0 ]; then
        echo "ok $tap_n - $2"
    else
        echo "not ok $tap_n - $2"
        tap_bad=1
    fi
}

# ok NAME COMMAND …: the command succeeds
ok() {
    tap_name=$1
    shift
    "$@" >tap.out 2>tap.err
    tap_status=$?
    report $tap_status "$tap_name"
    [ $tap_status -eq 0 ] || sed 's/^/# /' tap.out tap.err | head -20
}

# same NAME FILE FILE: equal bytes
same() {
    cmp -s "$2" "$3"
    tap_status=$?
    report $tap_status "$1"
    [ $tap_status -eq 0 ] || diff "$2" "$3" | sed 's/^/# /' | head -10
}

# must_fail NAME STATUS PATTERN COMMAND …: exits with just that status (a crash never counts), says
# something on standard error that matches the extended regular expression
must_fail() {
    tap_name=$1 tap_want=$2 tap_pattern=$3
    shift 3
    "$@" >tap.out 2>tap.err
    tap_status=$?
    [ $tap_status -eq "$tap_want" ] && grep -Eq -- "$tap_pattern" tap.err
    tap_good=$?
    report $tap_good "$tap_name"
    [ $tap_good -eq 0 ] || { echo "# status $tap_status, wanted $tap_want and /$tap_pattern/"; sed 's/^/# /' tap.err | head -10; }
}

# true_that NAME AWK-CONDITION: arithmetic on numbers, as in: true_that "slope" "$x < 5"
true_that() {
    awk "BEGIN { exit !($2) }"
    report $? "$1: $2"
}

skip() {
    tap_n=$((tap_n + 1))
    echo "ok $tap_n # SKIP $1"
}

# need_data FILE: true when the real data are there; else one skip
need_data() {
    [ -e "$DATA/$1" ] && return 0
    skip "$1 is not there (set HM_DATA)"
    return 1
}

done_testing() {
    echo "1..$tap_n"
    exit $tap_bad
}
