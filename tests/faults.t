#!/bin/sh
# Memory that runs out at the n-th allocation, a disk that is full at the n-th write, an input that
# fails at the n-th read: every program ends with status 2, says why, and leaves no output that looks
# whole; or it does without and writes the same as ever. FAULTS=n tries so many places of each kind.
. "${0%/*}/tap.sh"
FAULTS=${FAULTS:-12}

fault=$B/test/fault.so
if [ ! -e "$fault" ] || [ "${B##*/}" = san ]; then
    skip "faults cannot be preloaded here"
    done_testing
fi

"$TESTS/small_chain" . >/dev/null 2>&1
head -n 3000 survey.xyz >few.xyz

# looks_whole FILE: a stream to its end mark
looks_whole() {
    [ -s "$1" ] && tail -n 1 "$1" | grep -q '^#end'
}

# survives KIND WORDS n COMMAND …: as said above, with the n-th call of this kind failing
survives() {
    kind=$1 words=$2 n=$3
    shift 3
    env FAULT_$kind=$n LD_PRELOAD=$fault "$@" >got 2>err
    status=$?
    [ $status -eq 0 ] && cmp -s got want && return 0
    [ $status -eq 2 ] && grep -Eq "$words" err && ! looks_whole got && return 0
    echo "# $kind $n: status $status, $(head -n 1 err)" >>bad
    return 1
}

# places TOTAL: numbers of calls to fail: the first ones and the last, the rest spread out
places() {
    awk -v total="$1" -v most="$FAULTS" 'BEGIN {
        step = total / most
        for (i = 1; i <= total && i <= most / 2; i++) print i
        for (at = i; at < total; at += step > 1 ? 2 * step : 1) print int(at)
        print total }' | sort -nu
}

# try NAME COMMAND …
try() {
    name=$1
    shift
    "$@" >want 2>/dev/null || { report 1 "$name runs"; return; }
    FAULT_COUNT=counts LD_PRELOAD=$fault "$@" >got 2>/dev/null
    read -r allocs writes reads <counts
    : >bad
    for n in $(places "$allocs"); do survives ALLOC memory "$n" "$@"; done
    for n in $(places "$writes"); do survives WRITE 'space|write' "$n" "$@"; done
    for n in $(places "$reads"); do survives READ 'error|read' "$n" "$@"; done
    report $(($(wc -l <bad) > 0)) "$name: $allocs allocations, $writes writes, $reads reads"
    head -n 5 bad
}

try bsgrid bsgrid -j 2 -d 5 few.xyz
try "bsgrid -m mean" bsgrid -j 2 -m mean -d 5 few.xyz
try slope slope -j 2 dem.hm
try breaklines breaklines -j 2 -s 13 -l 30 -r 6 slope.hm
try bsmesh bsmesh -j 2 -c 15/6 -e 12/5 lines.txt breaklines.hm survey.xyz
try "trimesh -m paper" trimesh -j 2 -l 6 -L 20 few.xyz breaklines.hm
try "trimesh -m quality" trimesh -j 2 -m quality -a 100 few.xyz breaklines.hm
try "trimesh -m terrain" trimesh -j 2 -m terrain -N 300 few.xyz breaklines.hm
try stitch stitch -j 2 river.hm flood.hm lines.txt
try quality quality -j 2 hybrid.hm few.xyz
try "hmconv -t 2dm" hmconv -t 2dm hybrid.hm
try "hmconv -t ugrid" hmconv -t ugrid hybrid.hm
try "hmconv, 2dm" hmconv hybrid.2dm

done_testing
