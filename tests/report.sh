# report.sh: numbers out of report.json, as quality -J writes it. Sourced by tests.

# value KEY [N]: the N-th number (default: the first) behind "KEY": in report.json
value() {
    awk -v key="\"$1\":" -v n="${2:-1}" '$1 == key && ++seen == n { sub(/,$/, "", $2); print $2; exit }' report.json
}

# all KEY: the number of all measurements, the last of the samples
all() {
    awk -v key="\"$1\":" '$1 == "\"worst_residuals\":" { exit } $1 == key { v = $2 }
        END { sub(/,$/, "", v); print v }' report.json
}

# measure NAME KEY: of the elements, in report.json
measure() {
    awk -v name="\"$1\":" -v key="\"$2\":" '$1 == name && $2 == "{" { on = 1 }
        on && $1 == key { sub(/,$/, "", $2); print $2; exit }' report.json
}

# under NAME LIMIT: elements in the bins of a histogram that end at the limit or before
under() {
    awk -v name="\"$1\":" -v limit="$2" '$1 == name && $2 == "{" { on = 1 }
        on && $1 == "\"worst\":" { print sum + 0; exit }
        on && $1 == "\"to\":" { to = $2 + 0 }
        on && $1 == "\"count\":" && to && to <= limit { sum += $2 }' report.json
}

# near NAME GOT WANT TOLERANCE
near() {
    true_that "$1" "(($2) - ($3)) <= ($4) && (($3) - ($2)) <= ($4)"
}
