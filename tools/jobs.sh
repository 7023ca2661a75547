#!/usr/bin/env bash
# Prints how many compilers may run at once: one per CPU, and 1.5 GiB of memory for each.
set -euo pipefail
by_memory=$(awk '/^MemAvailable:/ {print int($2 / 1024 / 1536)}' /proc/meminfo)
jobs=$(nproc)
[ "$by_memory" -ge "$jobs" ] || jobs=$by_memory
[ "$jobs" -ge 1 ] || jobs=1
echo "$jobs"
