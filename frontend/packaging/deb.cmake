# cpack runs this before it packs. It adds what Debian demands and `cmake --install` does not install:
# /usr/share/doc/PACKAGE with copyright and changelog, and compressed manual pages.
set(cgal_comment "
 scadray-validate contains CGAL (https://www.cgal.org) as well, and is as a whole
 under its license, the GPL, version 3 or later: /usr/share/common-licenses/GPL-3.")

function(compress file)
  # -n: without the time, so that the same build gives the same package
  execute_process(COMMAND gzip -9nf "${file}" COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# The license becomes a paragraph of the copyright file, without its title and holder, which come before it.
file(READ "${CPACK_SCADRAY_SOURCE_DIR}/LICENSE" license)
string(REGEX REPLACE "^MIT License\n\nCopyright[^\n]*\n\n" "" license "${license}")
string(REGEX REPLACE "\n$" "" license " ${license}")
string(REPLACE "\n" "\n " license "${license}")
string(REPLACE "\n \n" "\n .\n" license "${license}")

foreach(package IN LISTS CPACK_COMPONENTS_ALL)
  set(share "${CPACK_TEMPORARY_DIRECTORY}/${package}/usr/share")
  set(comment)
  if(package STREQUAL "scadray-validate")
    set(comment "${cgal_comment}")
  endif()
  configure_file("${CMAKE_CURRENT_LIST_DIR}/copyright.in" "${share}/doc/${package}/copyright" @ONLY)
  configure_file("${CPACK_SCADRAY_SOURCE_DIR}/CHANGELOG.md" "${share}/doc/${package}/changelog" COPYONLY)
  compress("${share}/doc/${package}/changelog")
  file(REMOVE "${share}/doc/${package}/LICENSE")  # it is in copyright
  file(GLOB manuals "${share}/man/man1/*.1")
  foreach(manual IN LISTS manuals)
    compress("${manual}")
  endforeach()
endforeach()
