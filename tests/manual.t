#!/bin/sh
# The examples of the manual pages run: every line that begins with `$ ` in a page's EXAMPLES.
. "${0%/*}/tap.sh"

man=$TESTS/../man
"$TESTS/small_chain" . >chain.log 2>&1 || { sed 's/^/# /' chain.log; report 1 "small chain"; }

# The commands of a page, one a line, roff escapes undone, continued lines joined.
commands() {
    sed -n '/^\.Sh EXAMPLES/,/^\.Sh SEE ALSO/p' "$1" |
        sed -e 's/\\&//g' -e 's/\\-/-/g' -e 's/\\(aq/'"'"'/g' -e 's/\\(dq/"/g' -e 's/\\e/\\/g' |
        awk '/^\$ / { sub(/^\$ /, ""); line = $0; while (line ~ /\\$/ && (getline more) > 0) {
                sub(/\\$/, "", line); line = line more }
                print line }'
}

for page in "$man"/*.1 "$man"/*.7; do
    name=$(basename "$page")
    commands "$page" >commands
    case $page in
    *.1) command -v "${name%.1}" >/dev/null || { skip "${name%.1} is not built"; continue; } ;;
    esac
    [ -s commands ] || { report 1 "$name has examples"; continue; }
    rm -rf try && mkdir try && cp ./*.xyz ./*.txt ./*.hm ./*.2dm try
    while IFS= read -r command; do
        (cd try && sh -e -c "$command") >out 2>err
        status=$?
        [ $status -le 1 ] # 1 is a verdict, not a failure
        report $? "$name: $command"
        [ $status -le 1 ] || sed 's/^/# /' err
    done <commands
done
done_testing
