#pragma once

#include <mpi.h>

namespace hexfield {

/// Threads that this rank may use: its share of the cores that the launcher gave to the ranks of its node. A core
/// that k ranks may run on counts 1/k for each of them; at least one. SLURM_CPUS_PER_TASK wins when set. Collective.
int threads_given_to_rank(MPI_Comm comm);

/// Restricts a threaded BLAS, where one is loaded, to one thread: the threads of this program are its own.
void use_one_blas_thread();

}  // namespace hexfield
