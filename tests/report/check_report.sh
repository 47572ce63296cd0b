#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# check_report.sh worn|unworn <make_report> <folder>: makes a run's folder, its report, and opens it in Chromium;
# check_report.sh page <make_page> <folder>: the same with a page of every kind of figure; study: with that of the
# published study, from runs made of formulas.
# Returns 77 (skipped) where Python, Node or Chromium is not installed.
set -eu
here=$(dirname "$0") kind=$1 make_report=$2 folder=$3
need() { command -v "$1" 2>/dev/null || { echo "skipped: $1 is not installed" >&2; exit 77; }; }
need python3 >/dev/null
node=$(command -v node || command -v nodejs || need node)
chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome || need chromium)

rm -rf "$folder"
case $kind in
  # The title tries to be markup, a script and a place of the template.
  worn) python3 "$here/make_run.py" "$folder" --title '<script>alert("run")</script> {{charts}} & "pin"'; figures=13 ;;
  unworn) python3 "$here/make_run.py" "$folder" --unworn; figures=0 ;;
  page) "$make_report" "$folder"; exec "$node" "$here/check_page.mjs" "$chromium" "$folder/report.html" ;;
  study) "$make_report" "$folder" "$here/../../cases/paper/claims.json"; exec "$node" "$here/check_study.mjs" "$chromium" "$folder/report.html" ;;
  *) echo "unknown kind '$kind'; expected worn, unworn, page or study" >&2; exit 2 ;;
esac
"$make_report" "$folder"
exec "$node" "$here/check_report.mjs" "$chromium" "$folder/report.html" "$figures"
