#pragma once

#include <mpi.h>

namespace hexfield {

/// Starts MPI and PETSc for the lifetime of the object and sets the number of threads of this process.
/// Exactly one lives in a program, created first thing in main().
class Session {
 public:
  Session(int& argc, char**& argv);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }

 private:
  int rank_ = 0;
  int size_ = 1;
};

}  // namespace hexfield
