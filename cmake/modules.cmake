# Modules (sim/base/module.h): shared libraries that are loaded when their functions are first called. In the build they are
# in lib/vegard of its folder, installed in lib/vegard below the prefix, and beside the Python module; whoever loads them
# finds them there by its run path.
set(VEGARD_MODULE_DIR ${PROJECT_BINARY_DIR}/lib/vegard)
set(VEGARD_INSTALL_MODULEDIR ${CMAKE_INSTALL_LIBDIR}/vegard)
# From the program, from those of the tests, and from the Python module; and from copies of them elsewhere.
set(CMAKE_BUILD_RPATH $ORIGIN/lib/vegard $ORIGIN/../lib/vegard $ORIGIN/../../lib/vegard ${VEGARD_MODULE_DIR})

# Of the static library `user`: a module of one file that calls the libraries that follow, and nothing of vegard's.
function(vegard_module name user source)
  add_library(${name} MODULE ${source})
  target_link_libraries(${name} PRIVATE vegard_compile ${ARGN})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  set_target_properties(${name} PROPERTIES PREFIX "" CXX_VISIBILITY_PRESET hidden SKIP_BUILD_RPATH ON
                                           LIBRARY_OUTPUT_DIRECTORY ${VEGARD_MODULE_DIR})
  vegard_optimise(${name} -O1)
  add_dependencies(${user} ${name})
  install(TARGETS ${name} LIBRARY DESTINATION ${VEGARD_INSTALL_MODULEDIR} COMPONENT program)
endfunction()
