#pragma once

#include <petscksp.h>

namespace hexfield::solve {

/// Whether all rows of the matrix belong to one rank. Collective.
bool one_rank_owns(Mat matrix);

/// Makes `pc` a Cholesky factorisation (MUMPS) by the rank that owns all rows of its matrix; the others wait. The
/// same bytes for any number of ranks. Collective, as is its use.
void use_owner_cholesky(PC pc);

}  // namespace hexfield::solve
