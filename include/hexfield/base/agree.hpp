#pragma once

#include <mpi.h>

#include <functional>

namespace hexfield {

/// Runs `work` on every rank and makes a failure of one rank the failure of all: each rank then throws
/// the same Error, that of the lowest failing rank. `work` must not communicate: a rank that fails in
/// it would leave the others waiting. Collective.
/// Any other exception becomes an Error with ExitCode::bug that carries its text.
void agree(MPI_Comm comm, const std::function<void()>& work);

}  // namespace hexfield
