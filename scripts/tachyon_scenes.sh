#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Prints the folder with the scenes of Debian's tachyon-doc package. Where a slim system has left the files out at
# install, they are taken from the package file itself. Fails where the package cannot be had.
set -euo pipefail
cd "$(dirname "$0")/.."

installed=/usr/share/doc/tachyon/examples/scenes
unpacked=$PWD/build/tachyon-doc
if [ -f "$installed/balls.dat" ]; then
  echo "$installed"
elif [ -f "$unpacked$installed/balls.dat" ]; then
  echo "$unpacked$installed"
else
  mkdir -p "$unpacked"
  (cd "$unpacked" && apt-get download -qq tachyon-doc >&2 && dpkg-deb -x tachyon-doc_*.deb . && rm tachyon-doc_*.deb)
  echo "$unpacked$installed"
fi
