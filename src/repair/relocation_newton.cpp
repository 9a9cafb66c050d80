#include <Eigen/SparseCholesky>
#include <cmath>

#include "hexfield/repair/relocation_energy.hpp"

namespace hexfield {
namespace {

constexpr double shift = 1e-8;  // of the mean diagonal: elements leave directions without curvature
constexpr double armijo = 1e-4;
constexpr int few_halvings = 3;  // for the step that was shortened point by point, before the whole one is tried
constexpr int max_halvings = 40;

// Goes along a direction of descent; false when no length lowers the energy enough.
bool search(const RelocationEnergy& energy, const Eigen::VectorXd& gradient, const Eigen::VectorXd& step, int halvings,
            Eigen::VectorXd& y, double& value) {
  const double slope = gradient.dot(step);
  if (!(slope < 0)) return false;
  double length = 1;
  for (int k = 0; k <= halvings; ++k, length /= 2) {
    const Eigen::VectorXd there = y + length * step;
    const double after = energy.value(there);
    if (!(after <= value + armijo * length * slope)) continue;
    y = there;
    value = after;
    return true;
  }
  return false;
}

}  // namespace

NewtonDescent descend(const RelocationEnergy& energy, Eigen::VectorXd& y, int max_iterations, double tolerance,
                      const std::function<void()>& before_step) {
  NewtonDescent report;
  report.start = report.end = energy.value(y);
  if (energy.num_unknowns() == 0 || !std::isfinite(report.start)) return report;
  Eigen::VectorXd gradient;
  Eigen::SparseMatrix<double> hessian;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
  while (report.iterations < max_iterations) {
    if (before_step) before_step();
    const double before = energy.derivatives(y, gradient, hessian);
    solver.setShift(shift * hessian.diagonal().mean());
    if (report.iterations == 0) solver.analyzePattern(hessian);
    solver.factorize(hessian);
    if (solver.info() != Eigen::Success) break;
    const Eigen::VectorXd step = -solver.solve(gradient);
    Eigen::VectorXd shortened = step;
    energy.shorten(y, shortened);
    report.end = before;
    const Eigen::VectorXd start = y;
    const auto gained = [&] { return before - report.end >= tolerance * std::abs(before); };
    search(energy, gradient, shortened, few_halvings, y, report.end);
    if (!gained()) {
      Eigen::VectorXd other = start;
      double value = before;
      if (search(energy, gradient, step, max_halvings, other, value) && value < report.end)
        y = other, report.end = value;
    }
    if (report.end == before) break;
    ++report.iterations;
    if (!gained()) break;
  }
  return report;
}

}  // namespace hexfield
