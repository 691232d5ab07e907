# What the files with vector code are compiled with, by VEGARD_INSTRUCTION_SETS (compiler.cmake). The results are the same bytes
# for each (tests/determinism).
#
# Three generations of x86 are enough: SSE4 (2009), AVX2 (2013), AVX-512 (2017); elsewhere it is what the compiler's baseline
# has. Highway has no vectors below SSSE3, so SSE4 is the least that we build for.
set(VEGARD_SSE4_OPTIONS -msse4.2 -maes -mpclmul)
set(VEGARD_AVX2_OPTIONS ${VEGARD_SSE4_OPTIONS} -mavx2 -mbmi -mbmi2 -mfma -mf16c -mlzcnt)
set(VEGARD_AVX512_OPTIONS ${VEGARD_AVX2_OPTIONS} -mavx512f -mavx512bw -mavx512cd -mavx512dq -mavx512vl)

# What the processor of this machine has of these: "avx512", "avx2" or "sse4".
function(vegard_find_processor result)
  if(NOT DEFINED VEGARD_PROCESSOR)
    file(WRITE ${CMAKE_BINARY_DIR}/CMakeFiles/processor.cpp [[
#include <cstdio>
#define HAS(name) (__builtin_cpu_supports(name) != 0)
int main() {
  const bool avx2 = HAS("avx2") && HAS("bmi") && HAS("bmi2") && HAS("fma");
  const bool avx512 = avx2 && HAS("avx512f") && HAS("avx512bw") && HAS("avx512cd") && HAS("avx512dq") && HAS("avx512vl");
  std::puts(avx512 ? "avx512" : avx2 ? "avx2" : "sse4");
}
]])
    try_run(status compiled ${CMAKE_BINARY_DIR}/CMakeFiles/processor ${CMAKE_BINARY_DIR}/CMakeFiles/processor.cpp
            RUN_OUTPUT_VARIABLE found)
    if(NOT compiled OR NOT status EQUAL 0)
      set(found sse4)
    endif()
    string(STRIP "${found}" found)
    set(VEGARD_PROCESSOR ${found} CACHE INTERNAL "The best instruction set of this machine")
    message(STATUS "The best instruction set of this machine: ${found}")
  endif()
  set(${result} ${VEGARD_PROCESSOR} PARENT_SCOPE)
endfunction()

# The options for `sets` (all, this or least), and the instruction set that the processor must have to run what they make.
function(vegard_vector_options sets options needed)
  set(list $<$<CONFIG:Release>:-O3>)
  set(least sse4)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    if(sets STREQUAL "this")
      vegard_find_processor(least)
    endif()
    string(TOUPPER ${least} name)
    list(APPEND list ${VEGARD_${name}_OPTIONS} "-DHWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_AVX3_DL)")
  endif()
  if(NOT sets STREQUAL "all")
    list(APPEND list -DHWY_COMPILE_ONLY_STATIC)
  endif()
  set(${options} "${list}" PARENT_SCOPE)
  set(${needed} ${least} PARENT_SCOPE)
endfunction()
