#pragma once

#include <mpi.h>

#include <span>

namespace hexfield {

/// Sum of the terms of all ranks in fixed point, 70 bits below the largest term: the same bits for any
/// order, number of threads and distribution over ranks. At most 2^28 terms, finite. Collective.
double exact_sum(MPI_Comm comm, std::span<const double> terms);

}  // namespace hexfield
