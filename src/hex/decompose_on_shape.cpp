#include "hexfield/hex/check.hpp"
#include "hexfield/hex/decompose.hpp"
#include "hexfield/hex/improve.hpp"

namespace hexfield {
namespace {

void improve_on(HexMesh& mesh, const HexShape& shape, const ImproveOptions& options, const Control& control) {
  if (shape.mesh == nullptr)
    improve_free_hex_mesh(mesh, options, control);
  else
    improve_hex_mesh(mesh, *shape.mesh, *shape.features, options, control);
}

}  // namespace

void improve_thoroughly(HexMesh& mesh, const HexShape& shape, const Control& control) {
  ImproveOptions sweeps;
  sweeps.good_enough = 0.95;
  sweeps.max_rounds = 100;
  sweeps.maximise_steps = 0;
  improve_on(mesh, shape, sweeps, control);
  if (shape.mesh == nullptr)
    maximise_minimum(mesh, {}, control);
  else
    maximise_minimum(mesh, *shape.mesh, *shape.features, {}, control);
}

Decomposition decompose_on_shape(const HexMesh& mesh, const HexShape& shape, const DecomposeOptions& options,
                                 const Control& control) {
  ImproveOptions quick;
  quick.max_rounds = 5;
  quick.maximise_steps = 0;
  const auto settle = [&](HexMesh& now) {
    improve_on(now, shape, quick, control);
    return quality(now).not_positive == 0;
  };
  Decomposition out = decompose(mesh, options, settle, control);
  if (out.stopped) return out;
  try {
    improve_thoroughly(out.mesh, shape, control);
  } catch (const Error& error) {
    if (error.code() != ExitCode::stopped) throw;
    out.stopped = true;
  }
  return out;
}

}  // namespace hexfield
