# A benchmark only times, so ctest never runs it.
if(HEXFIELD_BENCHMARKS)
  add_executable(bench_field ${CMAKE_CURRENT_LIST_DIR}/../bench/field_bench.cpp)
  target_include_directories(bench_field PRIVATE ${CMAKE_CURRENT_LIST_DIR}/..)
  target_link_libraries(bench_field PRIVATE hexfield::field benchmark::benchmark)
endif()
