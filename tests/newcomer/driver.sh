# Somebody with a device and no driver for it: the installed template, built and tested.
set -eu
sdk=$(pkg-config --variable=prefix mvs)
cp "$sdk/share/doc/libmvs/haptic_drivers/template.c" mine.c
cc -std=c11 -shared -fPIC $(pkg-config --cflags mvs) mine.c -o mine.so
mvs haptics list
mvs haptics test --driver ./mine.so --seconds 1
