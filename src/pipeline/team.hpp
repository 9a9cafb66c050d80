#pragma once

#include <mpi.h>

#include <exception>
#include <functional>

#include "hexfield/base/log.hpp"

namespace hexfield {

/// The ranks of a run and how they stay together when one of them fails or waits.
class Team {
 public:
  /// Duplicates `comm`, so that waiting here never meets a message of a stage. Collective.
  Team(MPI_Comm comm, Log& log);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  MPI_Comm comm() const { return comm_; }
  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_root() const { return rank_ == 0; }

  /// Runs collective work on every rank; an exception on any rank becomes the same Error on all. When a rank has
  /// failed alone and the others stay in a call that waits for it, the whole program is aborted with the code of
  /// the failure after `patience` seconds. Collective.
  void together(const std::function<void()>& work);

  /// Runs `work` on rank 0 while the others sleep, and makes a failure that of all. A stop signal that reaches only
  /// a waiting rank is passed on: see stop_passed_on(). Collective.
  void on_root(const std::function<void()>& work);

  /// Inside on_root() on rank 0: true once a waiting rank got a stop signal. Its number is in `number`.
  bool stop_passed_on(int& number);

  static constexpr double patience = 20;

 private:
  void wait_while_root_works();
  void settle(std::exception_ptr mine);

  MPI_Comm comm_ = MPI_COMM_NULL;
  MPI_Comm waiting_ = MPI_COMM_NULL;
  Log& log_;
  int rank_ = 0;
  int size_ = 1;
};

/// Code and sentence of any exception.
class Error error_of(const std::exception_ptr& failure);

}  // namespace hexfield
