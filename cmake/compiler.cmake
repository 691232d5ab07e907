# One place for what every target of the project is compiled with.
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
set(THREADS_PREFER_PTHREAD_FLAG ON)

# Two ways to build the same sources, the presets release and dev. With VEGARD_UNITY several files are one
# unit: the whole is compiled in a fifth of the time, and a change compiles more than it touches; for those who build
# once. Without it every file stands on its own feet and includes what it needs; for those who change the sources.
option(VEGARD_UNITY "Compile several files as one unit" OFF)
option(VEGARD_PRECOMPILED_HEADERS "Precompile the headers of other libraries" ON)
set(VEGARD_INSTRUCTION_SETS all CACHE STRING "Vector code for: all processors (the best is taken at run time), this (the one that builds), least")
set_property(CACHE VEGARD_INSTRUCTION_SETS PROPERTY STRINGS all this least)
option(VEGARD_WARNINGS_AS_ERRORS "Stop at warnings" OFF)

find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # What ccache must overlook to serve units with a precompiled header.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
      CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${CCACHE})
endif()

add_library(vegard_compile INTERFACE)
# No contraction: a*b+c must round the same on a CPU with and without fused multiply-add.
target_compile_options(vegard_compile INTERFACE -Wall -Wextra -Wno-psabi -ffp-contract=off)
if(VEGARD_UNITY)
  # Names that another file of the unit keeps to itself are no names here.
  target_compile_options(vegard_compile INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
else()
  target_compile_options(vegard_compile INTERFACE -Wshadow)
endif()
if(VEGARD_WARNINGS_AS_ERRORS)
  target_compile_options(vegard_compile INTERFACE -Werror)
endif()

# Of the target: as much optimisation as pays where no loop is hot. Release alone; other configurations have their own.
function(vegard_optimise target level)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${level}>)
endfunction()

# Of the target: units of some `kilobytes` of sources, named after the folder of the first. A folder's files go together as far as
# they fit, and a new unit begins with a new folder if the last has half of that, so that a file more or less changes the units of its
# folder alone. Files with options of their own stay alone.
function(vegard_unity target kilobytes)
  if(NOT VEGARD_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  list(SORT sources)
  math(EXPR most "${kilobytes} * 1000")
  math(EXPR enough "${kilobytes} * 500")
  set(bytes 0)
  set(last_folder "")
  set(units "")
  foreach(source IN LISTS sources)
    get_filename_component(path ${source} ABSOLUTE)
    if(NOT EXISTS ${path} OR path MATCHES "^${PROJECT_BINARY_DIR}/")
      continue()
    endif()
    get_filename_component(folder ${path} DIRECTORY)
    file(SIZE ${path} size)
    math(EXPR sum "${bytes} + ${size}")
    if(bytes EQUAL 0 OR sum GREATER most OR (NOT folder STREQUAL last_folder AND bytes GREATER_EQUAL enough))
      set(sum ${size})
      file(RELATIVE_PATH unit ${PROJECT_SOURCE_DIR} ${folder})
      string(REPLACE "/" "_" unit ${unit})
      list(APPEND units ${unit})
      set(alike ${units})
      list(FILTER alike INCLUDE REGEX "^${unit}$")
      list(LENGTH alike count)
      if(count GREATER 1)
        string(APPEND unit "_${count}")
      endif()
    endif()
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${unit})
    set(bytes ${sum})
    set(last_folder ${folder})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# Of the target: headers of the standard library and others, never our own.
function(vegard_precompile target)
  if(VEGARD_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()
