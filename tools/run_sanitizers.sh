#!/usr/bin/env bash
# Builds and runs the tests under sanitizers; any report fails.
# Usage: tools/run_sanitizers.sh [PRESET...]    (default: asan-ubsan tsan)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
[ $# -gt 0 ] || set -- asan-ubsan tsan
suppressions=$PWD/tools/sanitizers
jobs=$(tools/jobs.sh)

export ASAN_OPTIONS="detect_stack_use_after_return=1:strict_string_checks=1"
export LSAN_OPTIONS="suppressions=$suppressions/leak.txt:print_suppressions=0"
export UBSAN_OPTIONS="print_stacktrace=1:halt_on_error=1"
export TSAN_OPTIONS="suppressions=$suppressions/thread.txt:second_deadlock_stack=1:halt_on_error=1"

# OpenMP's threads, which CHOLMOD would start, agree in ways that the thread sanitizer cannot see.
export OMP_THREAD_LIMIT=1

tools/install-dependencies.sh
for preset in "$@"; do
  cmake --preset "$preset"
  cmake --build --preset "$preset" --parallel "$jobs"
  without_aslr=()
  # GCC 12's thread sanitizer cannot place its shadow where the kernel randomises more than 28 bits.
  if [ "$preset" = tsan ] && setarch "$(uname -m)" --addr-no-randomize true 2>/dev/null; then
    without_aslr=(setarch "$(uname -m)" --addr-no-randomize)
  fi
  "${without_aslr[@]}" ctest --preset "$preset" --parallel "$jobs"
done
