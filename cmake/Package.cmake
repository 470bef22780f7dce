# Installed package: quadmapConfig.cmake with one component per library, and a Debian package.

include(CMakePackageConfigHelpers)
set(configDir ${CMAKE_INSTALL_LIBDIR}/cmake/quadmap)

# quadmap_package_of(<target> <output variable>): the package that defines the target.
function(quadmap_package_of item output)
  if(item MATCHES "^mrpt::(.+)$")
    set(package mrpt-${CMAKE_MATCH_1})
  elseif(item MATCHES "^([^:]+)::")
    set(package ${CMAKE_MATCH_1})
  else()
    message(FATAL_ERROR "${item} in the interface of a library: which package has it?")
  endif()
  set(${output} ${package} PARENT_SCOPE)
endfunction()

# What users of each component need: the dependencies that its headers name.
set(QUADMAP_COMPONENT_DEPENDENCIES "")
get_property(components GLOBAL PROPERTY QUADMAP_COMPONENTS)
foreach(component IN LISTS components)
  get_property(items GLOBAL PROPERTY QUADMAP_PUBLIC_${component})
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
    FILE quadmap-${component}-targets.cmake DESTINATION ${configDir} COMPONENT dev)
  list(APPEND allPackages ${packages})
endforeach()
string(REPLACE ";" " " QUADMAP_COMPONENTS "${components}")

configure_package_config_file(cmake/quadmapConfig.cmake.in quadmapConfig.cmake
  INSTALL_DESTINATION ${configDir})
write_basic_package_version_file(quadmapConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/quadmapConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/quadmapConfigVersion.cmake DESTINATION ${configDir} COMPONENT dev)
# The pages in the places in which they point to each other.
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT doc)
install(DIRECTORY doc DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT doc)
install(FILES rawlogs/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/rawlogs COMPONENT doc)
install(FILES libs/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/libs COMPONENT doc)

include(cmake/DebianPackages.cmake)
