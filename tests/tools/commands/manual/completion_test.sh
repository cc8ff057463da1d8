#!/usr/bin/env bash
# What bash offers behind `jarol`, as it completes by the script that the build has made: usage SCRIPT.
set -u
source "$1"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
touch dive.yaml hover.yaml dive.mcap "two words.mcap" mine.so notes.txt
mkdir specs
wrong=0

# offers EXPECTED WORD...: these words of a line, of which the last is not whole, are offered the expected, sorted
offers() {
  local expected=$1 found
  shift
  COMP_WORDS=(jarol "$@")
  COMP_CWORD=$#
  COMPREPLY=()
  _jarol
  found=$(printf '%s\n' "${COMPREPLY[@]}" | sort | tr '\n' '|')
  if [ "$found" != "$expected" ]; then
    echo "jarol $* is offered '$found', not '$expected'"
    wrong=1
  fi
}

offers "campaign|check|console|" c
offers "help|" he
offers "replay|run|" help r
offers "--resume|" run --res
offers "real|virtual|" run dive.yaml --clock ""
offers "real|" run dive.yaml --clock re
offers "real|" run --clock = re
offers "real|virtual|" run --clock =
# one file, by the ending that the command reads
offers "dive.yaml|hover.yaml|specs|" run ""
offers "hover.yaml|" run h
offers "|" run dive.yaml ""
offers "dive.yaml|hover.yaml|specs|" check dive.yaml ""
offers "dive.mcap|specs|two words.mcap|" replay ""
offers "dive.yaml|hover.yaml|specs|" replay dive.mcap ""
offers "dive.yaml|hover.yaml|specs|" replay --set a=b dive.mcap ""
offers "dive.yaml|hover.yaml|specs|" replay --set = b dive.mcap ""
offers "two words.mcap|" replay "two w"
offers "mine.so|specs|" tasks --plugin ""
offers "info|" log in
offers "dive.mcap|specs|two words.mcap|" log info ""
offers "lz4|" run dive.yaml --record-compression l
# a flag takes no value, and what an option is not known to take is not guessed
offers "dive.yaml|hover.yaml|specs|" run --json ""
offers "|" run --profile ""
offers "DepthControl|" tasks DepthC
offers "specs|" new s
offers "|" nothing ""
exit $wrong
