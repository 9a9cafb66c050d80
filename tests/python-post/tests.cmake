add_test(NAME python_post COMMAND ${HEXFIELD_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/post_test.py)
set_tests_properties(python_post PROPERTIES LABELS python-post TIMEOUT 120)
