#include "collective.hpp"

namespace hexfield {
namespace {

template <class T>
void broadcast_bytes(MPI_Comm comm, std::vector<T>& values) {
  auto size = static_cast<long long>(values.size());
  MPI_Bcast(&size, 1, MPI_LONG_LONG, 0, comm);
  values.resize(static_cast<std::size_t>(size));
  MPI_Bcast(static_cast<void*>(values.data()), static_cast<int>(sizeof(T) * values.size()), MPI_BYTE, 0, comm);
}

}  // namespace

int rank_of(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

void broadcast(MPI_Comm comm, double& value) { MPI_Bcast(&value, 1, MPI_DOUBLE, 0, comm); }
void broadcast(MPI_Comm comm, int& value) { MPI_Bcast(&value, 1, MPI_INT, 0, comm); }
void broadcast(MPI_Comm comm, bool& value) {
  int number = value ? 1 : 0;
  broadcast(comm, number);
  value = number != 0;
}
void broadcast(MPI_Comm comm, std::vector<double>& values) { broadcast_bytes(comm, values); }
void broadcast(MPI_Comm comm, std::string& text) {
  std::vector<char> bytes(text.begin(), text.end());
  broadcast_bytes(comm, bytes);
  text.assign(bytes.begin(), bytes.end());
}
void broadcast(MPI_Comm comm, std::vector<Vec3>& places) { broadcast_bytes(comm, places); }
void broadcast(MPI_Comm comm, MapReport& report) {
  broadcast_bytes(comm, report.inverted);
  broadcast_bytes(comm, report.wrong_edges);
  broadcast(comm, report.max_residual);
}

}  // namespace hexfield
