# Extraction from the published integer-grid maps, where the shared data lie beside the checkout. Needs io for
# the files, which module hex may not see.
if(TARGET hexfield::io)
  add_executable(test_hex_models ${CMAKE_CURRENT_LIST_DIR}/igm_models.cpp)
  target_link_libraries(test_hex_models PRIVATE test_support hexfield::io hexfield::hex)
  add_test(NAME hex_models COMMAND test_hex_models)
  set_tests_properties(hex_models PROPERTIES LABELS hex TIMEOUT 600 PROCESSORS 2 ENVIRONMENT "${HEXFIELD_TEST_ENVIRONMENT}")
endif()
if(HEXFIELD_BENCHMARKS)
  add_executable(bench_hex ${CMAKE_CURRENT_LIST_DIR}/../bench/hex_bench.cpp)
  target_include_directories(bench_hex PRIVATE ${CMAKE_CURRENT_LIST_DIR}/..)
  target_link_libraries(bench_hex PRIVATE hexfield::hex benchmark::benchmark)
endif()
# Writes the table of cuts that module hex carries.
add_executable(make_cut_table ${CMAKE_CURRENT_LIST_DIR}/make_cut_table.cpp)
target_link_libraries(make_cut_table PRIVATE hexfield::hex)
