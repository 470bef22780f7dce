# Installed package: quadmapConfig.cmake with one component per library, and a Debian package.

include(CMakePackageConfigHelpers)
set(configDir ${CMAKE_INSTALL_LIBDIR}/cmake/quadmap)

# quadmap_package_of(<link item> <output variable>): the find_dependency() arguments that define the
# target; empty for plain libraries.
function(quadmap_package_of item output)
  set(package "")
  if(item MATCHES "^mrpt::(.+)$")
    set(package mrpt-${CMAKE_MATCH_1})
  elseif(item MATCHES "^(Eigen3|nlohmann_json|Threads|ZLIB)::")
    set(package ${CMAKE_MATCH_1})
  elseif(item MATCHES "^[Cc]eres")
    set(package Ceres)
  elseif(item MATCHES "^opencv_")
    set(package OpenCV)
  elseif(item MATCHES "^pcl_(.+)$")
    set(package "PCL COMPONENTS ${CMAKE_MATCH_1}")
  endif()
  set(${output} ${package} PARENT_SCOPE)
endfunction()

# What users of each component need: the dependencies that its headers name, and, where there is no
# shared library to bring them along, the others too.
set(QUADMAP_COMPONENT_DEPENDENCIES "")
get_property(components GLOBAL PROPERTY QUADMAP_COMPONENTS)
foreach(component IN LISTS components)
  get_property(items GLOBAL PROPERTY QUADMAP_PUBLIC_${component})
  if(NOT BUILD_SHARED_LIBS)
    get_property(private GLOBAL PROPERTY QUADMAP_PRIVATE_${component})
    list(APPEND items ${private})
  endif()
  set(below "")
  set(packages "")
  foreach(item IN LISTS items)
    if(item MATCHES "^quadmap::(.+)$")
      list(APPEND below ${CMAKE_MATCH_1})
    else()
      quadmap_package_of(${item} package)
      list(APPEND packages ${package})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES packages)
  string(REPLACE ";" " " below "${below}")
  string(APPEND QUADMAP_COMPONENT_DEPENDENCIES
    "set(quadmap_${component}_below ${below})\nset(quadmap_${component}_packages \"${packages}\")\n")
  install(EXPORT quadmap-${component} NAMESPACE quadmap::
    FILE quadmap-${component}-targets.cmake DESTINATION ${configDir})
endforeach()
string(REPLACE ";" " " QUADMAP_COMPONENTS "${components}")

configure_package_config_file(cmake/quadmapConfig.cmake.in quadmapConfig.cmake
  INSTALL_DESTINATION ${configDir})
write_basic_package_version_file(quadmapConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/quadmapConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/quadmapConfigVersion.cmake DESTINATION ${configDir})
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "quadmap contributors <quadmap@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_STRIP_FILES ON)
include(CPack)
