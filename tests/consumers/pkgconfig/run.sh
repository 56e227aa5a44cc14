#!/bin/sh
# Compiles one file as its first comment says, against an installed tree that was moved, and runs it.
# Arguments: the file, a folder to work in. Environment: PREFIX, LIBDIR, CC, CFLAGS.
set -eu
source=$1
work=$2

rm -rf "$work"
mkdir -p "$work"
cp -R "$PREFIX" "$work/moved"
export PKG_CONFIG_PATH="$work/moved/$LIBDIR/pkgconfig"

# shellcheck disable=SC2046,SC2086 # flags are words
"$CC" -std=c99 $CFLAGS "$source" -o "$work/hello" $(pkg-config --cflags --libs mvs)
LD_LIBRARY_PATH="$work/moved/$LIBDIR" "$work/hello"

version=$(pkg-config --modversion mvs)
"$work/moved/bin/mvs" --version | grep -F "libmvs $version"
