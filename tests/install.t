#!/bin/sh
# make install puts everything where it belongs, under other names when asked; the seven programs of
# the scheme need libc, libm and threads, nothing else; bash completes their options.
. "${0%/*}/tap.sh"

scheme="bsgrid slope breaklines bsmesh trimesh stitch quality"
if [ "${B##*/}" = san ]; then
    skip "the build with sanitizers is not installed"
    done_testing
fi

ok "make install" make -s -C "$TESTS/.." install DESTDIR="$WORK/root" PREFIX=/usr PROGPREFIX=hm-
for tool in $scheme; do
    ok "hm-$tool runs" root/usr/bin/hm-$tool --version
    ok "and has a page and a completion" test -s root/usr/share/man/man1/hm-$tool.1 -a \
        -s root/usr/share/bash-completion/completions/hm-$tool
done
ok "hybridmesh(5) and (7)" test -s root/usr/share/man/man5/hybridmesh.5 -a -s root/usr/share/man/man7/hybridmesh.7

if command -v ldd >/dev/null; then
    for tool in $scheme; do
        ldd root/usr/bin/hm-$tool | awk '{ print $1 }' |
            grep -Ev '^(linux-vdso|linux-gate|/lib.*ld-|libc\.|libm\.|libpthread\.)' >more
        ok "$tool needs libc, libm and threads only" test ! -s more
    done
else
    skip "no ldd"
fi

# completes COMMAND WORD BEFORE: what bash offers
completes() {
    bash -c '. "$1"; _hybridmesh "$2" "$3" "$4"; echo "${COMPREPLY[*]}"' - "$TESTS/../tools/completion.bash" "$@"
}
if command -v bash >/dev/null; then
    ok "options complete" test "$(completes breaklines --mi x)" = --min-length
    ok "and the words that they take" test "$(completes breaklines '' --mode)" = "interp node curvature"
    ok "by their letters, too" test "$(completes bsgrid me -m)" = "mean median"
    touch survey.xyz
    ok "files otherwise" test "$(completes bsgrid surv -o)" = survey.xyz
else
    skip "no bash"
fi

done_testing
