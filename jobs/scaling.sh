#!/usr/bin/env bash
# Strong scaling of one mesh: runs it on growing numbers of processes, one thread each, and makes the table and plot.
#
#   jobs/scaling.sh INPUT OUTPUT_DIRECTORY [RANKS] [OPTIONS OF hexfield run...]      RANKS: 1,2,4 (default: 1,2,... cores)
#
# For weak scaling, refine the input with `hexfield convert IN OUT --refine K` and run each on 8^K times the processes.
# HEXFIELD names the program (default: hexfield from PATH, else build/release).
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
if [ $# -lt 2 ]; then
  sed -n '2,7s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
  exit 2
fi
input=$1
output=$2
shift 2
ranks=""
if [[ "${1:-}" =~ ^[0-9]+(,[0-9]+)*$ ]]; then
  ranks=$1
  shift
else
  for ((n = 1; n <= $(nproc); n *= 2)); do ranks+="${ranks:+,}$n"; done
fi
hexfield=${HEXFIELD:-$(command -v hexfield || echo "$top/build/release/apps/hexfield")}
. "$top/jobs/mpi_environment.sh"

runs=()
for n in ${ranks//,/ }; do
  directory="$output/np$n"
  rm -rf "$directory"
  mkdir -p "$directory"
  status=0
  mpirun -np "$n" "$hexfield" run "$input" -o "$directory" --threads 1 "$@" </dev/null >"$directory/stdout.txt" 2>&1 || status=$?
  echo "scaling.sh: $n processes: exit code $status"
  [ -e "$directory/report.json" ] && runs+=("$directory")
done
[ ${#runs[@]} -gt 0 ] || { echo "scaling.sh: no run wrote a report" >&2; exit 1; }
"$top/python-post/timing_table.py" "${runs[@]}" --plot "$output/scaling.png" | tee "$output/scaling.md"
echo "scaling.sh: $output/scaling.md and $output/scaling.png"
