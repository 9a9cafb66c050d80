#include "hexfield/base/launch.hpp"

#include <dlfcn.h>
#include <sched.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace hexfield {
namespace {

/// cores[c] = 1 when this process may run on core c.
std::vector<int> allowed_cores() {
  std::vector<int> cores(CPU_SETSIZE, 0);
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof(set), &set) != 0) return cores;
  for (int c = 0; c < CPU_SETSIZE; ++c) cores[static_cast<std::size_t>(c)] = CPU_ISSET(c, &set) ? 1 : 0;
  return cores;
}

}  // namespace

int threads_given_to_rank(MPI_Comm comm) {
  const std::vector<int> mine = allowed_cores();
  std::vector<int> ranks_on_core(mine.size(), 0);
  MPI_Comm node = MPI_COMM_NULL;
  MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
  MPI_Allreduce(mine.data(), ranks_on_core.data(), static_cast<int>(mine.size()), MPI_INT, MPI_SUM, node);
  MPI_Comm_free(&node);

  if (const char* text = std::getenv("SLURM_CPUS_PER_TASK")) {
    if (const int given = std::atoi(text); given > 0) return given;
  }
  double share = 0;
  for (std::size_t c = 0; c < mine.size(); ++c) {
    if (mine[c] == 1) share += 1.0 / ranks_on_core[c];
  }
  return std::max(1, static_cast<int>(share + 1e-9));
}

void use_one_blas_thread() {
  using SetThreads = void (*)(int);
  if (void* symbol = dlsym(RTLD_DEFAULT, "openblas_set_num_threads")) reinterpret_cast<SetThreads>(symbol)(1);
}

}  // namespace hexfield
