#!/bin/sh
# test_judge.sh CAMPAIGN SPOIL: judge_cases.mjs must find what is spoilt in case 3, by its name.
set -eu
case "$2" in
  hole | winding) name=manifold-3d ;;
  angle) name='tip angle|tilt' ;;
  *) name=$2 ;;
esac
here="$(cd "$(dirname "$0")" && pwd)"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
"$1" 3 4 "$folder" "$2"
if node "$here/judge_cases.mjs" "$folder" >"$folder/told"; then
  echo "the judge found nothing"
  exit 1
fi
cat "$folder/told"
grep -Eq "^WRONG case 3: (.*; )?($name): " "$folder/told"
