# Mutated files for every reader; run it longer by hand: fuzz_readers 200000 SEED.
add_executable(fuzz_readers ${CMAKE_CURRENT_LIST_DIR}/fuzz_readers.cpp)
target_include_directories(fuzz_readers PRIVATE ${CMAKE_CURRENT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/src/io)
target_link_libraries(fuzz_readers PRIVATE hexfield::io GTest::gtest)
add_test(NAME fuzz_readers COMMAND fuzz_readers 2000)
set_tests_properties(fuzz_readers PROPERTIES LABELS fuzz TIMEOUT 600)
