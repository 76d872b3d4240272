#!/bin/sh
# Every tool against bad input: it says what and where, exits 2, and writes nothing that looks whole.
. "${0%/*}/tap.sh"

"$TESTS/small_chain" . >chain.log 2>&1 || { sed 's/^/# /' chain.log; report 1 "small chain"; }

# refuses NAME PATTERN COMMAND …: exit 2, a message like PATTERN, no end mark in the output
refuses() {
    name=$1 pattern=$2
    shift 2
    "$@" >refused.out 2>refused.err
    status=$?
    [ $status -eq 2 ] && grep -Eq -- "$pattern" refused.err && ! tail -n 1 refused.out | grep -q '^#end'
    refused=$?
    report $refused "$name"
    [ $refused -eq 0 ] || { echo "# status $status, wanted 2 and /$pattern/"; sed 's/^/# /' refused.err | head -5; }
}

# The good operands of a tool; @ stands for the input that is spoilt.
operands() {
    case $1 in
    bsgrid) echo "-d 4 @" ;;
    slope | breaklines | stitch | hmconv | hmdraw) echo "@" ;;
    bsmesh) echo "-c 15/6 -e 12/5 lines.txt @ survey.xyz" ;;
    trimesh) echo "-l 6 -L 20 lines.txt @" ;;
    quality) echo "@ survey.xyz" ;;
    georef) echo "-i -z 32N @" ;;
    esac
}

# What of the chain a tool reads there.
good_input() {
    case $1 in
    bsgrid | trimesh | georef) echo survey.hm ;;
    slope) echo dem.hm ;;
    breaklines) echo slope.hm ;;
    bsmesh | hmdraw) echo breaklines.hm ;;
    *) echo hybrid.hm ;;
    esac
}

run() { # TOOL INPUT: the tool on its good operands with INPUT among them
    "$1" $(operands "$1" | sed "s|@|$2|")
}

hmconv -t text survey.xyz >survey.hm
: >empty
printf 'one point\n' >words
printf '1 2 3\n' >one.xyz
printf '1 1 0\n2 2 0\n3 3 0\n4 4 0\n' >line.xyz
printf '1 1 0\n1 1 0\n1 1 0\n1 1 0\n' >equal.xyz
awk 'BEGIN { for (i = 0; i < 300; i++) printf "%c", 128 + i * 7919 % 127 }' >noise

for tool in bsgrid slope breaklines bsmesh trimesh stitch quality georef hmconv hmdraw; do
    command -v $tool >/dev/null || { skip "$tool is not built"; continue; }
    good=$(good_input $tool)
    size=$(wc -c <"$good")
    hmconv -t binary "$good" >good.bin
    ok "$tool: good input" run $tool "$good"

    refuses "$tool: empty input" "empty" run $tool empty
    refuses "$tool: missing file" "no_such_file" run $tool no_such_file
    head -c $((size * 6 / 10)) "$good" >cut
    refuses "$tool: truncated text" "cut" run $tool cut
    sed '$d' "$good" >cut
    refuses "$tool: no end mark" "cut.*end" run $tool cut
    head -c $(($(wc -c <good.bin) * 6 / 10)) good.bin >cut
    refuses "$tool: truncated binary" "cut" run $tool cut

    # line 30 or so of the data: its first number becomes a word, then nan
    n=$(($(grep -n '^#data' "$good" | cut -d: -f1) + 30))
    awk -v n=$n 'NR == n && !/^[>#]/ { f = /^[a-z]/ ? 2 : 1; $f = "word" } { print }' "$good" >spoilt
    cmp -s spoilt "$good" && { n=$((n + 1)); awk -v n=$n 'NR == n { $1 = "word" } { print }' "$good" >spoilt; }
    refuses "$tool: a word for a number" "spoilt:$n:" run $tool spoilt
    sed "${n}s/word/nan/" spoilt >nan && mv nan spoilt
    refuses "$tool: nan for a coordinate" "spoilt:$n:" run $tool spoilt
    sed "${n}s/nan/inf/" spoilt >inf && mv inf spoilt
    refuses "$tool: inf for a coordinate" "spoilt:$n:" run $tool spoilt
    sed '1s/#hm 1/#hm 2/' "$good" >newer
    refuses "$tool: a newer version" "newer:1:.*version" run $tool newer
    refuses "$tool: noise" "noise" run $tool noise

    ok "$tool: a full disk" sh -c "$tool $(operands $tool | sed "s|@|$good|") >/dev/full 2>err
        [ \$? -eq 2 ] && grep -Eq 'space|full' err"
    refuses "$tool: an unknown option" "--help" $tool --no-such-option
done

for bad in one line equal; do
    for tool in bsgrid "bsgrid -m mean" "bsgrid -m mean -f points -d 2" "trimesh -l 1 -L 3"; do
        refuses "$tool: $bad.xyz" "point|line" $tool $bad.xyz
    done
    refuses "bsgrid -m mean, $bad.xyz, a window" "tell no surface: .* in the window" \
        bsgrid -m mean -R 0/5/0/5 $bad.xyz
    refuses "bsmesh: a terrain of $bad.xyz" "terrain|point|line" \
        bsmesh -c 15/6 -e 12/5 lines.txt breaklines.hm $bad.xyz
    refuses "quality: $bad.xyz beside the mesh" "no measurement|outside" quality hybrid.hm $bad.xyz
done

# The wrong kind of input.
refuses "slope takes no points" "grid" slope survey.xyz
refuses "slope takes no lines" "grid" slope breaklines.hm
refuses "bsgrid takes no mesh" "points" bsgrid hybrid.hm
refuses "breaklines wants a slope" "slope" breaklines dem.hm
refuses "breaklines takes no points" "grid" breaklines survey.xyz
refuses "bsmesh wants surfaces" "surface" bsmesh -c 15/6 -e 12/5 breaklines.hm survey.xyz
refuses "bsmesh wants a terrain" "terrain" bsmesh -c 15/6 -e 12/5 lines.txt breaklines.hm
refuses "stitch wants meshes" "mesh" stitch survey.xyz
refuses "quality wants a mesh" "mesh" quality survey.xyz
refuses "quality wants points" "points" quality hybrid.hm
refuses "hmconv: no 2dm of points" "2dm can hold" hmconv -t 2dm survey.xyz
refuses "hmconv: no grid of lines" "asc can hold" hmconv -t asc lines.txt

# Crossing and doubled breaklines are mended and counted; --strict makes that exit 1.
printf '> limit=5\n545050 5972050 6\n545150 5972090 6\n> limit=5\n545050 5972090 6\n545150 5972050 6\n' >cross.txt
cat cross.txt cross.txt >doubled.txt
for lines in cross doubled; do
    ok "trimesh: ${lines}ing breaklines" trimesh -l 6 -L 20 -o mended.hm survey.xyz $lines.txt
    true_that "they are counted" "$(grep -c 'mended: .*cross' tap.err) == 1"
    ok "the mesh is valid" quality --check valid mended.hm survey.xyz
    must_fail "--strict says so" 1 "mended" trimesh --strict -l 6 -L 20 survey.xyz $lines.txt
done
# --- messages that say what is meant ---
printf 'MESH2D\nND 1 0 0 0\nND 2 1 0 0\nND 3 0 1 0\nE3T 1 1 2 3 1\nNS 1 2\n' >open.2dm
must_fail "a node string without an end" 2 'open.2dm:6: a node string without an end' hmconv open.2dm
printf '#hm 1 points text\n#fields x y z z\n#data\n1 2 3 4\n#end\n' >twice.hm
must_fail "two fields of one name" 2 'twice.hm:2: two fields are called z' hmconv twice.hm

done_testing
