#include "binary_program.hpp"

#include <coin/CbcEventHandler.hpp>
#include <coin/CbcHeuristic.hpp>
#include <coin/CbcHeuristicDiveCoefficient.hpp>
#include <coin/CbcHeuristicFPump.hpp>
#include <coin/CbcModel.hpp>
#include <coin/CglClique.hpp>
#include <coin/CglProbing.hpp>
#include <coin/CglZeroHalf.hpp>
#include <coin/ClpEventHandler.hpp>
#include <coin/ClpSimplex.hpp>
#include <coin/OsiClpSolverInterface.hpp>

#include <cstdint>
#include <limits>

#include "hexfield/base/error.hpp"

namespace hexfield::hex {
namespace {

constexpr std::int64_t steps_between_looks = 200;

/// Counts the steps of all linear programs of one solution, and ends them.
struct Watch {
  const Control& control;
  std::int64_t most_steps;
  std::int64_t steps = 0;
  bool stopped = false;

  bool over() const { return stopped || steps > most_steps; }
  void step() {
    if (++steps % steps_between_looks == 0) look();
  }
  void look() { stopped = stopped || (control.stop_requested && control.stop_requested()); }
};

class StepCounter : public ClpEventHandler {
 public:
  explicit StepCounter(Watch& watch) : watch_(&watch) {}
  ClpEventHandler* clone() const override { return new StepCounter(*this); }  // owned by the library
  int event(Event which) override {
    if (which == endOfIteration) watch_->step();
    return watch_->over() ? 0 : -1;
  }

 private:
  Watch* watch_;
};

class TreeWatch : public CbcEventHandler {
 public:
  explicit TreeWatch(Watch& watch) : watch_(&watch) {}
  CbcEventHandler* clone() const override { return new TreeWatch(*this); }  // owned by the library
  CbcAction event(CbcEvent) override {
    watch_->look();
    return watch_->over() ? stop : noAction;
  }

 private:
  Watch* watch_;
};

void load(const BinaryProgram& program, OsiClpSolverInterface& solver) {
  std::vector<int> rows, columns;
  std::vector<double> values, low, high;
  for (const BinaryProgram::Row& row : program.rows) {
    for (const auto& [column, value] : row.terms) {
      rows.push_back(static_cast<int>(low.size()));
      columns.push_back(column);
      values.push_back(value);
    }
    low.push_back(row.low);
    high.push_back(row.high);
  }
  CoinPackedMatrix matrix(true, rows.data(), columns.data(), values.data(), static_cast<int>(values.size()));
  matrix.setDimensions(static_cast<int>(low.size()), static_cast<int>(program.cost.size()));
  const std::vector<double> zero(program.cost.size(), 0);
  solver.loadProblem(matrix, zero.data(), program.upper.data(), program.cost.data(), low.data(), high.data());
  for (std::size_t c = 0; c < program.cost.size(); ++c) solver.setInteger(static_cast<int>(c));
}

void add_cuts(CbcModel& model) {
  CglProbing probing;
  probing.setUsingObjective(1);
  probing.setMaxPass(1);
  probing.setMaxPassRoot(1);
  probing.setMaxProbe(10);
  probing.setMaxProbeRoot(50);
  probing.setMaxLook(10);
  probing.setMaxLookRoot(10);
  probing.setRowCuts(3);
  CglClique clique;
  clique.setStarCliqueReport(false);
  clique.setRowCliqueReport(false);
  CglZeroHalf half;
  model.addCutGenerator(&probing, -98, "probing");
  model.addCutGenerator(&clique, -98, "clique");
  model.addCutGenerator(&half, -98, "zero half");
}

void add_heuristics(CbcModel& model) {
  CbcRounding rounding(model);
  CbcHeuristicDiveCoefficient dive(model);
  dive.setWhen(3);
  CbcHeuristicFPump pump(model);
  pump.setMaximumPasses(20);
  model.addHeuristic(&rounding, "rounding");
  model.addHeuristic(&pump, "pump");
  model.addHeuristic(&dive, "dive");
}

}  // namespace

BinarySolution minimise(const BinaryProgram& program, double cutoff, double gap, const BinaryLimits& limits,
                        const Control& control) {
  const double size = static_cast<double>(program.rows.size() + 1);
  Watch watch{control, static_cast<std::int64_t>(limits.work / size)};
  const StepCounter counter(watch);
  OsiClpSolverInterface solver;
  solver.messageHandler()->setLogLevel(0);
  solver.getModelPtr()->setLogLevel(0);
  load(program, solver);
  solver.getModelPtr()->passInEventHandler(&counter);
  solver.initialSolve();
  BinarySolution out;
  if (!watch.over() && (solver.isProvenPrimalInfeasible() || solver.getObjValue() >= cutoff)) {
    out.proven = true;
    return out;
  }
  CbcModel model(solver);
  model.setLogLevel(0);
  model.messageHandler()->setLogLevel(0);
  const TreeWatch tree(watch);
  model.passInEventHandler(&tree);
  model.setCutoff(cutoff);
  model.setAllowableGap(gap);
  model.setMaximumNodes(limits.branches);
  model.setNumberStrong(5);
  model.setNumberBeforeTrust(5);
  model.setMaximumCutPassesAtRoot(10);
  add_cuts(model);
  add_heuristics(model);
  if (!watch.over()) model.branchAndBound();
  if (watch.stopped) throw Error(ExitCode::stopped, "Stopped inside an integer program.");
  if (watch.over())
    out.limit = "work of the integer program";
  else if (model.status() != 0)
    out.limit = "branches of the integer program";
  out.proven = out.limit.empty();
  if (const double* values = model.bestSolution(); values != nullptr)
    for (std::size_t c = 0; c < program.cost.size(); ++c) out.values.push_back(values[c] > 0.5 ? 1 : 0);
  return out;
}

}  // namespace hexfield::hex
