#pragma once

#include <petscsys.h>

namespace hexfield {

/// Throws Error(bug) naming `what` when a PETSc call did not return 0. Not collective by itself: a PETSc
/// call that can fail on one rank only belongs into agree().
void check_petsc(PetscErrorCode code, const char* what);

}  // namespace hexfield
