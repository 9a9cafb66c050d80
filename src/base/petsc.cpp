#include "hexfield/base/petsc.hpp"

#include <fmt/core.h>

#include "hexfield/base/error.hpp"

namespace hexfield {

void check_petsc(PetscErrorCode code, const char* what) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw Error(ExitCode::bug, fmt::format("PETSc failed in {}: {} (code {}).", what, text != nullptr ? text : "?",
                                         static_cast<int>(code)));
}

}  // namespace hexfield
