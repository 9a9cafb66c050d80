# Tests of the house itself: order of the modules, sizes, format, README, installation.
set(HEXFIELD_PYTHON /usr/bin/python3 CACHE FILEPATH "Python with numpy, scipy, h5py, meshio and matplotlib")
set(house ${CMAKE_CURRENT_LIST_DIR})
foreach(check module_order size_limits no_printing formatting data_of_own)
  add_test(NAME house_${check} COMMAND ${HEXFIELD_PYTHON} ${house}/${check}.py)
  set_tests_properties(house_${check} PROPERTIES LABELS house TIMEOUT 120 SKIP_RETURN_CODE 77)
endforeach()
add_test(NAME house_consumer COMMAND ${house}/consumer_test.sh ${PROJECT_BINARY_DIR} ${CMAKE_CURRENT_BINARY_DIR}/consumer)
set_tests_properties(house_consumer PROPERTIES LABELS house TIMEOUT 300 ENVIRONMENT "${HEXFIELD_TEST_ENVIRONMENT}")
if(TARGET hexfield)
  add_test(NAME house_readme
    COMMAND ${HEXFIELD_PYTHON} ${house}/readme_commands.py ${PROJECT_BINARY_DIR} ${CMAKE_CURRENT_BINARY_DIR}/readme)
  set_tests_properties(house_readme PROPERTIES LABELS house TIMEOUT 900 PROCESSORS 2
    ENVIRONMENT "${HEXFIELD_TEST_ENVIRONMENT}")
  add_test(NAME house_readme_options COMMAND ${HEXFIELD_PYTHON} ${house}/readme_options.py $<TARGET_FILE:hexfield>)
  set_tests_properties(house_readme_options PROPERTIES LABELS house TIMEOUT 60
    ENVIRONMENT "${HEXFIELD_TEST_ENVIRONMENT}")
endif()
