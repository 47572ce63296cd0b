#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# check_plots.sh <make_page> <make_study> <folder>: draws the figures of a page, a study and a run for print, and looks at
# what came out.
# The message where matplotlib is missing is tested everywhere; the rest returns 77 (skipped) without it.
set -eu
here=$(dirname "$0") make_page=$1 make_study=$2 folder=$3
script=$here/../../scripts/plot_paper.py
command -v python3 >/dev/null || { echo "skipped: python3 is not installed" >&2; exit 77; }
rm -rf "$folder" && mkdir -p "$folder"
"$make_page" "$folder/page" >/dev/null
"$make_study" "$folder/study" "$here/../../cases/paper/claims.json" >/dev/null

mkdir "$folder/none" && echo 'raise ImportError("hidden by the test")' >"$folder/none/matplotlib.py"
code=0; PYTHONPATH=$folder/none python3 "$script" "$folder/page" 2>"$folder/message" || code=$?
[ $code = 2 ] && grep -q 'needs matplotlib.*apt install python3-matplotlib' "$folder/message" ||
  { echo "FAIL without matplotlib: code $code, $(cat "$folder/message")" >&2; exit 1; }

python=
for candidate in python3 /usr/bin/python3; do
  "$candidate" -c 'import matplotlib' 2>/dev/null && { python=$candidate; break; }
done
[ -n "$python" ] || { echo "skipped: matplotlib is not installed" >&2; exit 77; }
exec "$python" "$here/check_plots.py" "$script" "$folder"
