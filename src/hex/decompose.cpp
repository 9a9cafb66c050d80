#include "hexfield/hex/decompose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "hexfield/hex/sheet.hpp"
#include "sheet_state.hpp"

namespace hexfield {
namespace {

constexpr int most_side_steps = 2;
constexpr int most_refused = 12;

/// A sheet of one of the states that are followed.
struct Move {
  std::size_t state;
  int measure;
  hex::SheetCandidate sheet;
};

class Decomposer {
 public:
  /// `seen`: meshes that are not to be reached, by their hashes. `steps`: classes tried so far.
  Decomposer(const HexMesh& mesh, const DecomposeOptions& options, std::set<std::uint64_t> seen, std::int64_t steps,
             const Control& control)
      : mesh_(mesh),
        options_(options),
        control_(control),
        measure_(options.final_valence),
        seen_(std::move(seen)),
        steps_(steps) {
    width_ = options.width > 0 ? static_cast<std::size_t>(options.width)
                               : std::clamp<std::size_t>(8000 / std::max<std::size_t>(mesh.hexes.size(), 1), 1, 24);
    if (options.search == DecomposeOptions::Search::greedy) width_ = 1;
  }

  Decomposition run() {
    std::vector<hex::SheetState> beam;
    beam.emplace_back(mesh_, std::vector<DecomposeStep>{}, measure_);
    if (beam[0].has_many_nodes()) width_ = 1;  // each state takes an integer program
    Decomposition out;
    out.measure_before = beam[0].measure();
    best_steps_ = {};
    best_measure_ = beam[0].measure();
    seen_.insert(beam[0].hash());
    int side_steps = 0;
    bool best_in_beam = true;
    while (!beam.empty() && best_measure_ > 0 && steps_ < options_.budget &&
           !(one_by_one() && best_measure_ < out.measure_before)) {
      tell(beam);
      if (best_in_beam) limits_.clear();
      std::vector<hex::SheetState> next = advance(beam, -1, best_in_beam);
      if (next.empty() && side_steps < most_side_steps && options_.search == DecomposeOptions::Search::exact) {
        next = advance(beam, 0, false);
        ++side_steps;
      } else {
        side_steps = 0;
      }
      best_in_beam = take_best(next);
      beam = std::move(next);
    }
    out.steps = best_steps_;
    out.measure = best_measure_;
    if (steps_ >= options_.budget) limits_.insert("patches tried");
    out.proven = best_measure_ > 0 && limits_.empty();
    out.limits = limits_;
    return out;
  }
  std::int64_t steps() const { return steps_; }
  /// run() ends with the first sheet that lowers the measure: along one sequence nothing is gained by looking ahead.
  bool one_by_one() const { return width_ == 1 && options_.search == DecomposeOptions::Search::exact; }

 private:
  /// The states that the best sheets lead to; only sheets that change the measure by at most `most`. Notes limits that
  /// were met if they are to count.
  std::vector<hex::SheetState> advance(const std::vector<hex::SheetState>& beam, int most, bool count_limits) {
    std::vector<Move> moves;
    for (std::size_t k = 0; k < beam.size(); ++k) {
      const int targets = width_ > 1 ? 2 : 4;
      auto found = beam[k].sheets(options_, most, targets, 6 * width_, measure_, control_);
      if (count_limits && !found.complete) limits_.insert(found.limits.begin(), found.limits.end());
      steps_ += found.steps;
      for (auto& sheet : found.sheets) moves.push_back({k, beam[k].measure() + sheet.change, std::move(sheet)});
      if (steps_ >= options_.budget) break;
    }
    std::stable_sort(moves.begin(), moves.end(), [](const Move& a, const Move& b) {
      return a.measure != b.measure ? a.measure < b.measure : a.sheet.quads.size() < b.sheet.quads.size();
    });
    std::vector<hex::SheetState> next;
    for (const Move& move : moves) {
      if (next.size() >= width_) break;
      const hex::SheetState& from = beam[move.state];
      Inflation inflated = inflate_sheet(from.mesh(), from.complex(), move.sheet.quads);
      auto steps = from.steps();
      steps.push_back({move.sheet.quads, move.measure});
      hex::SheetState state(std::move(inflated.mesh), std::move(steps), measure_);
      if (seen_.insert(state.hash()).second) next.push_back(std::move(state));
    }
    return next;
  }

  /// Of the states with the least measure so far the one with the fewest curves. True when one of these is better.
  bool take_best(const std::vector<hex::SheetState>& states) {
    std::size_t fewest = 0;
    int least = best_measure_;
    for (const auto& state : states) {
      if (state.measure() > least || state.measure() == best_measure_) continue;
      const std::size_t curves = hex_singular_graph(state.mesh(), state.complex()).curves.size();
      if (state.measure() == least && curves >= fewest) continue;
      least = state.measure();
      fewest = curves;
      best_steps_ = state.steps();
    }
    const bool better = least < best_measure_;
    best_measure_ = least;
    return better;
  }

  void tell(const std::vector<hex::SheetState>& beam) const {
    if (control_.stop_requested && control_.stop_requested())
      throw Error(ExitCode::stopped, "Stopped while singular nodes were being decomposed.");
    if (control_.progress)
      control_.progress(fmt::format("sheet {}, measure {}", beam[0].steps().size() + 1, best_measure_), -1);
  }

  const HexMesh& mesh_;
  const DecomposeOptions& options_;
  const Control& control_;
  hex::NodeMeasure measure_;
  std::size_t width_ = 1;
  std::set<std::uint64_t> seen_;
  std::vector<DecomposeStep> best_steps_;
  int best_measure_ = 0;
  std::int64_t steps_;
  std::set<std::string> limits_;  ///< met when sheets that lower the best measure were searched for
};

/// Searches and settles, until no sheet is found or one is refused for good. What is settled is in `out` at any time.
void decompose_into(Decomposition& out, const DecomposeOptions& options, const std::function<bool(HexMesh&)>& settle,
                    const Control& control) {
  std::set<std::uint64_t> refused;  // what settle could not place
  std::int64_t tried = 0;
  hex::NodeMeasure measure(options.final_valence);
  for (bool again = true, first = true; again; first = false) {
    Decomposer search(out.mesh, options, refused, tried, control);
    const Decomposition found = search.run();
    tried = search.steps();
    if (first) out.measure_before = found.measure_before;
    out.measure = found.measure_before;
    out.proven = found.proven && refused.empty();
    out.limits = found.limits;
    again = search.one_by_one() && !found.steps.empty() && found.measure > 0;
    for (const DecomposeStep& step : found.steps) {
      HexMesh next = inflate_sheet(out.mesh, build_hex_complex(out.mesh), step.quads).mesh;
      if (settle && !settle(next)) {
        refused.insert(hex::SheetState(std::move(next), {}, measure).hash());
        again = static_cast<int>(refused.size()) < most_refused;
        out.sheets_refused = static_cast<int>(refused.size());
        out.proven = false;
        break;
      }
      out.mesh = std::move(next);
      out.steps.push_back(step);
      out.measure = step.measure;
    }
  }
}

}  // namespace

Decomposition decompose(const HexMesh& mesh, const DecomposeOptions& options,
                        const std::function<bool(HexMesh&)>& settle, const Control& control) {
  Decomposition out;
  out.mesh = mesh;
  try {
    decompose_into(out, options, settle, control);
  } catch (const Error& error) {
    if (error.code() != ExitCode::stopped) throw;
    out.stopped = true;
    out.proven = false;
  }
  out.nodes_left = hex_singular_graph(out.mesh, build_hex_complex(out.mesh)).nodes;
  return out;
}

}  // namespace hexfield
