# Readers of others on what the writers write.
# vtu_test.cpp compresses arrays itself.
target_link_libraries(test_io PRIVATE ZLIB::ZLIB)
add_executable(io_write_samples ${CMAKE_CURRENT_LIST_DIR}/write_samples.cpp)
target_include_directories(io_write_samples PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(io_write_samples PRIVATE hexfield::io GTest::gtest)
add_test(NAME io_external_readers
  COMMAND ${HEXFIELD_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/external_readers_test.py $<TARGET_FILE:io_write_samples>)
set_tests_properties(io_external_readers PROPERTIES LABELS io TIMEOUT 120 SKIP_RETURN_CODE 77)
