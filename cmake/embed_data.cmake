# Turns the tables of data/ into a source file, so that the libraries find them wherever they are installed.
set(VEGARD_EMBEDDED_DATA ${CMAKE_CURRENT_BINARY_DIR}/generated/embedded_data.cpp)
set(VEGARD_EMBEDDED_TABLES
    ${PROJECT_SOURCE_DIR}/data/atmosphere/us76.csv
    ${PROJECT_SOURCE_DIR}/data/atmosphere/ozone_233k.csv
    ${PROJECT_SOURCE_DIR}/data/atmosphere/msis_thermosphere.csv
    ${PROJECT_SOURCE_DIR}/data/atmosphere/msis_nodes.csv
    ${PROJECT_SOURCE_DIR}/data/atmosphere/msis_gases.csv
    ${PROJECT_SOURCE_DIR}/data/atmosphere/msis_constants.csv
    ${PROJECT_SOURCE_DIR}/data/field/igrf14.csv
    ${PROJECT_SOURCE_DIR}/data/electrons/cross_sections.csv
    ${PROJECT_SOURCE_DIR}/data/electrons/shells.csv
    ${PROJECT_SOURCE_DIR}/data/electrons/reactions.csv
    ${PROJECT_SOURCE_DIR}/data/electrons/emissions.csv
    ${PROJECT_SOURCE_DIR}/data/electrons/uncertainties.csv
    ${PROJECT_SOURCE_DIR}/data/cie/cie1931_2deg_5nm.csv
    ${PROJECT_SOURCE_DIR}/data/cie/cie1951_scotopic_5nm.csv
    ${PROJECT_SOURCE_DIR}/data/cie/daylight_components_10nm.csv
    ${PROJECT_SOURCE_DIR}/data/cameras/canon_5d_mark_ii.csv
    ${PROJECT_SOURCE_DIR}/data/cameras/nikon_d200.csv
    ${PROJECT_SOURCE_DIR}/data/cameras/nikon_d700.csv
    ${PROJECT_SOURCE_DIR}/data/cameras/sony_a7s_ii.csv
    ${PROJECT_SOURCE_DIR}/data/stars/bright_stars.csv
    ${PROJECT_SOURCE_DIR}/data/stars/faint_stars.csv
    ${PROJECT_SOURCE_DIR}/data/filter/kinds.json
    ${PROJECT_SOURCE_DIR}/data/filter/sky_kinds.json)
# The emission tables that are compiled in, by their folders in data/: those of kDefaultEmissionTables (sim/scene/structs/scene.h) must
# be. Others of data/ are found as files at run time (sim/base/data_folders.h). They are called by folder and file, "glow/atmosphere.csv".
set(VEGARD_EMBEDDED_EMISSION emission)
foreach(folder IN LISTS VEGARD_EMBEDDED_EMISSION)
  foreach(name ver_maxwellian.csv ver_mono.csv column_brightness.csv linearity_Q.csv atmosphere.csv modes.csv about.json)
    if(EXISTS ${PROJECT_SOURCE_DIR}/data/${folder}/${name})
      list(APPEND VEGARD_EMBEDDED_TABLES ${PROJECT_SOURCE_DIR}/data/${folder}/${name})
    endif()
  endforeach()
endforeach()
add_custom_command(
  OUTPUT ${VEGARD_EMBEDDED_DATA}
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${VEGARD_EMBEDDED_DATA} "-DINPUTS=${VEGARD_EMBEDDED_TABLES}"
          "-DFOLDERS=${VEGARD_EMBEDDED_EMISSION}"
          -P ${PROJECT_SOURCE_DIR}/cmake/embed_data_script.cmake
  DEPENDS ${VEGARD_EMBEDDED_TABLES} ${PROJECT_SOURCE_DIR}/cmake/embed_data_script.cmake
  COMMENT "Embedding the tables of data/"
  VERBATIM)
