#include "hexfield/map/integrable_frames.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "hexfield/base/agree.hpp"
#include "integrable_newton.hpp"

namespace hexfield {
namespace {

using integrable::RowMajor3;

constexpr const char* iterate_name = "integrable-frames";

int rank_of(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

std::vector<std::unique_ptr<integrable::CoarseSpace>> coarse_spaces(MPI_Comm comm, const TetMesh& mesh,
                                                                    const integrable::Problem& problem,
                                                                    const ConformingSpace& space,
                                                                    const IntegrableOptions& options) {
  std::vector<std::int32_t> aggregates;
  if (rank_of(comm) == 0) {
    // At most about 4000 aggregates, so that their direct factorisation stays cheap.
    const int size = std::max(options.aggregate_size, static_cast<int>(mesh.num_tets() / 4000));
    aggregates = integrable::aggregate_tets(mesh, space.cut, size);
  }
  std::vector<std::unique_ptr<integrable::CoarseSpace>> spaces;
  spaces.push_back(integrable::conforming_coarse_space(comm, problem, space, options));
  spaces.push_back(integrable::aggregate_coarse_space(comm, problem, space.cut, aggregates, options));
  return spaces;
}

}  // namespace

struct IntegrableFrames::Implementation {
  MPI_Comm comm;
  IntegrableOptions options;
  DistributedMesh mesh;
  integrable::Problem problem;
  integrable::Newton newton;
  std::vector<double> frames;

  Implementation(MPI_Comm c, const TetMesh& root_mesh, const FrameField& field,
                 std::span<const AxisConstraint> constraints, const ConformingSpace& space,
                 const IntegrableOptions& chosen)
      : comm(c),
        options(chosen),
        mesh(c, root_mesh),
        problem(mesh, field, constraints, rank_of(c) == 0),
        newton(c, problem, coarse_spaces(c, root_mesh, problem, space, options), options),
        frames(problem.start()) {}
};

IntegrableFrames::IntegrableFrames(MPI_Comm comm, const TetMesh& mesh, const FrameField& field,
                                   std::span<const AxisConstraint> constraints, const ConformingSpace& space,
                                   const IntegrableOptions& options)
    : implementation_(std::make_unique<Implementation>(comm, mesh, field, constraints, space, options)) {}

IntegrableFrames::~IntegrableFrames() = default;

IntegrableStageReport IntegrableFrames::run(const IntegrableStage& stage, double tolerance, const Control& control) {
  return implementation_->newton.run(stage, tolerance, control, implementation_->frames);
}

std::vector<Mat3> IntegrableFrames::gather() const {
  const auto& self = *implementation_;
  std::vector<double> local(9 * self.mesh.local().num_tets(), 0.0);
  std::copy(self.frames.begin(), self.frames.end(), local.begin());
  const std::vector<double> all = self.mesh.gather_tets(local, 9);
  std::vector<Mat3> result(all.size() / 9);
  for (std::size_t t = 0; t < result.size(); ++t) result[t] = Eigen::Map<const RowMajor3>(all.data() + 9 * t);
  return result;
}

long IntegrableFrames::work() const { return implementation_->newton.work(); }
void IntegrableFrames::set_work(long work) { implementation_->newton.set_work(work); }

void IntegrableFrames::set(const std::vector<Mat3>& on_root) {
  auto& self = *implementation_;
  std::vector<double> all;
  for (const Mat3& j : on_root) {
    const RowMajor3 r = j;
    all.insert(all.end(), r.data(), r.data() + 9);
  }
  const std::vector<double> local = self.mesh.scatter_tets(all, 9);
  std::copy(local.begin(), local.begin() + static_cast<std::ptrdiff_t>(self.frames.size()), self.frames.begin());
  self.problem.project(self.frames);
}

std::vector<IntegrableStageReport> optimise_integrable_frames(
    IntegrableFrames& frames, MPI_Comm comm, const IntegrableOptions& options, const Control& control,
    const std::function<bool(std::size_t, IntegrableFrames&, const IntegrableStageReport&)>& done) {
  std::size_t first = 0;
  if (control.restore_iterate) {
    if (const auto saved = control.restore_iterate(iterate_name)) {
      std::array<double, 2> numbers{};  // stage, work
      if (saved->size() > numbers.size()) std::copy_n(saved->begin(), numbers.size(), numbers.begin());
      MPI_Bcast(numbers.data(), 2, MPI_DOUBLE, 0, comm);
      first = static_cast<std::size_t>(numbers[0]);
      frames.set_work(static_cast<long>(numbers[1]));
      std::vector<Mat3> on_root;
      for (std::size_t i = numbers.size(); i + 8 < saved->size(); i += 9)
        on_root.emplace_back(Eigen::Map<const RowMajor3>(saved->data() + i));
      frames.set(on_root);
    }
  }
  std::vector<IntegrableStageReport> reports;
  for (std::size_t s = first; s < options.schedule.size(); ++s) {
    if (control.progress)
      control.progress("integrable frames", static_cast<double>(s) / static_cast<double>(options.schedule.size()));
    const bool last = s + 1 == options.schedule.size();
    reports.push_back(
        frames.run(options.schedule[s], last ? options.last_decrease_tolerance : options.decrease_tolerance, control));
    const bool stopped = reports.back().stopped;
    // Judged first: it may add to the work, and whoever goes on does not judge this stage again.
    bool end = !stopped && ((done && done(s, frames, reports.back())) || reports.back().exhausted);
    end = end || (options.max_work > 0 && frames.work() >= options.max_work);
    if (control.offer_iterate)
      control.offer_iterate(iterate_name, [&] {
        std::vector<double> values{static_cast<double>(stopped ? s : s + 1), static_cast<double>(frames.work())};
        for (const Mat3& j : frames.gather()) {
          const RowMajor3 r = j;
          values.insert(values.end(), r.data(), r.data() + 9);
        }
        if (rank_of(comm) != 0) values.clear();
        return values;
      });
    if (stopped) throw Error(ExitCode::stopped, "The optimisation of integrable frames was asked to stop.");
    if (end) break;
  }
  return reports;
}

}  // namespace hexfield
