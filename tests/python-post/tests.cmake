add_test(NAME python_post COMMAND ${HEXFIELD_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/post_test.py)
set_tests_properties(python_post PROPERTIES LABELS python-post TIMEOUT 120)
if(TARGET hexfield)
  add_test(NAME python_post_decompose_table COMMAND ${HEXFIELD_PYTHON} ${PROJECT_SOURCE_DIR}/python-post/decompose_table.py
    $<TARGET_FILE:hexfield> ${CMAKE_CURRENT_BINARY_DIR}/decompose_table --check)
  set_tests_properties(python_post_decompose_table PROPERTIES LABELS python-post TIMEOUT 900
    ENVIRONMENT "${HEXFIELD_TEST_ENVIRONMENT};PYTHONDONTWRITEBYTECODE=1")
endif()
