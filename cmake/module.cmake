add_library(hexfield_flags INTERFACE)
# mpi.h must not pull in the removed C++ bindings; they are not linked.
target_compile_definitions(hexfield_flags INTERFACE OMPI_SKIP_MPICXX=1 MPICH_SKIP_MPICXX=1)
# Exact predicates and equal bytes on all machines need uncontracted arithmetic.
target_compile_options(hexfield_flags INTERFACE -ffp-contract=off)
target_compile_options(hexfield_flags INTERFACE
  $<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wshadow;$<$<BOOL:${HEXFIELD_WERROR}>:-Werror>>
  $<BUILD_INTERFACE:$<$<BOOL:${HEXFIELD_ARCH}>:-march=${HEXFIELD_ARCH}>>)
if(HEXFIELD_SANITIZE)
  target_compile_options(hexfield_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(hexfield_flags INTERFACE -fsanitize=address,undefined)
endif()

# The standard and Eigen headers that most files include, parsed once for all modules. Compiler caches do
# without: they would miss on every file.
option(HEXFIELD_PCH "Precompile common headers" ON)
# hexfield_precompile(TARGET SOURCE [HEADERS...]): with the precompiled headers of SOURCE; where that is the target
# itself, it makes them, the HEADERS among them.
function(hexfield_precompile target source)
  if(NOT HEXFIELD_PCH OR CMAKE_CXX_COMPILER_LAUNCHER)
    return()
  endif()
  if(target STREQUAL source)
    target_precompile_headers(${target} PRIVATE <Eigen/Core> <Eigen/Geometry> <fmt/format.h> <algorithm> <array>
      <functional> <map> <optional> <span> <string> <vector> ${ARGN})
  else()
    target_precompile_headers(${target} REUSE_FROM ${source})
  endif()
endfunction()

# hexfield_module(NAME [DEPS modules...] [LIBS public libraries...] [PRIVATE_LIBS libraries...])
# Builds src/NAME/*.cpp into hexfield::NAME, which sees only the headers of its DEPS.
function(hexfield_module name)
  cmake_parse_arguments(M "" "" "DEPS;LIBS;PRIVATE_LIBS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cpp)
  if(NOT sources)
    return()
  endif()
  add_library(hexfield_${name} STATIC ${sources})
  add_library(hexfield::${name} ALIAS hexfield_${name})
  set_target_properties(hexfield_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(hexfield_${name} PUBLIC cxx_std_20)
  target_include_directories(hexfield_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
  target_link_libraries(hexfield_${name} PUBLIC hexfield_flags ${M_LIBS} PRIVATE ${M_PRIVATE_LIBS})
  foreach(dep ${M_DEPS})
    if(NOT TARGET hexfield::${dep})
      continue()
    endif()
    target_link_libraries(hexfield_${name} PUBLIC hexfield::${dep})
  endforeach()
  hexfield_precompile(hexfield_${name} hexfield_base)
  set_property(GLOBAL APPEND PROPERTY HEXFIELD_MODULES ${name})
endfunction()
