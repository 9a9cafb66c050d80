#include "team.hpp"

#include <fmt/format.h>

#include <chrono>
#include <new>
#include <thread>
#include <vector>

#include "hexfield/base/agree.hpp"
#include "hexfield/base/error.hpp"
#include "hexfield/base/signals.hpp"
#include "hexfield/base/stopwatch.hpp"

namespace hexfield {
namespace {

constexpr int stop_tag = 1;

void nap() { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }

}  // namespace

Error error_of(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const Error& error) {
    return error;
  } catch (const std::bad_alloc&) {
    return Error(ExitCode::bug, "The memory of this machine does not suffice.");
  } catch (const std::exception& other) {
    return Error(ExitCode::bug, fmt::format("Unexpected failure: {}.", other.what()));
  } catch (...) {
    return Error(ExitCode::bug, "Unexpected failure of unknown kind.");
  }
}

Team::Team(MPI_Comm comm, Log& log) : log_(log) {
  MPI_Comm_dup(comm, &comm_);
  MPI_Comm_dup(comm, &waiting_);
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size_);
}

Team::~Team() {
  MPI_Comm_free(&waiting_);
  MPI_Comm_free(&comm_);
}

void Team::settle(std::exception_ptr mine) {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(waiting_, &request);
  const auto start = Clock::now();
  for (int done = 0; done == 0;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done != 0) break;
    if (mine && seconds_since(start) > patience) {
      const Error error = error_of(mine);
      log_.say_alone(LogLevel::error, error.sentence());
      MPI_Abort(comm_, static_cast<int>(error.code()));
    }
    nap();
  }
  agree(comm_, [&] {
    if (mine) throw error_of(mine);
  });
}

void Team::together(const std::function<void()>& work) {
  std::exception_ptr failure;
  try {
    work();
  } catch (...) {
    failure = std::current_exception();
  }
  settle(failure);
}

void Team::wait_while_root_works() {
  int done_by_root = 0;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibcast(&done_by_root, 1, MPI_INT, 0, waiting_, &request);
  int sent = 0;
  for (int done = 0; done == 0;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done != 0) break;
    if (const int number = stop_signal(); number != 0 && sent == 0) {
      MPI_Send(&number, 1, MPI_INT, 0, stop_tag, waiting_);
      sent = 1;
    }
    nap();
  }
}

bool Team::stop_passed_on(int& number) {
  if (!is_root()) return false;
  int waiting = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, stop_tag, waiting_, &waiting, &status);
  if (waiting == 0) return false;
  MPI_Recv(&number, 1, MPI_INT, status.MPI_SOURCE, stop_tag, waiting_, MPI_STATUS_IGNORE);
  return true;
}

void Team::on_root(const std::function<void()>& work) {
  std::exception_ptr failure;
  if (is_root()) {
    try {
      work();
    } catch (...) {
      failure = std::current_exception();
    }
    int done = 1;
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibcast(&done, 1, MPI_INT, 0, waiting_, &request);
    MPI_Wait(&request, MPI_STATUS_IGNORE);
  } else {
    wait_while_root_works();
  }
  agree(comm_, [&] {
    if (failure) throw error_of(failure);
  });
  // A message sent just before the end of the work must not be taken for one of the next.
  for (int number = 0; stop_passed_on(number);) {
  }
}

}  // namespace hexfield
