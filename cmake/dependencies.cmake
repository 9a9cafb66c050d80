# Every third-party library, found once, for the build and for projects that use the installed package.
# Only Debian 12 packages; `jobs/install_packages.sh` names them.
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
find_package(MPI 3.1 REQUIRED COMPONENTS C)
find_package(TBB 2021 CONFIG REQUIRED)
find_package(Eigen3 3.4 CONFIG REQUIRED)
find_package(fmt 9 CONFIG REQUIRED)
find_package(spdlog 1.10 CONFIG REQUIRED)
find_package(nlohmann_json 3.11 CONFIG REQUIRED)
find_package(Boost 1.74 CONFIG REQUIRED)

pkg_check_modules(PETSC REQUIRED PETSc>=3.18)
find_library(PETSC_LIBRARY NAMES petsc_real petsc HINTS ${PETSC_LIBRARY_DIRS} REQUIRED)
if(NOT TARGET deps::petsc)
  # Imported, so that the installed targets name it and the user's machine says where it is. Not its CFLAGS
  # from pkg-config: they hold distribution build flags.
  add_library(deps::petsc INTERFACE IMPORTED)
  target_include_directories(deps::petsc INTERFACE ${PETSC_INCLUDE_DIRS})
  target_link_libraries(deps::petsc INTERFACE ${PETSC_LIBRARY} MPI::MPI_C)
endif()

# pkg-config first: FindHDF5 fails in a build directory whose path holds a space.
pkg_check_modules(HDF5_OPENMPI hdf5-openmpi>=1.10)
if(TARGET hdf5::hdf5)
elseif(HDF5_OPENMPI_FOUND)
  add_library(hdf5::hdf5 INTERFACE IMPORTED)
  target_include_directories(hdf5::hdf5 INTERFACE ${HDF5_OPENMPI_INCLUDE_DIRS})
  target_link_libraries(hdf5::hdf5 INTERFACE ${HDF5_OPENMPI_LINK_LIBRARIES} MPI::MPI_C)
else()
  set(HDF5_PREFER_PARALLEL TRUE)
  find_package(HDF5 1.10 REQUIRED COMPONENTS C)
  if(NOT HDF5_IS_PARALLEL)
    message(FATAL_ERROR "A serial HDF5 was found; install libhdf5-openmpi-dev.")
  endif()
endif()

find_path(METIS_INCLUDE_DIR metis.h REQUIRED)
find_library(METIS_LIBRARY metis REQUIRED)
if(NOT TARGET deps::metis)
  add_library(deps::metis INTERFACE IMPORTED)
  target_include_directories(deps::metis INTERFACE ${METIS_INCLUDE_DIR})
  target_link_libraries(deps::metis INTERFACE ${METIS_LIBRARY})
endif()
