# Tests of the whole program: bad and odd input, signals, kills.
if(TARGET hexfield)
  set(pipeline ${CMAKE_CURRENT_LIST_DIR})
  set(python /usr/bin/python3)
  # hexfield_program_test(NAME SCRIPT RANKS TIMEOUT [ARGUMENTS...]): the script gets the program and a scratch directory.
  function(hexfield_program_test name script ranks timeout)
    add_test(NAME pipeline_${name}
      COMMAND ${python} ${pipeline}/${script}.py $<TARGET_FILE:hexfield> ${CMAKE_CURRENT_BINARY_DIR}/pipeline_${name} ${ARGN})
    set_tests_properties(pipeline_${name} PROPERTIES LABELS program PROCESSORS ${ranks} TIMEOUT ${timeout}
      ENVIRONMENT "${HEXFIELD_TEST_ENVIRONMENT}")
  endfunction()
  foreach(np 1 3)
    hexfield_program_test(bad_input_np${np} bad_input ${np} 900 ${np})
    hexfield_program_test(odd_input_np${np} odd_input ${np} 900 ${np})
    hexfield_program_test(map_input_np${np} map_input ${np} 900 ${np})
  endforeach()
  foreach(np 1 2)
    hexfield_program_test(signals_np${np} signals ${np} 600 ${np})
  endforeach()
  hexfield_program_test(hex_meshes hex_meshes 1 1200)
  hexfield_program_test(kill_resume kill_resume 2 900)
  # Twenty kills over a run of a minute, and ten inside a repair: only where it is asked for.
  option(HEXFIELD_KILL_TESTS "Test many random kills over long runs" OFF)
  if(HEXFIELD_KILL_TESTS)
    hexfield_program_test(twenty_kills kill_resume 3 7200 --kills 20 --cells 16 --hexes 200000)
    hexfield_program_test(ten_kills_in_repair kill_resume 3 3600 --kills 10 --stage repair
      --mesh ${PROJECT_SOURCE_DIR}/tests/models/rod_through_box.geo)
    set_tests_properties(pipeline_twenty_kills pipeline_ten_kills_in_repair PROPERTIES LABELS kills)
  endif()
endif()
