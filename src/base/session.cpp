#include "hexfield/base/session.hpp"

#include <petscsys.h>

#include "hexfield/base/launch.hpp"
#include "hexfield/base/parallel.hpp"

namespace hexfield {

Session::Session(int& argc, char**& argv) {
  int provided = 0;
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
