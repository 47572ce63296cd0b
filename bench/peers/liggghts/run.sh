#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The same pin-on-disc work for LIGGGHTS and for Abradem, one core each, on about 150,000 triangles; prints
# one table. What had to be set for LIGGGHTS, and what is compared: bench/peers/README.md.
#   bench/peers/liggghts/run.sh [STEPS]     steps timed for LIGGGHTS (default 500)
set -euo pipefail

here=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")" && pwd -P)
root=$(cd -- "$here/../../.." && pwd -P)
steps=${1:-500}
size=0.0923 # mm: 149,800 triangles between 20 and 24 mm
skin=1e-4   # m: the fastest of 0.02, 0.1 and 0.3 mm to within 5 %; the list is rebuilt every 50 steps

scratch=$(mktemp -d)
trap 'rm -rf -- "$scratch"' EXIT

row() { printf '%-28s %12s %12s   %s\n' "$@"; }

# us_per_step STEPS_PER_SECOND
us_per_step() { awk -v rate="$1" 'BEGIN { printf "%.4g", 1e6 / rate }'; }

# time_liggghts NAME MESH_STYLE MESH_OPTIONS
time_liggghts() {
  local log=$scratch/liggghts.log rate force
  # Line by line, or what it says before it aborts is lost.
  if ! OMP_NUM_THREADS=1 stdbuf -oL liggghts -log none -in "$here/in.pin_on_disc" -var disc "$scratch/disc.stl" \
    -var mesh_style "$2" -var mesh_options "$3" -var skin "$skin" -var warmup 50 -var steps "$steps" \
    >"$log" 2>&1 </dev/null; then
    row "$1" - - "stopped: $(grep -a -m 1 ERROR "$log" || tail -n 1 "$log")"
    return
  fi
  # The last `Loop time of T on 1 procs for N steps` is the timed run.
  rate=$(awk '/^Loop time of/ { rate = $9 / $4 } END { printf "%.4g", rate }' "$log")
  force=$(awk 'NF == 6 && $1 ~ /^[0-9]+$/ { force = $6 } END { printf "%.3f", force }' "$log")
  row "$1" "$rate" "$(us_per_step "$rate")" "mean normal force $force N"
}

# time_abradem NAME RUN_END METHOD NOTE
time_abradem() {
  local out=$scratch/out rate
  rm -rf -- "$out"
  if ! OMP_NUM_THREADS=1 "$root/abradem" run "$root/cases/pin-on-disc.toml" -o "$out" --threads 1 --quiet \
    --set run.end="$2" --set run.method="$3" --set run.time_step="1.4e-5 s" \
    --set wall.disc.mesh.size="$size mm" >"$scratch/abradem.log" 2>&1 </dev/null; then
    row "$1" - - "failed: $(tail -n 1 "$scratch/abradem.log")"
    return
  fi
  rate=$(python3 -c 'import json, sys; print("%.4g" % json.load(open(sys.argv[1]))["steps_per_second"])' \
    "$out/run.json")
  row "$1" "$rate" "$(us_per_step "$rate")" "$4"
}

row code steps/s us/step note
if command -v liggghts >/dev/null; then
  python3 "$here/make_disc.py" 20 24 "$size" "$scratch/disc.stl" >/dev/null
  time_liggghts "LIGGGHTS, no wear" mesh/surface "curvature 0.256" # the default: an option must be named
  time_liggghts "LIGGGHTS, Finnie" mesh/surface/stress "stress on wear finnie"
else
  row LIGGGHTS - - "not installed (Debian: apt-get install liggghts)"
fi
time_abradem "Abradem, dynamic" "1 rev" dynamic "Archard wear, shape updated"
time_abradem "Abradem, quasi_static" "1 rev" quasi_static "its steps are longer: compare seconds per revolution"
