# Debian packages: `cpack -G DEB` in the build folder makes vegard.deb, the program, vegard-dev.deb, the libraries that
# find_package(vegard) finds, and, if it was built, python3-vegard.deb. Their dependencies are what the program was linked with (dpkg-shlibdeps, of dpkg-dev).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME vegard)
set(CPACK_PACKAGE_VENDOR "vegard developers")
set(CPACK_PACKAGE_CONTACT "vegard developers <developers@vegard.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "simulates aurorae and fits them to photographs")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME vegard)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME vegard-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "A deterministic simulator lets electrons fall along the Earth's magnetic\nfield, gives them the light of their emission lines and forms a camera's\npicture of it; the parameters of curtains and spectra are fitted to\nphotographs, with error bars.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
    "The simulator and the inversion of vegard as static libraries, with their\nheaders and what find_package(vegard) reads.")
# What find_package(vegard) looks for, of packages.txt.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "vegard (= ${PROJECT_VERSION}), libeigen3-dev, libceres-dev, libopencv-dev, libjpeg-dev, libpng-dev, zlib1g-dev, libhwy-dev, libtbb-dev, libtomlplusplus-dev, libmuparser-dev, pkg-config, libcfitsio-dev, libboost-iostreams-dev, nlohmann-json3-dev, libsqlite3-dev, libnetcdf-dev, libhdf5-dev, libmatio-dev, libarchive-dev, liblcms2-dev, libfmt-dev")
if(VEGARD_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-vegard)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "vegard (= ${PROJECT_VERSION}), python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), python3 (<< ${Python_VERSION_MAJOR}.${next_minor}), python3-numpy")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
      "What the program does, for Python, with NumPy arrays: scenes, pictures, fits,\nmaps and the calibration of cameras by stars.")
endif()
set(CPACK_VEGARD_INSTRUCTION_SETS ${VEGARD_INSTRUCTION_SETS})
set(CPACK_VEGARD_PYTHON_DIR "${VEGARD_PYTHON_DIR}")
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/debian_documents.cmake)
include(CPack)
