# How every target of the project is made: one place for warnings, sanitizers, install and RPATH.

# ccache can reuse objects that were built with a precompiled header only when told so. It learns from the compiler which
# files were read: preprocessing for it would take a seventh of a first build.
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER
    ${CMAKE_COMMAND} -E env CCACHE_DEPEND=1 CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE_PROGRAM})
endif()

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE RelWithDebInfo CACHE STRING "Build type" FORCE)
endif()
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")

# quadmap_target_options(<target>): what holds for libraries, programs and tests alike.
function(quadmap_target_options target)
  target_compile_features(${target} PUBLIC cxx_std_17)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wconversion
    $<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion>)  # GCC's -Wconversion leaves it out
  if(QUADMAP_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(QUADMAP_SANITIZE)
    # Debian's libraries free what our code allocates in Eigen's headers, and the other way round: with
    # the address sanitizer Eigen would choose an allocator of its own, unlike theirs.
    target_compile_definitions(${target} PRIVATE EIGEN_MALLOC_ALREADY_ALIGNED=1 QUADMAP_SANITIZED)
    # MRPT's 3-D objects (2.5.8) have misaligned virtual bases: creating an ellipsoid is enough. Accesses outside of
    # objects are what the address sanitizer looks for; looking twice takes a third of the time to compile.
    target_compile_options(${target} PRIVATE -fsanitize=${QUADMAP_SANITIZE}
      -fno-sanitize=alignment,object-size -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=${QUADMAP_SANITIZE}
      $<$<CXX_COMPILER_ID:Clang>:-fuse-ld=lld>)
  endif()
endfunction()

# For programs and tests: undefined behaviour is looked for in the libraries, which do the work and keep their own copies
# of what is inline. Looking for it in those that call them, too, takes a third of their time to compile; what is theirs
# alone, the code of apps and templates that only tests use, is not looked at.
set(QUADMAP_CALLER_OPTIONS)
if(QUADMAP_SANITIZE)
  set(QUADMAP_CALLER_OPTIONS -fno-sanitize=undefined)
endif()

# quadmap_precompile(<owner> LINK ... HEADERS ... OPTIONS ...): an object library that reads heavy headers once
# for all targets that reuse it (quadmap_reuse_precompiled). The flags make what the compilers write
# reproducible, so that ccache recognises it.
function(quadmap_precompile owner)
  cmake_parse_arguments(arg "" "" "LINK;HEADERS;OPTIONS" ${ARGN})
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${owner}.cpp CONTENT "")
  add_library(${owner} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${owner}.cpp)
  target_link_libraries(${owner} PRIVATE ${arg_LINK})
  target_precompile_headers(${owner} PRIVATE ${arg_HEADERS})
  quadmap_precompile_options(${owner})
  quadmap_target_options(${owner})
  target_compile_options(${owner} PRIVATE ${arg_OPTIONS})
endfunction()

function(quadmap_precompile_options target)
  target_compile_options(${target} PRIVATE
    $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>
    $<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>)
endfunction()

# quadmap_reuse_precompiled(<target> <owner>): the headers that the owner has read.
function(quadmap_reuse_precompiled target owner)
  target_precompile_headers(${target} REUSE_FROM ${owner})
  quadmap_precompile_options(${target})
endfunction()

# What the libraries above geometry have in common.
quadmap_precompile(quadmap_common_headers
  LINK mrpt::maps mrpt::obs mrpt::poses Eigen3::Eigen
  HEADERS
    <mrpt/maps/CMetricMap.h>
    <mrpt/obs/CObservation3DRangeScan.h>
    <mrpt/poses/CPose3DPDFGaussian.h>
    <Eigen/Dense>
    <map>
    <optional>
    <string>
    <vector>)
set_target_properties(quadmap_common_headers PROPERTIES POSITION_INDEPENDENT_CODE ON)

# quadmap_compile_together(<target>): some sources at a time, when asked for. Most of what is compiled are templates that
# they have in common. Names in unnamed namespaces are unique within a target for it; those of functions still hide
# them, and GCC takes them for those of a header.
function(quadmap_compile_together target)
  if(QUADMAP_TOGETHER)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 10)
    target_compile_options(${target} PRIVATE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

# quadmap_add_library(<name> SOURCES ... PUBLIC ... PRIVATE ... [PRECOMPILED] [SEPARATE]): target quadmap::<name>, file
# libquadmap-<name>.so (shared: programs of MRPT load them as plug-ins), headers in
# include/quadmap/<name>, component <name> of the package. Its sources are never compiled together when they are SEPARATE.
function(quadmap_add_library name)
  cmake_parse_arguments(arg "PRECOMPILED;SEPARATE" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(quadmap_${name} SHARED ${arg_SOURCES})
  add_library(quadmap::${name} ALIAS quadmap_${name})
  set_target_properties(quadmap_${name} PROPERTIES
    OUTPUT_NAME quadmap-${name} EXPORT_NAME ${name}
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})
  target_include_directories(quadmap_${name} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  target_link_libraries(quadmap_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  if(arg_PRECOMPILED)
    quadmap_reuse_precompiled(quadmap_${name} quadmap_common_headers)
  endif()
  quadmap_target_options(quadmap_${name})
  if(NOT arg_SEPARATE)
    quadmap_compile_together(quadmap_${name})
  endif()
  # Otherwise templates that a test instantiates, too, would be those of the test, which is not optimised.
  target_link_options(quadmap_${name} PRIVATE -Wl,-Bsymbolic-functions)
  install(TARGETS quadmap_${name} EXPORT quadmap-${name}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT lib NAMELINK_COMPONENT dev)
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)

  set_property(GLOBAL APPEND PROPERTY QUADMAP_COMPONENTS ${name})
  # The linker looks for the libraries behind the interface, so that the package names them, too.
  set(behind ${arg_PRIVATE})
  list(FILTER behind INCLUDE REGEX "^quadmap::")
  set_property(GLOBAL PROPERTY QUADMAP_PUBLIC_${name} ${arg_PUBLIC} ${behind})
endfunction()

add_custom_target(programs)  # all of them, without the tests

# quadmap_add_program(<name> SOURCES ... LINK ...): program quadmap-<...> in bin, with the manual page and the
# completion for bash that it tells about itself.
function(quadmap_add_program name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_compile_definitions(${name} PRIVATE QUADMAP_VERSION="${PROJECT_VERSION}")
  target_link_libraries(${name} PRIVATE ${arg_LINK} quadmap_cli)
  quadmap_target_options(${name})
  target_compile_options(${name} PRIVATE ${QUADMAP_CALLER_OPTIONS})
  add_dependencies(programs ${name})
  set(manual ${CMAKE_BINARY_DIR}/share/man/man1/${name}.1)
  set(completion ${CMAKE_BINARY_DIR}/share/bash-completion/completions/${name})
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/share/man/man1 ${CMAKE_BINARY_DIR}/share/bash-completion/completions)
  set(ask ${CMAKE_COMMAND} -E env ASAN_OPTIONS=detect_leaks=0 $<TARGET_FILE:${name}> --help-as)
  add_custom_command(TARGET ${name} POST_BUILD
    COMMAND ${ask} man > ${manual}
    COMMAND gzip -9nkf ${manual}
    COMMAND ${ask} completion > ${completion})
  install(TARGETS ${name} DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tools)
  install(FILES ${manual}.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tools)
  install(FILES ${completion} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT tools)
endfunction()

# quadmap_add_test(<name> SOURCES ... LINK ... INTERNALS ... [LIGHT] [EACH_CASE]): a GoogleTest program with the label
# <name>. CTest runs its suites one by one, because the start of a program takes a fifth of a second, or its cases when
# these take long. A case may take TIMEOUT seconds (120), a suite that and 10 s more for each of its cases. The
# code of LIGHT tests, which compute little themselves, is not optimised: that takes half as long to compile.
# The private headers of the libraries in INTERNALS are found from their src folders.
# Tests find their fixtures in QUADMAP_SOURCE_DIR/tests, the programs in QUADMAP_BIN_DIR.
function(quadmap_add_test name)
  cmake_parse_arguments(arg "LIGHT;EACH_CASE" "TIMEOUT" "SOURCES;LINK;INTERNALS" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_compile_definitions(${name} PRIVATE
    QUADMAP_SOURCE_DIR="${PROJECT_SOURCE_DIR}" QUADMAP_BIN_DIR="${CMAKE_BINARY_DIR}/bin"
    QUADMAP_LIB_DIR="${CMAKE_BINARY_DIR}/lib")
  target_link_libraries(${name} PRIVATE ${arg_LINK} quadmap_test_algebra GTest::gtest GTest::gtest_main)
  foreach(library IN LISTS arg_INTERNALS)
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/libs/${library}/src)
  endforeach()
  quadmap_target_options(${name})
  quadmap_compile_together(${name})
  if(arg_LIGHT)
    quadmap_reuse_precompiled(${name} quadmap_light_test_headers)
    target_compile_options(${name} PRIVATE ${QUADMAP_LIGHT_TEST_OPTIONS})
  else()
    quadmap_reuse_precompiled(${name} quadmap_test_headers)
    target_compile_options(${name} PRIVATE ${QUADMAP_TEST_OPTIONS})
  endif()
  set(tests ${CMAKE_CURRENT_BINARY_DIR}/${name}_suites.cmake)
  file(CONFIGURE OUTPUT ${tests} @ONLY CONTENT [[
set(program "@CMAKE_RUNTIME_OUTPUT_DIRECTORY@/@name@")
set(list "@CMAKE_CURRENT_BINARY_DIR@/@name@_tests.cmake")
set(label @name@)
set(timeout @arg_TIMEOUT@)
set(eachCase @arg_EACH_CASE@)
include("@PROJECT_SOURCE_DIR@/cmake/TestSuites.cmake")
]])
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${tests})
endfunction()
