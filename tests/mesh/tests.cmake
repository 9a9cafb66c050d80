# A benchmark only times, so ctest never runs it.
if(HEXFIELD_BENCHMARKS)
  add_executable(bench_mesh ${CMAKE_CURRENT_LIST_DIR}/../bench/mesh_bench.cpp)
  target_include_directories(bench_mesh PRIVATE ${CMAKE_CURRENT_LIST_DIR}/..)
  target_link_libraries(bench_mesh PRIVATE hexfield::mesh benchmark::benchmark)
endif()
