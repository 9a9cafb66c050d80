# A benchmark only times, so ctest never runs it.
if(HEXFIELD_BENCHMARKS)
  add_executable(bench_solve ${CMAKE_CURRENT_LIST_DIR}/../bench/solve_bench.cpp)
  target_include_directories(bench_solve PRIVATE ${CMAKE_CURRENT_LIST_DIR}/..)
  target_link_libraries(bench_solve PRIVATE hexfield::solve benchmark::benchmark)
endif()
