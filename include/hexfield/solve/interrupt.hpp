#pragma once

#include <petscksp.h>

#include <functional>

namespace hexfield::solve {

/// Lets whoever waits for a linear solve interrupt it between two iterations. Must outlive the solves.
class Interrupt {
 public:
  /// `wanted` is asked in every iteration of `ksp` that has not converged, on all ranks; it must answer the same
  /// everywhere. May be empty: nothing is ever interrupted.
  Interrupt(KSP ksp, std::function<bool()> wanted);
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// Called before a solve.
  void reset() { happened_ = false; }
  /// Whether a solve since then was interrupted: its solution means nothing.
  bool happened() const { return happened_; }

 private:
  static PetscErrorCode test(KSP ksp, PetscInt iteration, PetscReal norm, KSPConvergedReason* reason, void* self);

  std::function<bool()> wanted_;
  void* default_test_ = nullptr;  // context of KSPConvergedDefault()
  bool happened_ = false;
};

}  // namespace hexfield::solve
