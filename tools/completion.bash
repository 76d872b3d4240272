# Completion in bash for the programs of hybridmesh: the options that --help lists, the words that an
# option takes where the help names them (`--mode interp|node|curvature`), and files otherwise.

_hybridmesh() {
    local help words
    COMPREPLY=()
    help=$("$1" --help 2>/dev/null) || return
    words=$(awk -v option="$3" '
        /^ +-/ {
            gsub(/,/, " ")
            for (i = 1; i <= NF && $i ~ /^-/; i++)
                if ($i == option) found = NR
            if (found == NR && $i ~ /^[a-z0-9]+(\|[a-z0-9]+)+$/) { gsub(/\|/, " ", $i); print $i }
        }' <<<"$help")
    if [[ $2 == -* ]]; then
        words=$(grep -oE '^ +(-., +)?--[a-z0-9-]+' <<<"$help" | grep -oE '\-\-[a-z0-9-]+')
    elif [[ -z $words ]]; then
        mapfile -t COMPREPLY < <(compgen -f -- "$2")
        compopt -o filenames 2>/dev/null
        return
    fi
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$2")
}

complete -F _hybridmesh bsgrid slope breaklines bsmesh trimesh stitch quality georef hmconv hmdraw
