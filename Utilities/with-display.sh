#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause

# Runs a command with an X server of its own, whatever other servers come and go meanwhile:
#
#   Utilities/with-display.sh ctest --preset developer
#
# xvfb-run looks for a number that is free and then starts the server, so two of them may take the same.
# Here the server takes the number (-displayfd).
set -euo pipefail

if (($# == 0)); then
  echo "usage: Utilities/with-display.sh COMMAND [ARGUMENT...]" >&2
  exit 2
fi

folder=$(mktemp --directory)
server=
clean_up() {
  if [[ -n $server ]]; then
    kill "$server" 2>/dev/null || true
    wait "$server" 2>/dev/null || true
  fi
  rm -rf "$folder"
}
trap clean_up EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

# Only who has the cookie may connect. A server takes all cookies of its file, whatever their display.
export XAUTHORITY=$folder/authority
cookie=$(od --address-radix=n --format=x1 --read-bytes=16 /dev/urandom | tr --delete ' \n')
: >"$XAUTHORITY"
xauth -q add :0 . "$cookie"

# Without -noreset the server restarts whenever its last client disconnects, and refuses clients that
# connect meanwhile.
mkfifo "$folder/number"
Xvfb -displayfd 3 -auth "$XAUTHORITY" -screen 0 1280x1024x24 -noreset -nolisten tcp \
  3>"$folder/number" >"$folder/log" 2>&1 &
server=$!
number=
read -r -t 60 number <"$folder/number" || true
if [[ -z $number ]]; then
  echo "error: Xvfb does not start (apt-get install xvfb):" >&2
  cat "$folder/log" >&2
  exit 1
fi
xauth -q add ":$number" . "$cookie"
export DISPLAY=:$number
"$@"
