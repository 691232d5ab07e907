# Run by CPack before it packs: what Debian asks of a package's documents. Manual pages are compressed, and each package has a
# copyright file and a changelog.
get_filename_component(source ${CMAKE_CURRENT_LIST_DIR} DIRECTORY)
file(READ ${source}/LICENSE licence)
file(READ ${source}/NOTICE notice)
foreach(component IN ITEMS program development)
  set(name vegard)
  if(component STREQUAL "development")
    set(name vegard-dev)
  endif()
  set(share ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr/share)
  set(documents ${share}/doc/${name})
  file(MAKE_DIRECTORY ${documents})
  file(WRITE ${documents}/copyright
       "Source: vegard\n\n${licence}\n${notice}\nOn Debian systems the Apache License, Version 2.0, is in /usr/share/common-licenses/Apache-2.0.\n")
  string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
  file(WRITE ${documents}/changelog
       "vegard (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium\n\n  * See CHANGELOG.md beside the sources.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${now}\n")
  file(REMOVE ${documents}/CHANGELOG.md ${documents}/LICENSE)
  file(GLOB pages ${share}/man/man1/*.1)
  execute_process(COMMAND gzip -9nf ${documents}/changelog ${pages} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
