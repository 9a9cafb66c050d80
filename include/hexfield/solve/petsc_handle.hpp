#pragma once

#include <petscksp.h>

namespace hexfield::solve {

/// Owns a PETSc object; D is its destroy function.
template <class T, PetscErrorCode (*D)(T*)>
class Handle {
 public:
  Handle() = default;
  ~Handle() { D(&object_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  T get() const { return object_; }
  /// Where a create function puts a new object; destroys the one that was there.
  T* out() {
    D(&object_);
    return &object_;
  }

 private:
  T object_ = nullptr;
};
using VecHandle = Handle<Vec, VecDestroy>;
using MatHandle = Handle<Mat, MatDestroy>;
using KspHandle = Handle<KSP, KSPDestroy>;
using PcHandle = Handle<PC, PCDestroy>;
using IndexSetHandle = Handle<IS, ISDestroy>;
using ScatterHandle = Handle<VecScatter, VecScatterDestroy>;

}  // namespace hexfield::solve
