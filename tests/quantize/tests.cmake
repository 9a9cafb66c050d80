# The published seamless maps, where the shared data lie beside the checkout. Needs io for the files, which module
# quantize may not see.
if(TARGET hexfield::io)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*_models.cpp)
  add_executable(test_quantize_models ${sources})
  target_link_libraries(test_quantize_models PRIVATE test_support hexfield::io hexfield::quantize Boost::headers deps::gmp)
  add_test(NAME quantize_models COMMAND test_quantize_models)
  set_tests_properties(quantize_models PROPERTIES LABELS quantize TIMEOUT 600 PROCESSORS 2 ENVIRONMENT "${HEXFIELD_TEST_ENVIRONMENT}")
endif()
