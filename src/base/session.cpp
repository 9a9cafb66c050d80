#include "hexfield/base/session.hpp"

#include <petscsys.h>

#include <cstdlib>

#include "hexfield/base/launch.hpp"
#include "hexfield/base/parallel.hpp"

namespace hexfield {
namespace {

// A program that runs alone needs no daemon that could start others, and no look at graphics cards: half of its start.
void start_lightly() {
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  setenv("HWLOC_COMPONENTS", "-opencl,-gl", 0);
}

}  // namespace

Session::Session(int& argc, char**& argv) {
  int provided = 0;
  start_lightly();
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  // PETSc must not read our command line, nor take over our signals and floating-point traps.
  PetscOptionsSetValue(nullptr, "-no_signal_handler", nullptr);
  PetscInitializeNoArguments();
  PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_ARE_FATAL);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  use_one_blas_thread();
  set_threads(threads_given_to_rank(MPI_COMM_WORLD));
}

Session::~Session() {
  PetscFinalize();
  MPI_Finalize();
}

}  // namespace hexfield
