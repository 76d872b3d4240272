#!/bin/sh
# The generated survey: is its truth true, are its errors those it was asked for?
. "${0%/*}/tap.sh"

ok "default survey" hmsurvey a
ok "again" hmsurvey b
for f in survey.xyz lines.txt true_lines.txt true_surface.asc; do
    same "same bytes: $f" a/$f b/$f
done
ok "another seed" hmsurvey -S 2 c
same "another seed, the same truth" a/true_surface.asc c/true_surface.asc
! cmp -s a/survey.xyz c/survey.xyz
report $? "another seed, other points"

n=$(wc -l <a/survey.xyz)
true_that "enough points for the demo" "$n >= 250000"

# residuals against the truth
hmsurvey --true <a/survey.xyz | paste -d ' ' - a/survey.xyz >pairs
awk '{ r = $6 - $3 } r > 1.5 || r < -1.5 { blunders++; next } { n++; sum += r; square += r * r }
     END { m = sum / n; printf "%d %.5f %.5f\n", blunders, m, sqrt(square / n - m * m) }' pairs >residuals
read -r blunders mean sigma <residuals
true_that "blunders" "$blunders == 30"
true_that "mean of the noise" "$mean > -0.0005 && $mean < 0.0005"
true_that "sigma of the noise" "$sigma > 0.0495 && $sigma < 0.0505"

# away from water and gaps there are several points a square metre; along the tile border none
awk '{ x = $1 - 545000; y = $2 - 5972000 }
     x > 20 && x < 60 && y > 160 && y < 190 { n++ }
     x > 199 && x < 201 && y > 20 && y < 40 { gap++ }
     END { printf "%.3f %d\n", n / 1200, gap }' a/survey.xyz >density
read -r density gap <density
true_that "density of 2.5" "$density > 2.35 && $density < 2.65"
true_that "nothing in the gap" "$gap == 0"

# the wetted bed of the main river has soundings only, about one in 20 m²
awk '$3 - (6 - 0.0008 * ($1 - 545000) + 0.0012 * ($2 - 5972000)) < -3.4' pairs >bed
true_that "soundings on the bed" "$(wc -l <bed) > 400 && $(wc -l <bed) < 1200"

# true lines lie on the surface, and the surface breaks there: its second difference across
grep -v '^>' a/true_lines.txt >true_vertices
hmsurvey --true <true_vertices | paste -d ' ' - true_vertices |
    awk '{ d = $3 - $6 } d > 2e-4 || d < -2e-4 { bad++ } END { print bad + 0 }' >off
true_that "true lines on the true surface" "$(cat off) == 0"
awk '/^>/ { toe = /kind=toe/; n = 0; next }
     { if (n++) { dx = $1 - x; dy = $2 - y; l = sqrt(dx * dx + dy * dy); mx = (x + $1) / 2; my = (y + $2) / 2
         for (k = -1; k <= 1; k++) printf "%.4f %.4f %d\n", mx - k * 0.2 * dy / l, my + k * 0.2 * dx / l, toe }
       x = $1; y = $2 }' a/true_lines.txt >across
hmsurvey --true <across | paste -d ' ' - across |
    awk '{ z[NR % 3] = $3 } NR % 3 == 0 { n++; s = z[1] + z[0] - 2 * z[2]; if ($6 ? s > 0.03 : s < -0.03) good++ }
         END { print good / n }' >breaks
true_that "hollow at toes, ridged at crests" "$(cat breaks) > 0.98"
for what in "toe of=main" "crest of=main" "toe of=tributary" "crest of=levee" "toe of=levee" "crest of=ditch"; do
    ok "true lines know the $what" grep -q "^> kind=$what side=left" a/true_lines.txt
done

# the grid is the surface: its first node is the north-west one
awk 'NR == 6 { print $1; exit }' a/true_surface.asc >corner
echo 545000 5972320 | hmsurvey --true | awk '{ printf "%.4f\n", $3 }' >answer
same "first node of the true grid" corner answer

# rough lines: of every role, and beside the true crests by what a user's hand errs
for role in surface=main surface=tributary surface=levee face=levee boundary=1 string=inflow string=outflow; do
    ok "rough lines have $role" grep -q "^> $role" a/lines.txt
done
awk 'FNR == NR { if (/^>/) on = /kind=crest of=main side=right/; else if (on) { x[++n] = $1; y[n] = $2 } next }
     /^>/ { on = /surface=main side=right/; next }
     on { best = 1e9
          for (i = 1; i <= n; i++) { d = sqrt(($1 - x[i]) ^ 2 + ($2 - y[i]) ^ 2); if (d < best) best = d }
          if (best > far) far = best; if (best < close_) close_ = best; v++ }
     BEGIN { close_ = 1e9 } END { printf "%d %.2f %.2f\n", v, close_, far }' a/true_lines.txt a/lines.txt >hand
read -r clicks least most <hand
true_that "clicks on a bank" "$clicks >= 8 && $clicks <= 30"
true_that "metres off, as a user is" "$least > 0.2 && $most > 1.5 && $most < 4"

# boundary strings lie across the rivers' ends, which reach through the outline
awk '/^>/ { on = /string=/; next } on && $1 != 545006 && $1 != 545474 && $2 != 5972314 { bad++ } on { n++ }
     END { print n + 0, bad + 0 }' a/lines.txt >strings
read -r clicks off <strings
true_that "boundary strings across the ends of the rivers" "$clicks == 6 && $off == 0"

# options
ok "small survey" hmsurvey -n 20000 -b 0 -s 0 d
true_that "of the wanted size" "$(wc -l <d/survey.xyz) > 15000 && $(wc -l <d/survey.xyz) < 20500"
hmsurvey --true <d/survey.xyz | paste -d ' ' - d/survey.xyz >exact
awk '{ r = $6 - $3 } (r > 0.005 || r < -0.005) && $2 { bad++ } END { print bad / NR }' exact >wrong
true_that "without noise LiDAR is the truth" "$(cat wrong) < 0.01"
must_fail "no folder" 2 "missing" hmsurvey
must_fail "a word for a number" 2 "number" hmsurvey -n many e
must_fail "a word for a coordinate" 2 "expected x and y" sh -c 'echo one two | hmsurvey --true'
must_fail "a folder that cannot be" 2 "No such" hmsurvey no/such/folder

done_testing
