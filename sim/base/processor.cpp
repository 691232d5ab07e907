#include "sim/base/processor.h"

#include <string>

#include "sim/base/error.h"

namespace vegard::sim {
namespace {

/// Of the sets that cmake/instruction_sets.cmake names.
bool processor_has(const std::string& set) {
#if defined(__x86_64__)
  if (set == "avx512")
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl") && processor_has("avx2");
  if (set == "avx2")
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
           __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma");
  return __builtin_cpu_supports("sse4.2");
#else
  return !set.empty();
#endif
}

}  // namespace

void check_processor() {
  const std::string needed = VEGARD_NEEDED_SET;
  if (!processor_has(needed))
    throw Error(ErrorKind::usage, "this program was built for processors with " + needed + ", which this one lacks")
        .hint("build it with cmake -DVEGARD_INSTRUCTION_SETS=all");
}

}  // namespace vegard::sim
