#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes docs/images/pin-on-disc.png again: runs the shipped case (quasi-static, a few seconds), opens its report in
# headless Chromium and photographs the worn disc and its contours.
#   tools/make_picture.sh [PICTURE]
# Needs Chromium and Node.
set -euo pipefail
root=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/.." && pwd -P)
picture=${1:-$root/docs/images/pin-on-disc.png}
chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome)
scratch=$(mktemp -d)
trap 'rm -rf -- "$scratch"' EXIT
"$root/abradem" run "$root/cases/pin-on-disc.toml" --set run.method=quasi_static --quiet -o "$scratch/out"
node "$root/tools/make_picture.mjs" "$chromium" "$scratch/out/report.html" "$picture"
