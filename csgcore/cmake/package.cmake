# What `cmake --install` puts in place besides the program: the libraries with their public headers,
# and a CMake package config. Include it after the folders' own CMakeLists: every library that
# csgcore/, glrender/ and frontend/ define is installed, as scadray::<name>.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(component COMPONENT libscadray-dev)  # all but the licence and the README
set(scadray_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/scadray")

set(scadray_components csgcore)
if(SCADRAY_GLRENDER)
  list(APPEND scadray_components glrender)
endif()
if(SCADRAY_FRONTEND)
  list(APPEND scadray_components frontend/language frontend)
endif()

# The libraries link scadray_options privately; static libraries carry that into the export.
install(TARGETS scadray_options EXPORT scadray ${component})
foreach(folder IN LISTS scadray_components)
  get_property(targets DIRECTORY "${PROJECT_SOURCE_DIR}/${folder}" PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    if(type MATCHES "^(STATIC|SHARED|INTERFACE)_LIBRARY$")
      install(TARGETS ${target} EXPORT scadray ${component})
      target_compile_features(${target} INTERFACE cxx_std_20) # the headers need it
      add_library(scadray::${target} ALIAS ${target})
    endif()
  endforeach()
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/${folder}/include/" TYPE INCLUDE ${component})
endforeach()
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" "${PROJECT_SOURCE_DIR}/README.md" TYPE DOC)

install(EXPORT scadray NAMESPACE scadray:: FILE scadrayTargets.cmake
        DESTINATION "${scadray_package_dir}" ${component})
configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/scadrayConfig.cmake.in"
                              "${PROJECT_BINARY_DIR}/scadrayConfig.cmake"
                              INSTALL_DESTINATION "${scadray_package_dir}")
# Below 1.0 a new minor version may break the interface.
write_basic_package_version_file("${PROJECT_BINARY_DIR}/scadrayConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/scadrayConfig.cmake"
              "${PROJECT_BINARY_DIR}/scadrayConfigVersion.cmake"
        DESTINATION "${scadray_package_dir}" ${component})
