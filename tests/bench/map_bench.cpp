// Stages 4 and 6 alone, on the field of a checkpoint: what every solve of them cost.
//   bench_map RUN.h5 | MAP.hexex [--hexes N] [--threads T] [--no-igm]
// makes nothing but a table; RUN.h5 is that of `hexfield run MODEL -o DIR --to field`. A field that is not locally
// meshable is taken as well, so that a failure can be timed. A map gives its topology, for fields that are known to be
// meshable: the frames are the rotations of its Jacobians, smoothed as stage 3 does at its end.
#include <fmt/core.h>
#include <sys/resource.h>

#include <Eigen/SVD>
#include <cmath>
#include <cstring>
#include <string>

#include "hexfield/base/parallel.hpp"
#include "hexfield/base/session.hpp"
#include "hexfield/field/align_field.hpp"
#include "hexfield/field/constraints.hpp"
#include "hexfield/io/checkpoint.hpp"
#include "hexfield/io/checkpoint_values.hpp"
#include "hexfield/io/hexex_io.hpp"
#include "hexfield/map/alignments.hpp"
#include "hexfield/map/compute_map.hpp"
#include "hexfield/map/cut_graph.hpp"
#include "hexfield/map/verify.hpp"
#include "hexfield/solve/kernels.hpp"

using namespace hexfield;

namespace {

double user_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

void print(const char* stage, const std::vector<SolveRecord>& solves) {
  for (const SolveRecord& s : solves)
    fmt::print("{:10} {:32} newton {:4} linear {:6} wall {:8.2f}  inverted {:6} wrong {:6}\n", stage, s.what,
               s.newton_steps, s.linear_iterations, s.seconds, s.inverted, s.wrong_edges);
}

Mat3 jacobian(const TetMesh& mesh, const CornerMap& map, std::size_t t) {
  Mat3 domain, image;
  for (std::size_t k = 0; k < 3; ++k) {
    domain.col(static_cast<Eigen::Index>(k)) = mesh.point(mesh.tets[t][k + 1]) - mesh.point(mesh.tets[t][0]);
    image.col(static_cast<Eigen::Index>(k)) = map.uvw[t][k + 1] - map.uvw[t][0];
  }
  return image * domain.inverse();
}

// Mean symmetric Dirichlet energy relative to the mean edge length, by volume.
double distortion(const TetMesh& mesh, const CornerMap& map) {
  double volume = 0;
  double sum = 0;
  const double scale = 1 / std::cbrt(parametric_volume(map));
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) volume += signed_volume6(mesh, TetId(t)) / 6;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) {
    sum += signed_volume6(mesh, TetId(t)) / 6 *
           solve::symmetric_dirichlet(std::cbrt(volume) * scale * jacobian(mesh, map, t));
  }
  return sum / volume;
}

// What the frames must follow, with the axes that the map has: sheared Jacobians may be closer to others.
std::vector<AxisConstraint> constraints_of_map(const FieldResult& f, const CornerMap& map) {
  std::vector<AxisConstraint> constraints;
  auto add = [&](TetId t, int axis, const Vec3& d, AxisConstraint::Kind kind) {
    const bool negative = jacobian(f.mesh, map, t.index()).row(axis).dot(d) < 0;
    constraints.push_back({t, static_cast<octahedral::Label>(2 * axis + (negative ? 1 : 0)), d, kind, {}, {}});
  };
  const Alignments alignments = alignments_of_map(f.mesh, f.features, f.codes, map);
  for (const FaceAlignment& a : alignments.faces)
    add(a.face.tet(), a.axis, outward_normal(f.mesh, a.face), AxisConstraint::Kind::feature_face);
  for (const EdgeAlignment& a : alignments.edges)
    add(a.tet, a.axis, (f.mesh.point(a.edge[1]) - f.mesh.point(a.edge[0])).normalized(),
        AxisConstraint::Kind::singular_edge);
  return constraints;
}

// Field with the topology of a map; rank 0 holds all.
FieldResult field_of_map(const std::string& file) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  FieldResult f;
  std::vector<AxisConstraint> constraints;
  if (rank == 0) {
    HexexInput input = read_hexex(file);
    f.mesh = std::move(input.mesh);
    f.features = std::move(input.features);
    f.codes = codes_of_map(f.mesh, input.map);
    f.field.matchings = matchings_of(input.map);
    for (std::size_t t = 0; t < f.mesh.num_tets(); ++t) {
      const Eigen::JacobiSVD<Mat3> svd(jacobian(f.mesh, input.map, t), Eigen::ComputeFullU | Eigen::ComputeFullV);
      f.field.frames.emplace_back(Mat3(svd.matrixV() * svd.matrixU().transpose()));
    }
    constraints = constraints_of_map(f, input.map);
  }
  align_field(DistributedMesh(MPI_COMM_WORLD, f.mesh), f.field, constraints, {});
  return f;
}

}  // namespace

int main(int argc, char** argv) {
  const Session session(argc, argv);
  std::string file;
  double hexes = 10000;
  bool igm = true;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--hexes") == 0 && i + 1 < argc)
      hexes = std::stod(argv[++i]);
    else if (std::strcmp(argv[i], "--threads") == 0 && i + 1 < argc)
      set_threads(std::stoi(argv[++i]));
    else if (std::strcmp(argv[i], "--no-igm") == 0)
      igm = false;
    else
      file = argv[i];
  }
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  FieldResult f;
  if (file.ends_with(".hexex"))
    f = field_of_map(file);
  else if (rank == 0)
    f = unpack_field(Checkpoint::open(file).load("field"));
  const double start = user_seconds();
  SeamlessOptions options;
  options.target_hexes = hexes;
  const SeamlessResult seamless =
      compute_seamless_map(MPI_COMM_WORLD, f.mesh, f.features, f.field, f.codes, options, {});
  const double after_seamless = user_seconds();
  if (rank == 0) {
    print("seamless", seamless.solves);
    fmt::print("seamless   {} tets, valid {}, inverted {}, wrong edges {}, distortion {:.5f}, user {:.1f} s\n",
               f.mesh.num_tets(), seamless.report.valid(), seamless.report.inverted.size(),
               seamless.report.wrong_edges.size(), distortion(f.mesh, seamless.map), after_seamless - start);
  }
  if (!igm || !seamless.report.valid()) return seamless.report.valid() ? 0 : 5;
  IgmOptions igm_options;
  igm_options.target_hexes = hexes;
  const IgmResult result =
      compute_integer_grid_map(MPI_COMM_WORLD, f.mesh, f.features, f.codes, seamless.map, igm_options, {});
  if (rank == 0) {
    print("igm", result.solves);
    fmt::print("igm        valid {}, inverted {}, wrong edges {}, hexes {:.0f}, distortion {:.5f}, user {:.1f} s{}{}\n",
               result.report.valid(), result.report.inverted.size(), result.report.wrong_edges.size(),
               parametric_volume(result.map), distortion(f.mesh, result.map), user_seconds() - after_seamless,
               result.reason.empty() ? "" : ": ", result.reason);
  }
  return result.report.valid() && result.reason.empty() ? 0 : 6;
}
