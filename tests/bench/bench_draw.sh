#!/bin/sh
# A mesh of a million triangles (of so many points as the first argument says, 500,000) drawn in every
# way: seconds, memory and size; and the page of hmdraw -3 opened in Chromium without a graphics card.
# Status 1 when a goal is missed: 5 s a picture or page, 10 MB of page.
set -eu
: "${B:=$(cd "${0%/*}/../.." && pwd)/build}"
here=$(cd "${0%/*}/.." && pwd)
PATH=$B/bin:$B/test:$PATH
LC_ALL=C
export PATH LC_ALL
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
missed=0

hmcloud "${1:-500000}" 1000 >cloud.hm
trimesh --quiet -b -m delaunay -o mesh.hm cloud.hm
quality --quiet -r residuals.hm mesh.hm cloud.hm >quality.txt
hmconv mesh.hm | awk '/^t/ { n++ } END { print n " elements" }'

# row NAME OPTIONS FILE …: seconds, memory, size of what hmdraw makes of them
row() {
    name=$1
    shift
    /usr/bin/time -o t -f '%e %M' hmdraw -o "out.$name" "$@"
    read -r seconds memory <t
    word=ok
    awk "BEGIN { exit !($seconds <= 5) }" || word=MISS missed=$((missed + 1))
    awk -v n="$name $*" -v s="$seconds" -v m="$memory" -v b="$(wc -c <"out.$name")" -v w="$word" \
        'BEGIN { printf "%-40s %6.2f s %6.0f MB %8.2f MB written  %s\n", n, s, m / 1024, b / 1e6, w }'
}
row png mesh.hm
row PNG -f z mesh.hm
row Png -f quality mesh.hm
row html -3 mesh.hm
row htm -3 mesh.hm residuals.hm
if [ "$(wc -c <out.html)" -gt 10000000 ]; then
    echo "the page is larger than 10 MB"
    missed=$((missed + 1))
fi
if command -v chromium >/dev/null && command -v python3 >/dev/null; then
    python3 "$here/chromium.py" out.html js 'Math.round(performance.now())' >opened
    echo "the page is drawn $(cat opened) ms after it was begun to load"
fi
[ $missed -eq 0 ]
