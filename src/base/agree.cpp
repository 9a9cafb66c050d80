#include "hexfield/base/agree.hpp"

#include <optional>
#include <string>
#include <vector>

#include "hexfield/base/error.hpp"

namespace hexfield {
namespace {

std::optional<Error> attempt(const std::function<void()>& work) {
  try {
    work();
    return std::nullopt;
  } catch (const Error& error) {
    return error;
  } catch (const std::exception& other) {
    return Error(ExitCode::bug, std::string("Unexpected failure: ") + other.what());
  }
}

template <class T>
void broadcast(MPI_Comm comm, int root, std::vector<T>& values) {
  int bytes = static_cast<int>(values.size() * sizeof(T));
  MPI_Bcast(&bytes, 1, MPI_INT, root, comm);
  values.resize(static_cast<std::size_t>(bytes) / sizeof(T));
  MPI_Bcast(values.data(), bytes, MPI_BYTE, root, comm);
}

}  // namespace

void agree(MPI_Comm comm, const std::function<void()>& work) {
  int rank = 0;
  int size = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  const std::optional<Error> mine = attempt(work);
  int first = mine ? rank : size;
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, comm);
  if (first == size) return;

  std::vector<char> sentence;
  std::vector<std::int64_t> ids;
  std::vector<double> places;
  int code = 0;
  if (rank == first) {
    code = static_cast<int>(mine->code());
    sentence.assign(mine->sentence().begin(), mine->sentence().end());
    ids = mine->ids();
    for (const Vec3& p : mine->places()) places.insert(places.end(), p.data(), p.data() + 3);
  }
  MPI_Bcast(&code, 1, MPI_INT, first, comm);
  broadcast(comm, first, sentence);
  broadcast(comm, first, ids);
  broadcast(comm, first, places);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i + 2 < places.size(); i += 3) points.emplace_back(places[i], places[i + 1], places[i + 2]);
  throw Error(static_cast<ExitCode>(code), std::string(sentence.begin(), sentence.end()), ids, points);
}

}  // namespace hexfield
