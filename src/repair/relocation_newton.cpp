#include <Eigen/SparseCholesky>
#include <cmath>

#include "hexfield/repair/relocation_energy.hpp"

namespace hexfield {
namespace {

constexpr double shift = 1e-8;  // of the mean diagonal: elements leave directions without curvature
constexpr double armijo = 1e-4;
constexpr int max_halvings = 40;

}  // namespace

NewtonDescent descend(const RelocationEnergy& energy, Eigen::VectorXd& y, int max_iterations, double tolerance) {
  NewtonDescent report;
  report.start = report.end = energy.value(y);
  if (energy.num_unknowns() == 0 || !std::isfinite(report.start)) return report;
  Eigen::VectorXd gradient;
  Eigen::SparseMatrix<double> hessian;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
  for (report.iterations = 0; report.iterations < max_iterations; ++report.iterations) {
    const double before = energy.derivatives(y, gradient, hessian);
    solver.setShift(shift * hessian.diagonal().mean());
    if (report.iterations == 0) solver.analyzePattern(hessian);
    solver.factorize(hessian);
    if (solver.info() != Eigen::Success) break;
    const Eigen::VectorXd step = -solver.solve(gradient);
    const double slope = gradient.dot(step);
    if (!(slope < 0)) break;
    double length = 1;
    double after = energy.value(y + step);
    for (int k = 0; k < max_halvings && !(after <= before + armijo * length * slope); ++k) {
      length /= 2;
      after = energy.value(y + length * step);
    }
    if (!(after < before)) break;
    y += length * step;
    report.end = after;
    if (before - after < tolerance * std::abs(before)) {
      ++report.iterations;
      break;
    }
  }
  return report;
}

}  // namespace hexfield
