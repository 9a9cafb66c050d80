#include "hexfield/base/session.hpp"

#include <petscsys.h>

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
}

Session::~Session() {
  PetscFinalize();
  MPI_Finalize();
}

}  // namespace hexfield
