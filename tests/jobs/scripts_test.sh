#!/usr/bin/env bash
# The scripts of jobs/ refuse a wrong call with exit code 2 and their usage, and parse at all.
set -euo pipefail
jobs=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../jobs" && pwd)
for script in "$jobs"/*.sh "$jobs"/*.sbatch; do
  bash -n "$script"
done
refuses() {
  local status=0 said
  said=$("$@" 2>&1 </dev/null) || status=$?
  [ "$status" -eq 2 ] && grep -qE "(jobs/|usage)" <<<"$said" || { echo "$*: status $status, said: $said"; exit 1; }
}
refuses "$jobs/install_packages.sh" everything
refuses "$jobs/scaling.sh"
refuses "$jobs/scaling.sh" only-an-input
refuses bash "$jobs/hexfield.sbatch" only-an-input
echo "ok: the scripts refuse a wrong call"
