#include "hexfield/solve/interrupt.hpp"

#include <exception>

#include "hexfield/base/petsc.hpp"

namespace hexfield::solve {

Interrupt::Interrupt(KSP ksp, std::function<bool()> wanted) : wanted_(std::move(wanted)) {
  if (!wanted_) return;
  check_petsc(KSPConvergedDefaultCreate(&default_test_), "KSPConvergedDefaultCreate");
  check_petsc(KSPSetConvergenceTest(ksp, &Interrupt::test, this, nullptr), "KSPSetConvergenceTest");
}

Interrupt::~Interrupt() {
  if (default_test_ != nullptr) KSPConvergedDefaultDestroy(default_test_);
}

PetscErrorCode Interrupt::test(KSP ksp, PetscInt iteration, PetscReal norm, KSPConvergedReason* reason, void* self) {
  auto& interrupt = *static_cast<Interrupt*>(self);
  const PetscErrorCode error = KSPConvergedDefault(ksp, iteration, norm, reason, interrupt.default_test_);
  if (error != 0 || *reason != KSP_CONVERGED_ITERATING) return error;
  // Exceptions must not pass through C code.
  try {
    interrupt.happened_ = interrupt.wanted_();
  } catch (const std::exception&) {
    return PETSC_ERR_LIB;
  }
  if (interrupt.happened_) *reason = KSP_DIVERGED_BREAKDOWN;
  return 0;
}

}  // namespace hexfield::solve
