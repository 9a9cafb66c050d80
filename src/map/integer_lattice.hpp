#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace hexfield {

/// Sparse integer combination of variables, sorted by variable, without zeros.
using LinearForm = std::vector<std::pair<std::int32_t, std::int64_t>>;

/// a + factor * b.
LinearForm add(const LinearForm& a, std::int64_t factor, const LinearForm& b);
LinearForm scaled(const LinearForm& a, std::int64_t factor);

/// All integer solutions of homogeneous linear relations with integer coefficients, by exact elimination
/// with unimodular steps: every variable is an integer combination of basis variables, and every integer
/// (real) value of the basis gives an integer (real) solution, and all of them (spec-quantization 2.4;
/// divisions are avoided by changes of variables as in the Hermite normal form).
class IntegerLattice {
 public:
  /// A new unrestricted variable. Those with lower `keep` are eliminated first.
  std::int32_t add_variable(int keep);
  /// Adds the relation form = 0. Redundant ones change nothing.
  void add_relation(const LinearForm& form);

  std::size_t num_variables() const { return expressions_.size(); }
  bool in_basis(std::int32_t v) const { return basis_[static_cast<std::size_t>(v)] != 0; }
  /// The variable in terms of basis variables.
  const LinearForm& expression(std::int32_t v) const { return expressions_[static_cast<std::size_t>(v)]; }
  /// What a variable is in terms of the variables added by the caller (itself, unless elimination made it).
  const LinearForm& definition(std::int32_t v) const { return definitions_[static_cast<std::size_t>(v)]; }
  /// A form over any variables in terms of basis variables.
  LinearForm reduce(const LinearForm& form) const;

 private:
  void substitute(std::int32_t v, const LinearForm& by);
  std::int32_t new_variable(int keep, LinearForm definition);

  std::vector<LinearForm> expressions_;
  std::vector<LinearForm> definitions_;
  std::vector<char> basis_;
  std::vector<int> keep_;
  std::vector<std::vector<std::int32_t>> users_;  // eliminated variables whose expression held this one
};

}  // namespace hexfield
