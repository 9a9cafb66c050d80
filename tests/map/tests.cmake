# A benchmark only times, so ctest never runs it. Needs io for checkpoints, which module map may not see.
if(HEXFIELD_BENCHMARKS AND TARGET hexfield::io)
  add_executable(bench_map ${CMAKE_CURRENT_LIST_DIR}/../bench/map_bench.cpp)
  target_link_libraries(bench_map PRIVATE hexfield::io hexfield::map)
endif()
