#!/bin/sh
# hybridmesh(5): its examples are read, its filters run.
. "${0%/*}/tap.sh"

page=$TESTS/../man/hybridmesh.5

# Every literal block of the page as a file block1, block2 …
sed -e 's/\\&//g' -e 's/\\-/-/g' -e 's/\\e/\\/g' "$page" |
    awk '/^\.Bd -literal/ { name = "block" ++n; next } /^\.Ed/ { name = ""; next } name { print > name }'

for kind in points grid lines mesh; do
    block=$(grep -l "^#hm 1 $kind text" block*)
    ok "the example of $kind is read" hmconv --strict -o out "$block"
    # what the example leaves out, the program writes
    grep -v '^#fields x y z$' "$block" >want
    grep -v '^#fields x y z$' out >got
    same "the example of $kind is what the programs write" want got
done

# --- the filter in awk ---
mv "$(grep -l '^# window' block*)" window
awk 'BEGIN { for (i = 0; i < 1000; i++) print 545000 + i % 37 * 20, 5972000 + i % 41 * 15, i / 8 }' >all.xyz
awk '$1 >= 545000 && $1 <= 545500 && $2 >= 5972000 && $2 <= 5972400' all.xyz >some.xyz
hmconv all.xyz | awk -f window w=545000 e=545500 s=5972000 n=5972400 >filtered
hmconv -t xyz filtered >got.xyz
ok 'it filters' test -s some.xyz
same 'just the points of the window' some.xyz got.xyz
ok 'it says so in the history' grep -qx '#prog window 545000 545500 5972000 5972400' filtered
printf '#hm 1 lines text\n#fields x y z\n#data\n>\n1 2 3\n4 5 6\n#end 1\n' >lines.hm
awk -f window w=0 e=1 s=0 n=1 lines.hm >got
same 'it leaves lines alone' lines.hm got
must_fail 'it refuses binary' 2 'text only' sh -c 'hmconv -b all.xyz | awk -f window w=0 e=1 s=0 n=1'

# --- the filter in C ---
mv "$(grep -l '^/\* raise' block*)" raise.c
ok 'it compiles' cc -std=c99 -Wall -Wextra -Werror -o raise raise.c
printf '#hm 1 points text\n#fields x y z class\n#crs UTM 32N\n#data\n1 2.5 3 9\n-4 5e5 6.25 2\n7 8 nan 1\n#end 3\n' >p.hm
printf '#hm 1 points text\n#fields x y z class\n#crs UTM 32N\n#prog raise 0.5\n#data\n1 2.5 3.5 9\n-4 5e5 6.75 2\n7 8 nan 1\n#end 3\n' >want
ok 'it takes text' sh -c './raise 0.5 <p.hm >got'
same 'it raises points in text' want got
hmconv want >text.hm
ok 'it takes binary' sh -c 'hmconv -b p.hm | ./raise 0.5 | hmconv --strict >got'
same 'it raises them in binary just so' text.hm got
ok 'it notices that a stream was cut off' \
    sh -c 'hmconv -b p.hm | head -c 120 | ./raise 0.5 >cut; [ $? -eq 2 ]'
done_testing
