# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash disable=SC2154
# What ./abradem, ./test and .ci/run share: install what is missing, configure, build. Sourced, never run.
# The caller sets `program` (the name in messages) and `root` (the source folder). Messages go to stderr.
# Nothing here changes the current folder, so relative paths on the command line stay the user's.

say() { printf '%s: %s\n' "$program" "$*" >&2; }

# die CODE MESSAGE…: exit codes are those of docs/reference/exit-codes.md.
die() {
  local code=$1
  shift
  say "$@"
  exit "$code"
}

# missing_packages LIST…: prints one package per line that a list names and dpkg does not have.
missing_packages() {
  local line alternative first found
  while IFS= read -r line; do
    line=${line%%#*}
    first='' found=no
    for alternative in ${line//|/ }; do
      first=${first:-$alternative}
      if [[ " $installed_packages " == *" $alternative "* ]]; then found=yes; fi
    done
    if [[ -n $first && $found == no ]]; then printf '%s\n' "$first"; fi
  done < <(cat -- "$@")
}

# read_installed_packages LIST…: sets installed_packages to those of the lists that dpkg has; one dpkg call.
read_installed_packages() {
  local -a names=()
  mapfile -t names < <(sed -e 's/#.*//' -e 's/|/ /g' -- "$@" | tr -s ' \t' '\n' | sed '/^$/d')
  # dpkg-query fails when a name is unknown; that is an answer, not an error.
  installed_packages=$(dpkg-query -W -f='${db:Status-Abbrev} ${Package}\n' "${names[@]}" 2>/dev/null |
    awk '$1 == "ii" { printf "%s ", $2 }' || true)
}

# install_packages LIST…: nothing missing, no apt call. Root installs at once; others are asked.
install_packages() {
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    say "this is not a Debian-like system: going on with the libraries that CMake finds." \
      "Needed (Debian's names): $(sed -e 's/#.*//' -e 's/ *|.*//' -e '/^$/d' -- "$@" | tr '\n' ' ')"
    return
  fi
  local -a missing=()
  read_installed_packages "$@"
  mapfile -t missing < <(missing_packages "$@")
  if ((${#missing[@]} == 0)); then return; fi

  local -a as_root=()
  if (($(id -u) != 0)); then
    say "missing: ${missing[*]}"
    say "to install: sudo apt-get install --no-install-recommends ${missing[*]}"
    if [[ ! -t 0 ]]; then die 2 "no terminal to ask on; run the line above, then start again."; fi
    if ! command -v sudo >/dev/null; then die 2 "sudo is not here; run the line above as root, then start again."; fi
    local answer
    read -r -p "$program: run it now? [Y/n] " answer || answer=n
    case $answer in
      '' | [Yy]*) as_root=(sudo) ;;
      *) die 2 "nothing was installed; run the line above, then start again." ;;
    esac
  fi
  say "installing ${#missing[@]} Debian package(s): ${missing[*]}"
  apt_get update
  apt_get install --yes --no-install-recommends "${missing[@]}"
}

# apt_get ARGUMENT…: with the caller's as_root, quietly; what it said is shown when it fails.
apt_get() {
  local log
  log=$(mktemp)
  if ! "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get -q -o DPkg::Lock::Timeout=300 "$@" >"$log" 2>&1 </dev/null; then
    tail -n 20 "$log" >&2
    rm -f -- "$log"
    die 5 "apt-get $1 failed; the end of what it said is above."
  fi
  rm -f -- "$log"
}

# source_state: what a build depends on besides the files' times.
source_state() {
  printf '%s\n' "$root" "$1" "$(git -C "$root" rev-parse HEAD 2>/dev/null || printf 'no commit')"
}

# is_built BUILD WHAT BINARY: true when nothing changed since the build of WHAT that made the stamp.
is_built() {
  local build=$1 what=$2 binary=$3 newer
  [[ -x $binary && -f $build/stamp && $(<"$build/stamp") == "$(source_state "$what")" ]] || return 1
  # A new or deleted file changes its folder's time.
  newer=$(find "$root/src" "$root/report" "$root/cmake" "$root/CMakeLists.txt" "$root/CMakePresets.json" \
    "$root/packaging" -newer "$build/stamp" -print -quit 2>/dev/null) || true
  [[ -z $newer ]]
}

# lock BUILD: one build at a time in a folder; waits for the other. Released by unlock.
lock() {
  if ! mkdir -p -- "$1" 2>/dev/null || ! { exec 9>"$1/lock"; } 2>/dev/null; then
    die 5 "cannot write to $1; set ABRADEM_BUILD_DIR to a folder that you can write to."
  fi
  if ! flock -n 9; then
    say "another build is at work in $1; waiting for it"
    flock 9
  fi
}
unlock() { exec 9>&-; }

# quietly LOG PHASE COMMAND…: one line per phase; the end of the log when it fails.
quietly() {
  local log=$1 phase=$2
  shift 2
  say "$phase"
  if ! "$@" >"$log" 2>&1 </dev/null; then
    printf '\n' >&2
    # A compiler's first error says more than the last lines after it.
    grep -n -m 5 -E '(^|: )(fatal )?error:|CMake Error' "$log" >&2 || true
    printf '%s\n' '...' >&2
    tail -n 30 "$log" >&2
    die 1 "$phase: failed; the whole log is $log"
  fi
}

# build_preset BUILD PRESET TARGET: configures (CMakePresets.json) and builds into BUILD.
build_preset() {
  local build=$1 preset=$2 target=$3 started=$SECONDS
  # A folder configured for another place (a copied or moved checkout) cannot be reused.
  if [[ -f $build/CMakeCache.txt ]] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$build/CMakeCache.txt"; then
    rm -rf -- "$build/CMakeCache.txt" "$build/CMakeFiles"
  fi
  # The stamp carries the time before the build: a file saved meanwhile is newer.
  source_state "$target" >"$build/stamp.new"
  quietly "$build/configure.log" configuring cmake -S "$root" -B "$build" --preset "$preset"
  quietly "$build/build.log" "building (the first time takes a minute or two)" \
    cmake --build "$build" --target "$target" --parallel "$(nproc)"
  mv -f -- "$build/stamp.new" "$build/stamp"
  say "built in $((SECONDS - started)) s"
}
