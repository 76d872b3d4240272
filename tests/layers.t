#!/bin/sh
# The layers of libcommon, as the README's table has them: which module may use which.
. "${0%/*}/tap.sh"

LIB=$TESTS/../libcommon

# modules.txt: layer and module, in the order of the table
awk -F'|' '
    /^\| layer \| modules \|/ { inside = 1; next }
    inside && !/^\|/ { exit }
    inside {
        if ($2 ~ /[0-9]/) layer = $2 + 0
        cells = $3
        while (match(cells, /`hm_[a-z0-9_]*`/)) {
            print layer, substr(cells, RSTART + 1, RLENGTH - 2)
            cells = substr(cells, RSTART + RLENGTH)
        }
    }' "$TESTS/../README.md" >modules.txt
# files.txt: every file and the module that it belongs to, the one whose name it continues
(cd "$LIB" && ls hm_*.[ch]) | awk '
    NR == FNR { module[$2] = 1; next }
    {
        name = $1
        sub(/\.[ch]$/, "", name)
        while (name != "" && !(name in module))
            if (!sub(/_[^_]*$/, "", name)) name = ""
        print $1, name == "" ? "-" : name
    }' modules.txt - >files.txt
# includes.txt: file and what it includes of ours
for f in "$LIB"/hm_*.[ch]; do
    sed -n "s/^#include \"\(.*\)\"/${f##*/} \1/p" "$f"
done >includes.txt

# none NAME FILE: nothing to complain of in the file
none() {
    [ ! -s "$2" ]
    tap_status=$?
    report $tap_status "$1"
    sed 's/^/# /' "$2"
}

[ "$(wc -l <modules.txt)" -gt 50 ] && [ "$(wc -l <includes.txt)" -gt 200 ]
report $? "there is a table, and there are files"
awk 'n[$2]++ { print $2 " stands there twice" } $1 < last { print $2 ": " $1 " after " last } { last = $1 }' \
    modules.txt >bad
none "each module is in the table once, the layers ascending" bad
while read -r layer module; do
    [ -e "$LIB/$module.h" ] || echo "$module has no header"
done <modules.txt >bad
awk '$2 == "-" { print $1 " belongs to no module" }' files.txt >>bad
none "each module has a header, each file a module" bad

while read -r file module; do
    case $file in *.c) continue ;; esac
    want=$(awk -v m="$module" '$2 == m { print $1 }' modules.txt)
    said=$(sed '/\*\//q' "$LIB/$file" | grep -o 'Layer [0-9]*' | head -n 1)
    [ "$said" = "Layer $want" ] || echo "$file says '$said', the table Layer $want"
done <files.txt >bad
none "the header of each module says its layer" bad

awk '
    FILENAME == "modules.txt" { rank[$2] = FNR; layer[$2] = $1; next }
    FILENAME == "files.txt" { of[$1] = $2; next }
    !($2 in of) { print $1 " includes " $2 ", which is not there"; next }
    { from = of[$1]; to = of[$2] }
    rank[to] > rank[from] {
        print $1 " includes " $2 ", layer " layer[from] " from " layer[to]
    }' modules.txt files.txt includes.txt >bad
none "a module includes none that stands behind it" bad

awk '
    FILENAME == "files.txt" { of[$1] = $2; next }
    $2 ~ /_private\.h$/ && of[$1] != of[$2] { print $1 " includes " $2 }' files.txt includes.txt >bad
none "private headers are their module's own" bad

# what a user is told goes through hm_cli, which knows --quiet and counts for --strict
(cd "$TESTS/.." && grep -nwE 'stderr|perror' libcommon/*.c tools/*.c tools/*/*.c) |
    grep -v '^libcommon/hm_cli' >bad
none "nothing but hm_cli writes to standard error" bad

# within a module too: tsort complains of circles
awk '$1 ~ /\.h$/' includes.txt | tsort >/dev/null 2>bad
none "no header includes itself by way of others" bad

done_testing
