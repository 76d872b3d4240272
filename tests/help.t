#!/bin/sh
# Every tool: what --help says is what the manual says, and neither is wider than a terminal.
. "${0%/*}/tap.sh"

man=$TESTS/../man

# Options of a --help, one a line as `-d --spacing` or `--derivatives`: its own, or the common ones.
help_options() { # FILE own|common
    awk -v part="$2" '/^Options:/ { now = "own" } /^Common options:/ { now = "common" }
        now == part && /^  +-/ { gsub(/,/, ""); print $1 ~ /^-[^-]/ ? $1 " " $2 : $1 }' "$1" | sort
}

# Those of a manual page in the same form.
page_options() { # PAGE SECTION
    awk -v section="$2" '/^\.Sh / { on = $0 == ".Sh " section }
        on && /^\.It Fl / { print $4 == "," ? "-" $3 " -" $5 : "-" $3 }' "$1" | sort
}

# The common options by their letters (or long names when they have none).
short_names() {
    awk '{ print $1 }' | sort
}

page_options "$man/hybridmesh.5" "COMMON OPTIONS" >common.page
: >common.seen
for tool in bsgrid slope breaklines bsmesh trimesh stitch quality georef hmconv hmdraw; do
    command -v $tool >/dev/null || { skip "$tool is not built"; continue; }
    page=$man/$tool.1

    ok "$tool --help" sh -c "$tool --help >help"
    ok "$tool: no line over 99 columns" awk 'length($0) > 99 { print; bad = 1 } END { exit bad }' help
    ok "$tool --version" sh -c "$tool --version | grep -Eqx '$tool \(hybridmesh\) [0-9.]+'"
    must_fail "$tool: an unknown option" 2 "unknown option --nonsense; $tool --help" $tool --nonsense
    must_fail "$tool: an unknown letter" 2 "unknown option -!" $tool -!
    must_fail "$tool: help to a full disk" 2 "cannot write: No space" sh -c "$tool --help >/dev/full"

    help_options help own >want
    page_options "$page" OPTIONS >got
    ok "$tool has options" test -s want
    same "$tool: the options of --help and of the manual" want got
    awk '{ print $1 }' want | sort >names
    sed -n '/^\.Sh SYNOPSIS/,/^\.Sh DESCRIPTION/p' "$page" | grep -E '^\.(Op )?Fl ' | sed 's/^\.Op //' |
        awk '$2 ~ /^-/ { print "-" $2; next } { while ($2 != "") { print "-" substr($2, 1, 1); $2 = substr($2, 2) } }' |
        grep -vx -e -o | sort -u >got
    same "$tool: and of the synopsis" names got

    help_options help common | tee -a common.seen | short_names >want
    sed -n '/^The common options$/{n;p;n;n;p;}' "$page" | tr ' ' '\n' | sed -n 's/^\([-a-zA-Z]\{1,\}\)$/-\1/p' |
        sort >got
    same "$tool: the common options, too" want got
done
sort -u common.seen >seen
same "hybridmesh(5) has all common options" seen common.page

# What means nothing to a tool it refuses.
must_fail "a report is no stream" 2 'quality: --keep means nothing here' quality -K
must_fail "nor is a picture" 2 'hmdraw: --binary means nothing here' hmdraw --binary
must_fail "a mesh is exact" 2 'stitch: --precision means nothing here' stitch -p 3
must_fail "no decimals" 2 'precision: 1 to 17' slope -p 0
must_fail "too many" 2 'precision: 1 to 17' slope -p 18
must_fail "binary is exact" 2 'precision is for text' slope -b -p 3
must_fail "a copy is exact" 2 'precision would round' slope -K -p 3
must_fail "an option without its argument" 2 'threads needs an argument \(N\)' slope --threads
must_fail "a flag with one" 2 'strict takes no argument' slope --strict=1
must_fail "a word for a number" 2 "spacing: 'two' is not a number" bsgrid -d two
must_fail "a choice that is none" 2 "units: must be one of degree.percent.radian, not 'grad'" slope -u grad

# The history: its own options in the order of the table, then the common ones that round.
printf 'ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 4.123\n' >two.asc
slope -p 1 -u percent --method=horn -j 1 -v --quiet -o out two.asc
ok "options in order, rounding among them" grep -qx '#prog slope 0.1 -m horn -u percent -p 1' out
hmconv -p 1 two.asc >out
ok "rounding is history" grep -qx '#prog hmconv 0.1 -p 1' out
hmconv two.asc | hmconv -b | hmconv >out
ok "other encodings are not" sh -c '! grep "#prog" out'
# An output that cannot be written is found before anything is read.
must_fail "an output without a name" 2 'output: needs a file name' slope -o '' two.asc
must_fail "a folder that is not there" 2 'no/such/out: cannot write: No such file' slope -o no/such/out missing.asc
must_fail "a folder for a file" 2 '[.]: cannot write: Is a directory' slope -o . missing.asc
must_fail "residuals nowhere" 2 'no/residuals: cannot write' quality -r no/residuals missing.hm
must_fail "points left nowhere" 2 'no/clean: cannot write' bsgrid --clean no/clean missing.xyz
must_fail "steps nowhere" 2 'no/steps: No such file' trimesh -l 1 --steps no/steps missing.xyz

done_testing
