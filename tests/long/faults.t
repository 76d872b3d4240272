#!/bin/sh
# tests/faults.t at many more places.
FAULTS=${FAULTS:-300} exec "${0%/*}/../faults.t"
