# shellcheck shell=bash disable=SC2034 # the lists of packages are for the scripts that source this
# Sourced by demo, test, wheel: takes a fresh Debian 12 or Ubuntu 22.04 to where libmvs builds.
# Installs only what is missing, from Debian's packages and PyPI; safe to repeat.
set -euo pipefail

# A script's usage is the comment at its top, before any work begins.
case ${1-} in
  -h | --help)
    sed -n '2,/^[^#]/{/^# shellcheck/d; s/^# \{0,1\}//p}' "$0"
    exit
    ;;
esac
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# One line that says what happens now.
say() { printf '\n== %s\n' "$*"; }

# Refuses options that a script does not have, before it begins: known_options "--test --long" "$@".
known_options() {
  local argument
  for argument in "${@:2}"; do
    case $argument in
      -*) [[ " $1 " == *" $argument "* ]] || give_up "unknown option $argument; $0 --help lists all" ;;
    esac
  done
}

# The last line of a failed set-up: what is wrong and what to do.
give_up() {
  printf '\n%s: %s\n' "$0" "$*" >&2
  exit 1
}

missing_packages() {
  local package
  for package in "$@"; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || echo "$package"
  done
}

# Installs those of the named packages that are missing; asks for root only if there are any.
install_packages() {
  if ! command -v dpkg-query >/dev/null; then
    say "This is neither Debian nor Ubuntu: going on with what is installed (needed: $*)"
    return
  fi
  local missing root=()
  mapfile -t missing < <(missing_packages "$@")
  if [ ${#missing[@]} -eq 0 ]; then return; fi
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
      give_up "please run this as root, then start again: apt-get install ${missing[*]}"
    root=(sudo)
  fi
  say "Installing ${#missing[@]} Debian packages: ${missing[*]}"
  "${root[@]}" apt-get -q update
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y --no-install-recommends install \
    "${missing[@]}" || give_up "apt-get could not install: ${missing[*]}"
}

# Runs a command as root: as_root COMMAND ...
as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  else
    command -v sudo >/dev/null || give_up "please start this as root, which it needs for: $*"
    sudo "$@"
  fi
}

build_packages=(build-essential cmake ninja-build pkg-config libeigen3-dev
  libhdf5-dev libcli11-dev nlohmann-json3-dev zlib1g-dev)
python_packages=(python3 python3-dev python3-venv libgl1 libegl1 libxrender1)
test_packages=(libsuitesparse-dev abigail-tools doctest-dev libtinyobjloader-dev libccd-dev libspnav0
  libglfw3-dev locales xvfb xauth xdotool clang clang-format clang-tidy git)

# How many files are compiled as one (cmake/unity.cmake): one by one unless scripts/demo, the short gate or a
# sanitizer sets it.
files_as_one=
# CMake options of every build_preset of a script: a tree configured another way compiles again.
options_of_all=()

# Configures a preset: configure_preset NAME [CMAKE OPTION ...]; its log is build/NAME.log. Where another
# compiler is found than that of the tree, as with ccache's folder in PATH, CMake begins the tree anew and drops
# all options: a build without sanitizers would pass for one with them. So it is configured once more.
configure_preset() {
  local log=build/$1.log dropped='variables that require your cache to be deleted'
  cmake --preset "$@" >"$log" 2>&1 && ! grep -q "$dropped" "$log" && return
  if grep -q "$dropped" "$log"; then
    rm -rf "build/$1/CMakeCache.txt" "build/$1/CMakeFiles"
    cmake --preset "$@" >"$log" 2>&1 && return
  fi
  cat "$log" >&2
  return 1
}

# Configures and builds a preset of CMakePresets.json: build_preset NAME [CMAKE OPTION ...] [-- BUILD
# OPTION ...]. The short gate, the demo and sanitizers compile files together with precompiled headers,
# everything else compiles them one by one, with ccache where it is installed.
build_preset() {
  local preset=$1 launcher=(-DMVS_PRECOMPILED= -DMVS_UNITY=) options=()
  shift
  while [ $# -gt 0 ] && [ "$1" != -- ]; do
    options+=("$1")
    shift
  done
  if [ -n "$files_as_one" ]; then
    launcher=(-DMVS_PRECOMPILED=all "-DMVS_UNITY=$files_as_one"
      -DCMAKE_C_COMPILER_LAUNCHER= -DCMAKE_CXX_COMPILER_LAUNCHER=)
  elif command -v ccache >/dev/null; then
    launcher+=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  elif [ -z "${long:-}" ]; then
    launcher=(-DMVS_PRECOMPILED=all -DMVS_UNITY=)
  fi
  mkdir -p build
  configure_preset "$preset" "${launcher[@]}" "${options_of_all[@]}" "${options[@]}" || return 1
  cmake --build --preset "$preset" "${@:2}"
}

# What the package, its build and the named extras need, as pyproject.toml says: python_needs EXTRA ...
python_needs() {
  .venv/bin/python - "$@" <<'PYTHON'
import sys

try:
    import tomllib
except ModuleNotFoundError:  # before Python 3.11
    from pip._vendor import tomli as tomllib

with open("pyproject.toml", "rb") as file:
    told = tomllib.load(file)
extras = told["project"]["optional-dependencies"]
lists = [told["build-system"]["requires"], told["project"]["dependencies"]]
print(*sum(lists + [extras[name] for name in sys.argv[1:]], []), sep="\n")
PYTHON
}

# Makes .venv once with what the named extras need: make_venv EXTRA ... [-- PIP OPTION ...]
make_venv() {
  local extras=() needs
  while [ $# -gt 0 ] && [ "$1" != -- ]; do
    extras+=("$1")
    shift
  done
  [ -x .venv/bin/pip ] || "${PYTHON:-python3}" -m venv .venv || return 1
  echo "pip installs what the Python module needs into .venv: a minute or two the first time"
  needs=$(python_needs "${extras[@]}") || return 1
  mapfile -t needs <<<"$needs"
  .venv/bin/pip install --quiet --disable-pip-version-check "${needs[@]}" "${@:2}"
}

# Has .venv import the Python module of the release tree, which compiles nothing of the library a
# second time, and run the commands mvs, of that tree, and mvs-image: python_module [TARGET ...] builds
# other targets beside it.
python_module() {
  local site
  build_preset release -DMVS_PYTHON=ON "-DPython_EXECUTABLE=$PWD/.venv/bin/python" \
    "-Dpybind11_DIR=$(.venv/bin/python -m pybind11 --cmakedir)" -- --target mvs_python "$@" || return 1
  # an installed one would be found before it
  .venv/bin/pip uninstall --quiet --yes libmvs 2>/dev/null
  site=$(.venv/bin/python -c 'import sysconfig; print(sysconfig.get_path("platlib"))') || return 1
  echo "$PWD/build/release/python" >"$site/libmvs.pth"
  ln -sf "$PWD/build/release/bin/mvs" .venv/bin/mvs || return 1
  printf '%s\n' "#!$PWD/.venv/bin/python" 'from mvs.imaging.command import main' 'raise SystemExit(main())' \
    >.venv/bin/mvs-image && chmod +x .venv/bin/mvs-image
}
