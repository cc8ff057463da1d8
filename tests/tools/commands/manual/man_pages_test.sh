#!/usr/bin/env bash
# groff reads each man page without a word of warning, and shows each option that --help does: usage FOLDER JAROL.
set -euo pipefail
wrong=0
for page in "$1"/*.1; do
  name=$(basename "$page" .1)
  shown=$(groff -man -Tutf8 -P-c -ww -rHY=0 "$page" 2>&1 >/dev/null)
  if [ -n "$shown" ]; then
    echo "$name: $shown"
    wrong=1
  fi
  text=$(groff -man -Tascii -P-cbou -rLL=500n "$page" 2>/dev/null)
  command=${name#jarol}
  while read -r option; do
    if ! grep -qE -- "(^|[ ,])$option( |$|,)" <<<"$text"; then
      echo "$name does not show $option"
      wrong=1
    fi
  done < <("$2" ${command#-} --help | grep -oE '^  -[^ ]*' | tr ',' '\n' | tr -d ' ')
done
count=$(find "$1" -name '*.1' | wc -l)
# --help lists the commands
commands=$("$2" --help | sed -n '/^Subcommands/,$p' | grep -cE '^  [a-z]')
if [ "$count" -ne $((commands + 1)) ]; then
  echo "there are $count pages for $commands commands"
  wrong=1
fi
exit $wrong
