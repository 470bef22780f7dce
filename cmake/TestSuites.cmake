# Read by CTest: makes a test of each suite of a GoogleTest program, or of each case when `eachCase` is set. The list of
# them is kept in the file `list` until the program, this file or the file that includes it changes. `timeout` is that of a
# case [s]; a suite has 10 s more for each of its cases, as they are not all as long. A case of which GoogleTest says that it
# was skipped is skipped for CTest, too, when it runs alone.

# quadmap_append_test(<filter> <cases>): to `text`.
macro(quadmap_append_test filter cases)
  if(${cases} GREATER 0)
    string(REGEX REPLACE "[.][*]$" "" name "${label}.${filter}")
    math(EXPR seconds "${timeout} + 10 * ${cases}")
    set(skipped "")
    if(eachCase)
      set(seconds ${timeout})
      set(skipped "SKIP_REGULAR_EXPRESSION [==[\\[  SKIPPED \\]]==]")
    endif()
    # What may take longest starts first.
    string(APPEND text "add_test([==[${name}]==] [==[${program}]==] [==[--gtest_filter=${filter}]==])\n"
      "set_tests_properties([==[${name}]==] PROPERTIES TIMEOUT ${seconds} LABELS ${label} COST ${seconds} ${skipped})\n")
  endif()
endmacro()

# quadmap_write_tests(): asks the program what it has.
function(quadmap_write_tests)
  execute_process(COMMAND ${program} --gtest_list_tests OUTPUT_VARIABLE output RESULT_VARIABLE status TIMEOUT 60)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${program} --gtest_list_tests: ${status}")
  endif()
  string(REGEX REPLACE "#[^\n]*" "" output "${output}")  # parameters, which may hold anything
  string(REGEX MATCHALL "[^\n]+" lines "${output}")
  set(text "")
  set(suite "")
  set(cases 0)
  foreach(line IN LISTS lines)
    if(line MATCHES "^([^ ]+)[.] *$")
      set(next ${CMAKE_MATCH_1})
      quadmap_append_test("${suite}.*" ${cases})
      set(suite ${next})
      set(cases 0)
    elseif(NOT "${suite}${line}" MATCHES "DISABLED_" AND line MATCHES "^  ([^ ]+)")
      if(eachCase)
        set(case ${CMAKE_MATCH_1})
        quadmap_append_test("${suite}.${case}" 1)
      else()
        math(EXPR cases "${cases} + 1")
      endif()
    endif()
  endforeach()
  quadmap_append_test("${suite}.*" ${cases})
  file(WRITE ${list} "${text}")
endfunction()

if(NOT EXISTS ${program})
  add_test(${label}_NOT_BUILT ${program})
else()
  if(${program} IS_NEWER_THAN ${list} OR ${CMAKE_CURRENT_LIST_FILE} IS_NEWER_THAN ${list}
      OR ${CMAKE_PARENT_LIST_FILE} IS_NEWER_THAN ${list})
    quadmap_write_tests()
  endif()
  include(${list})
endif()
