#include "hexfield/pipeline/version.hpp"

#include <fmt/format.h>
#include <hexfield_version.h>
#include <metis.h>
#include <mpi.h>
#include <petscsys.h>
#include <spdlog/version.h>
#include <tbb/version.h>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "hexfield/io/checkpoint.hpp"

namespace hexfield {
namespace {

std::string mpi_version() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING] = {};
  int length = 0;
  MPI_Get_library_version(text, &length);
  const std::string line(text, static_cast<std::size_t>(length));
  return line.substr(0, line.find_first_of(",\n"));
}

std::string petsc_version() {
  PetscInt major = 0;
  PetscInt minor = 0;
  PetscInt subminor = 0;
  PetscGetVersionNumber(&major, &minor, &subminor, nullptr);
  return fmt::format("{}.{}.{} ({}-bit integers)", major, minor, subminor, 8 * sizeof(PetscInt));
}

}  // namespace

std::string program_version() { return HEXFIELD_VERSION; }

std::string program_git() { return HEXFIELD_GIT; }

std::vector<std::pair<std::string, std::string>> library_versions() {
  return {
      {"MPI", mpi_version()},
      {"oneTBB", TBB_runtime_version()},
      {"PETSc", petsc_version()},
      {"METIS",
       fmt::format("{}.{}.{} ({}-bit integers)", METIS_VER_MAJOR, METIS_VER_MINOR, METIS_VER_SUBMINOR, IDXTYPEWIDTH)},
      {"HDF5", hdf5_version()},
      {"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
      {"spdlog", fmt::format("{}.{}.{}", SPDLOG_VER_MAJOR, SPDLOG_VER_MINOR, SPDLOG_VER_PATCH)},
      {"JSON for Modern C++",
       fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
  };
}

}  // namespace hexfield
