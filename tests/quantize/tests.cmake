# The published seamless maps, where the shared data lie beside the checkout. Needs io for the files, which module
# quantize may not see.
if(TARGET hexfield::io)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*_models.cpp)
  add_executable(test_quantize_models ${sources})
  target_link_libraries(test_quantize_models PRIVATE test_support hexfield::io hexfield::quantize Boost::headers deps::gmp)
  add_test(NAME quantize_models COMMAND test_quantize_models)
  set_tests_properties(quantize_models PROPERTIES LABELS quantize TIMEOUT 600 PROCESSORS 2 ENVIRONMENT "${HEXFIELD_TEST_ENVIRONMENT}")
endif()
# A benchmark only times, so ctest never runs it.
if(HEXFIELD_BENCHMARKS AND TARGET hexfield::io)
  add_executable(bench_quantize ${CMAKE_CURRENT_LIST_DIR}/../bench/quantize_bench.cpp)
  target_link_libraries(bench_quantize PRIVATE hexfield::io hexfield::quantize deps::gmp)
endif()
