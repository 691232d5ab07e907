# Turns the tables of data/ into a source file, so that the libraries find them wherever they are installed.
set(VEGARD_EMBEDDED_DATA ${PROJECT_BINARY_DIR}/generated/embedded_data.cpp)
set(VEGARD_EMBEDDED_TABLES
    ${PROJECT_SOURCE_DIR}/data/atmosphere/us76.csv
    ${PROJECT_SOURCE_DIR}/data/glow/ver_maxwellian.csv
    ${PROJECT_SOURCE_DIR}/data/cie/cie1931_2deg_5nm.csv
    ${PROJECT_SOURCE_DIR}/data/cie/cie1951_scotopic_5nm.csv)
add_custom_command(
  OUTPUT ${VEGARD_EMBEDDED_DATA}
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${VEGARD_EMBEDDED_DATA} "-DINPUTS=${VEGARD_EMBEDDED_TABLES}"
          -P ${PROJECT_SOURCE_DIR}/cmake/embed_data_script.cmake
  DEPENDS ${VEGARD_EMBEDDED_TABLES} ${PROJECT_SOURCE_DIR}/cmake/embed_data_script.cmake
  COMMENT "Embedding the tables of data/"
  VERBATIM)
