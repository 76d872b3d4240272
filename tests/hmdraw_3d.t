#!/bin/sh
# hmdraw -3: what the page holds, and what it does in a browser.
. "${0%/*}/tap.sh"
command -v hmdraw >/dev/null || {
    skip "hmdraw is not built (it needs cairo)"
    done_testing
}

# A quadrilateral from x 0 to 10 beside two triangles from 10 to 20, and 20 to 20 south to north. Far
# from the origin, so that coordinates need more digits than single precision has.
cat >mesh.hm <<'END'
#hm 1 mesh text
#name main
#role hybrid
#owners main
#string inflow 0 3
#data
v 545000.125 5972000.25 1 5 1
v 545010.125 5972000.25 1 1 1
v 545010.125 5972020.25 1.5 1 1
v 545000.125 5972020.25 1.25 5 1
v 545020.125 5972000.25 1 1 0
v 545020.125 5972020.25 1.625 3 0
q 0 1 2 3 1
t 1 4 2 0
t 4 5 2 7
#end
END
cat >residuals.hm <<'END'
#hm 1 points text
#fields x y z residual
#data
545003 5972005 1 0.03
545004 5972006 1 -0.04
545012 5972003 1 0.5
545018 5972018 1 nan
545090 5972018 1 0.1
#end
END
cat >lines.txt <<'END'
> limit=8
545010.125 5972000.25 1
545010.125 5972010.25 1.25
545010.125 5972020.25 1.5
> surface=main side=left
545010.125 5972000.25 0
545010.125 5972020.25 0
END

# --- what it holds ---
ok "a page" hmdraw -3 -T "Title & <b>" -o page.html mesh.hm residuals.hm lines.txt
ok "it refers to nothing outside" sh -c '! grep -E "(src|href)=\"[^\"]|https?:|@import|url\(" page.html | grep -v "href=\"data:,\""'
ok "and may open no connection" grep -q "default-src 'none'" page.html
ok "no tag comes from the data" sh -c '! grep -q "&.<b>" page.html && grep -q "Title & .u003cb>" page.html'
hmdraw -3 -j 1 -T "Title & <b>" mesh.hm residuals.hm lines.txt >again.html
same "the same page twice, on standard output" page.html again.html
if python3 -c 'import json' 2>/dev/null; then
    python3 "$TESTS/view3d.py" page.html >got
    cat >want <<'END'
mesh main 6 3
v 0 545000.1250 5972000.2500 1.0000 5 1
v 1 545010.1250 5972000.2500 1.0000 1 1
v 2 545010.1250 5972020.2500 1.5000 1 1
v 3 545000.1250 5972020.2500 1.2500 5 1
v 4 545020.1250 5972000.2500 1.0000 1 0
v 5 545020.1250 5972020.2500 1.6250 3 0
q 0 0 1 2 3 main up_to_0.10_m_off 2 0.0354 -0.0400
t 1 1 4 2 irregular over_0.30_m_off 1 0.5000 0.5000
t 2 4 5 2 material_7 without_residual 0 0.0000 0.0000
line Boundary 2
line Boundary 2
line Boundary 2
line Boundary 2
line Boundary 2
line Boundary 2
line Boundary_strings 2
line Breaklines 3
END
    same "nodes, elements, residuals, lines" want got
    hmdraw -3 -R 545015/545030/5972012/5972030 mesh.hm >window.html
    python3 "$TESTS/view3d.py" window.html >got
    cat >want <<'END'
mesh main 4 2
v 1 545010.1250 5972000.2500 1.0000 1 1
v 2 545010.1250 5972020.2500 1.5000 1 1
v 4 545020.1250 5972000.2500 1.0000 1 0
v 5 545020.1250 5972020.2500 1.6250 3 0
t 1 1 4 2 irregular - 0 0.0000 0.0000
t 2 4 5 2 material_7 - 0 0.0000 0.0000
END
    grep -v ^line got | diff want - >diff.out
    report $? "a window keeps the numbers of the stream"
    hmdraw -3 mesh.hm mesh.hm >two.html
    python3 "$TESTS/view3d.py" two.html >got
    true_that "two meshes" "$(grep -c '^mesh main 6 3' got) == 2 && $(grep -c '^[tq] 2 4 5 2' got) == 2"

    # a survey's mesh: every coordinate to half a step, elements and materials exactly
    awk 'BEGIN { srand(5); for (i = 0; i < 3000; i++)
        printf "%.5f %.5f %.5f\n", 500 * rand(), 400 * rand(), 3 * rand() }' >cloud.xyz
    trimesh -l 1 -o cloud.hm cloud.xyz
    hmdraw -3 cloud.hm >cloud.html
    python3 "$TESTS/view3d.py" cloud.html >cloud.got
    awk '/^v/ { print "v", n++, $2, $3, $4, $5, $6 }' cloud.hm >want.nodes
    grep '^v' cloud.got | paste -d ' ' - want.nodes | awk 'function off(a, b) { return (a > b ? a - b : b - a) }
        { if ($2 != $9 || off($3, $10) > 6e-4 || off($4, $11) > 6e-4 || off($5, $12) > 6e-4 || $6 != $13 || $7 != $14) bad++ }
        END { exit !(NR > 2900 && !bad) }'
    report $? "3,000 nodes to a millimetre"
    awk '/^t/ { print n++, $2, $3, $4 }' cloud.hm >want
    awk '/^t/ { print $2, $3, $4, $5 }' cloud.got >got
    same "and their elements" want got
else
    skip "no python3 to read the page"
fi

# --- what cannot be shown ---
must_fail "no mesh" 2 "no mesh" hmdraw -3 residuals.hm
sed 's/^v 545010.125 5972000.25 1 /v 545010.125 5972000.25 nan /' mesh.hm >flat.hm
must_fail "a node without height" 2 "without height.* at 545010.125 5972000.25" hmdraw -3 -o never.html flat.hm
[ ! -e never.html ]
report $? "and no file"
must_fail "a picture's suffix" 2 "HTML" hmdraw -3 -o x.png mesh.hm
must_fail "the page's suffix without -3" 2 "-3" hmdraw -o x.html mesh.hm
must_fail "a format" 2 "type" hmdraw -3 -t svg mesh.hm
must_fail "a size" 2 "size" hmdraw -3 -s 500 mesh.hm
must_fail "wire alone" 2 "fill" hmdraw -3 -f wire mesh.hm
sed 's/^#owners.*/&\n#crs EPSG:4326/' mesh.hm >degrees.hm
must_fail "longitude and latitude" 2 "georef" hmdraw -3 degrees.hm
sed 's/#string inflow 0 3/#string inflow 0 99/' mesh.hm >string.hm
must_fail "a string of nodes that are not there" 2 "inflow|node" hmdraw -3 string.hm
hmdraw -3 -o grid.html mesh.hm cloud.xyz lines.txt 2>points.err
ok "what is not shown is said" grep -q "; 1 layer of points or grids not" points.err
ok "lines too" grep -q "; 1 line with a role not" points.err
if [ -e /dev/full ]; then
    must_fail "a full disk" 2 "No space" sh -c 'hmdraw -3 mesh.hm >/dev/full'
fi

# --- in a browser ---
browse() { timeout 120 python3 "$TESTS/chromium.py" "$@"; }
browse page.html js document.title >title 2>browse.err
case $? in
77)
    skip "no chromium to look at the page with (tests/deps browser installs it)"
    done_testing
    ;;
127)
    skip "no python3 to drive a browser with"
    done_testing
    ;;
esac
ok "the page runs, without a word and without a connection" sh -c '! [ -s browse.err ] && grep -qx "Title & <b>" title'

# From above the middle of the mesh, (10, 10), lies in the middle of what the panel leaves free; the
# view is 20 m and a little more high. Without wires the light is that of nearly level ground.
middle='(innerWidth + panel.offsetWidth) / 2' m='(innerHeight / 24)'
text='picked.hidden ? "nothing" : picked.innerText.replace(/\s+/g, " ")'
by() { echo "colouring.value = $1, colouring.dispatchEvent(new Event('change'))"; }
find() { echo "q('find-kind').value = '$1', q('find-number').value = '$2', q('find').requestSubmit()"; }
browse page.html size 800 600 js 'globalThis.q = id => document.getElementById(id), q("top").click()' \
    click "$middle - 5 * $m" "innerHeight / 2 + 2 * $m" js "$text" \
    click "$middle + 2 * $m" "innerHeight / 2 + 6 * $m" js "$text" \
    click "$middle + 8 * $m" "innerHeight / 2 + $m" js "$text" \
    click 'innerWidth - 5' 'innerHeight / 2' js "$text" \
    js "$(find element 2)" js "$text" \
    js 'q("picked-rows").querySelector("a").click()' js "$text" \
    js "$(find element 17)" js "$text" \
    js 'wires.click(), q("home").click(), q("top").click(), find' shot residual.png \
    js "[$middle - 5 * $m, innerHeight / 2 + 2 * $m, $middle + 2 * $m, innerHeight / 2 + 6 * $m].map(Math.round).join(' ')" \
    js "$(by 0)" shot material.png js "$(by -1)" shot height.png \
    wheel "$middle" 'innerHeight / 2' -300 shot near.png drag 400 400 200 -150 shot turned.png \
    js "$(find node 2)" js 'q("picked").hidden = true' click "$middle" 'innerHeight / 2' js "$text" \
    >said 2>browse.err
report $? "clicks"
sed 's/^/# /' browse.err
grep -E '^(Element|Node|No |nothing)' said | tee got | sed 's/^/# /'
sed -n 1p got | grep -q '^Element 0 material main nodes 0 1 2 3 heights 1.0000 1.0000 1.5000 1.2500 area 200.0 m² smallest angle 90.0° slope .* measurements 2 residual, RMS 0.035 m worst -0.040 m$'
report $? "a quadrilateral and its residuals"
sed -n 2p got | grep -q '^Element 1 material irregular nodes 1 4 2 .* area 100.0 m² smallest angle 26.6° slope 1.4° measurements 1 residual, RMS 0.500 m'
report $? "a triangle"
sed -n 3p got | grep -q '^Element 2 material material 7 nodes 4 5 2 '
report $? "the other"
ok "nothing beside the mesh" grep -qx 'nothing' got
sed -n 5p got | grep -q '^Element 2 material'
report $? "an element found by its number"
sed -n 6p got | grep -q '^Node 4 x 545020.125 m y 5972000.250 m z 1.0000 m flags boundary *$'
report $? "and one of its nodes"
sed -n 7p got | grep -q '^No element 17 *$'
report $? "a number that is not there"
sed -n 8p got | grep -q '^Node 2 x 545010.125 m y 5972020.250 m z 1.5000 m flags boundary regular mesh main *$'
report $? "a node by a click"

set -- $(grep -x '[0-9 ]*' said)
quad=$1,$2 triangle=$3,$4
pixel() { python3 "$TESTS/pngpixel.py" "$@" | tr '\n' ' '; }
set -- $(pixel residual.png $quad $triangle)
true_that "a good residual is green" "$2 > $1 + 60"
true_that "a bad one is red" "$4 > $5 + 100"
set -- $(pixel material.png $quad $triangle 790,300)
true_that "the river is orange" "$1 > 200 && $1 > $3 + 80"
true_that "the floodplain light grey" "$4 > 180 && ($4 - $6) ^ 2 < 200"
true_that "nothing beside it" "$7 == 255 && $8 == 255 && $9 == 255"
! cmp -s height.png near.png && ! cmp -s near.png turned.png
report $? "the wheel and a drag show it otherwise"

# --- graphics that the browser takes away ---
gone='globalThis.gone = canvas.getContext("webgl2").getExtension("WEBGL_lose_context")'
browse page.html size 800 600 shot before.png js "$gone, gone.loseContext(), 1" \
    js 'failure.hidden' js 'gone.restoreContext(), 1' js 'failure.hidden' shot after.png >said 2>browse.err
report $? "the graphics lost and restored"
sed 's/^/# /' browse.err
printf '1\nfalse\n1\ntrue\n' >want
sed 's/^True$/true/; s/^False$/false/' said >got
same "it is said while they are gone" want got
same "and all is there again" before.png after.png

done_testing
