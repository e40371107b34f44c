# `cpack` in the build folder makes two Debian packages (deb.cmake adds files that only packages have):
#   scadray           the program and everything that belongs to it
#   scadray-validate  a package of its own, since it contains CGAL (GPL-3)
# The components, and so the packages, are named in the install commands; a command that names none
# belongs to scadray.
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL scadray)
if(TARGET scadray-validate)
  list(APPEND CPACK_COMPONENTS_ALL scadray-validate)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ
                                                GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
# Each component has a description of its own.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
# The project has no address; whoever distributes a package sets their own with -D.
if(NOT CPACK_PACKAGE_CONTACT)
  set(CPACK_PACKAGE_CONTACT "scadray contributors <scadray@localhost>")
endif()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/deb.cmake")
set(CPACK_SCADRAY_SOURCE_DIR "${PROJECT_SOURCE_DIR}")

# deb_package(NAME SECTION DESCRIPTION [RECOMMENDS …] [DEPENDS …])
function(deb_package name section description)
  cmake_parse_arguments(ARG "" "" "RECOMMENDS;DEPENDS" ${ARGN})
  list(JOIN ARG_RECOMMENDS ", " recommends)
  list(JOIN ARG_DEPENDS ", " depends)
  string(TOUPPER "${name}" key)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_RECOMMENDS "${recommends}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  set(CPACK_COMPONENT_${key}_DESCRIPTION "${description}" PARENT_SCOPE)
endfunction()

# libepoxy opens EGL and GL by name when OpenGL is first asked for, which shlibdeps cannot see; the
# CPU draws if they are missing. A design with text opens FreeType, HarfBuzz and fontconfig by name, too;
# text is left out if they are missing.
deb_package(scadray graphics "exact ray-traced pictures of OpenSCAD designs
Draws OpenSCAD's .csg and .scad files by ray tracing the solid itself: round
primitives are exact surfaces, not meshes. Takes the command lines of openscad
that write a picture, and needs neither a display nor a GPU."
  RECOMMENDS openscad libegl1 libfontconfig1 libfreetype6 libgl1-mesa-dri libharfbuzz0b
             libopengl0)
deb_package(scadray-validate graphics "compares what scadray draws with exact arithmetic
Holds what scadray makes of a design against CGAL's Nef polyhedra and against
rays in exact arithmetic. `scadray validate` runs it."
  RECOMMENDS openscad DEPENDS "scadray (= ${PROJECT_VERSION})")
include(CPack)
