#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hexfield/map/integrable_frames.hpp"
#include "hexfield/mesh/distributed.hpp"
#include "hexfield/solve/kernels.hpp"

namespace hexfield::integrable {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Jacobians = Eigen::Map<const RowMajor3>;

/// Unweighted parts of the energy.
struct Energies {
  double distortion = 0;
  double smoothness = 0;
  double integrability = 0;
  double total(const IntegrableStage& w) const {
    return distortion + w.smoothness * smoothness + w.integrability * integrability;
  }
};

/// Energy of the frames of one rank's tets, its derivatives and the product with its Hessian.
///
/// Vectors hold 9 numbers per owned tet (J row-major). All work on "owned" vectors is local, except that
/// frames of ghosts are fetched: functions that say so are collective.
class Problem {
 public:
  /// Collective; field and constraints on rank 0.
  Problem(const DistributedMesh& mesh, const FrameField& field, std::span<const AxisConstraint> constraints, bool root);

  std::size_t size() const { return 9 * mesh_.num_owned(); }
  const DistributedMesh& mesh() const { return mesh_; }
  const std::vector<double>& start() const { return start_; }
  double volume_fraction(std::size_t t) const { return volumes_[t]; }
  double scale(std::size_t t) const { return scales_[t]; }
  const std::array<Mat3, 3>& projectors(std::size_t t) const { return projectors_[t]; }
  bool constrained(std::size_t t) const { return constrained_[t] != 0; }
  const Mat3& matching(std::size_t t, int face) const {
    return faces_[4 * t + static_cast<std::size_t>(face)].matching;
  }
  /// Hessian weights of a face: 2 (alpha + beta) and 2 beta of Q = alpha I + beta (I - n n^T); zero on the boundary.
  struct FaceWeights {
    double whole = 0;
    double normal = 0;
    Vec3 n = Vec3::Zero();
  };
  FaceWeights face_weights(std::size_t t, int face) const;

  /// Measures distortion of `frames` against their own volumes from now on. Collective.
  void refresh_scales(std::span<const double> frames);
  /// Collective.
  void set_stage(const IntegrableStage& stage);
  /// Energies summed over ranks; infinite distortion where a tet is inverted. Collective.
  Energies energies(std::span<const double> frames);
  double max_curl(std::span<const double> frames);
  /// Gradient (projected) and the state that multiply() and block() use. Collective.
  void linearise(std::span<const double> frames, std::span<double> gradient);
  /// result = P H P x for x = P x. Collective.
  void multiply(std::span<const double> x, std::span<double> result);
  /// P H_tt P + trace (I - P): the tet's own block, invertible.
  solve::Mat9 block(std::size_t t) const;
  /// The symmetric Dirichlet part of H_tt, weight included.
  solve::Mat9 distortion_block(std::size_t t) const;
  void project(std::span<double> x) const;
  /// Per owned tet the largest step that does not invert it (may be infinite).
  std::vector<double> step_limits(std::span<const double> frames, std::span<const double> direction) const;

 private:
  struct HalfFace {
    Mat3 matching = Mat3::Identity();  // M: J_t = M J_neighbour
    Vec3 normal = Vec3::Zero();
    std::int32_t neighbour = -1;
    double whole = 0;  // 2 (alpha + beta)
    double beta2 = 0;  // 2 beta
  };
  void read_constraints(std::span<const AxisConstraint> constraints, std::span<const Quaternion> frames, bool root);
  void compute_geometry();
  void compute_start(const std::vector<double>& quaternions);
  const double* with_ghosts(std::span<const double> owned);

  const DistributedMesh& mesh_;
  bool alone_ = true;  // one rank has no ghosts
  IntegrableStage stage_;
  std::vector<double> volumes_;  // fraction of the whole, ghosts too
  std::vector<double> scales_;   // a_t, ghosts too
  std::vector<HalfFace> faces_;  // 4 per owned tet
  std::vector<std::array<Mat3, 3>> projectors_;
  std::vector<char> constrained_;
  std::vector<double> start_;
  std::vector<Mat3> face_sums_;  // sum of 2 Q over the faces of an owned tet
  std::vector<solve::FactoredHessian> distortion_;
  std::vector<double> ghosted_;
};

}  // namespace hexfield::integrable
