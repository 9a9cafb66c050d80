#pragma once

#include <mpi.h>

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "hexfield/base/control.hpp"
#include "hexfield/field/frame_field.hpp"
#include "hexfield/map/conforming_space.hpp"

namespace hexfield {

/// Weights (w_S, w_I) of smoothness and integrability beside the symmetric Dirichlet energy of weight 1.
struct IntegrableStage {
  double smoothness = 0;
  double integrability = 0;
};

/// Parameters of the integrable-frame optimisation. Schedule: spec-lmff section 8; the rest is ours.
struct IntegrableOptions {
  std::vector<IntegrableStage> schedule = {{1e4, 1e4}, {1e3, 1e5}, {1e2, 1e6}, {1e1, 1e7}, {0, 1e8}, {0, 1e9}};
  int max_newton_steps = 30;         ///< per stage
  double decrease_tolerance = 1e-3;  ///< a stage ends when a Newton step promises less than this part of the energy
  double last_decrease_tolerance = 1e-6;  ///< the same for the last stage of the schedule
  double linear_tolerance = 1e-1;         ///< forcing term: relative residual in the norm of the preconditioner
  int max_linear_iterations = 100;        ///< per Newton step
  int aggregate_size = 20;                ///< tets per aggregate of the coarse space for fields that are not gradients
  bool refresh_scale = true;              ///< measure distortion against the volumes of the last stage's frames
  int cholesky_limit = 150000;            ///< coarse spaces with more unknowns use multigrid
  /// Iterations of the linear solver (with what the rest of a Newton step is worth) in all stages together, after which
  /// the frames are as good as they get; 0: no limit. A number of passes over the mesh, so the time is proportional to
  /// its size.
  long max_work = 0;
};

/// What one stage did. Energies are without their weights.
struct IntegrableStageReport {
  IntegrableStage stage;
  int newton_steps = 0;
  int linear_iterations = 0;
  double seconds = 0;
  double distortion = 0;
  double smoothness = 0;
  double integrability = 0;
  /// Largest |(J_i - M_ij J_j) t| over unit vectors t of inner faces, times the local edge length (so relative).
  double max_curl = 0;
  bool stopped = false;    ///< Control asked to stop; the frames are those of the last accepted step
  bool exhausted = false;  ///< the work of all stages is done; the frames are those of the last accepted step
};

/// Frames J_t (rows are the gradients of the three coordinates in tet t), optimised towards integrability
/// without ever inverting: truncated Newton on E_SD + w_S E_S + w_I E_I (Liu & Bommes 2023, section 6.1;
/// spec-lmff section 8) where the alignments hold exactly by elimination in each tet. The linear systems are
/// solved by conjugate gradients on all ranks, preconditioned by 9x9 blocks plus two coarse spaces: conforming
/// maps, and piecewise constant combed frames on aggregates of tets.
class IntegrableFrames {
 public:
  /// `mesh`, `field`, `constraints` and `space` are read on rank 0. Start: J = F^T, made to obey the
  /// constraints; lengths are in units of the mesh, so multiply by 1 / edge length for a map of that edge length.
  /// Throws Error(no_seamless_map) naming tets that cannot obey their constraints. Collective.
  IntegrableFrames(MPI_Comm comm, const TetMesh& mesh, const FrameField& field,
                   std::span<const AxisConstraint> constraints, const ConformingSpace& space,
                   const IntegrableOptions& options);
  ~IntegrableFrames();
  IntegrableFrames(const IntegrableFrames&) = delete;
  IntegrableFrames& operator=(const IntegrableFrames&) = delete;

  /// Minimises with these weights from the present frames. `tolerance`: see decrease_tolerance. Asks
  /// control.stop_requested in every iteration of the linear solver (does not throw). Collective.
  IntegrableStageReport run(const IntegrableStage& stage, double tolerance, const Control& control);

  /// J per tet on rank 0 (empty elsewhere). Collective.
  std::vector<Mat3> gather() const;
  /// Replaces the frames by J per tet from rank 0, projected onto the constraints. Collective.
  void set(const std::vector<Mat3>& on_root);
  /// Work so far, in the unit of IntegrableOptions::max_work, and what an interrupted run had done.
  long work() const;
  void set_work(long work);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Runs the schedule until its end or that of the work. After each stage `done(stage index, frames, report)` is asked,
/// on all ranks, whether to end early (it must answer the same everywhere). Offers and restores the iterate
/// "integrable-frames" (stage, work, then 9 numbers per tet) through `control`; throws Error(stopped) when asked to
/// stop. Collective.
std::vector<IntegrableStageReport> optimise_integrable_frames(
    IntegrableFrames& frames, MPI_Comm comm, const IntegrableOptions& options, const Control& control,
    const std::function<bool(std::size_t, IntegrableFrames&, const IntegrableStageReport&)>& done);

}  // namespace hexfield
