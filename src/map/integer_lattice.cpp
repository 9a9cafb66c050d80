#include "integer_lattice.hpp"

#include <cstdlib>
#include <numeric>

#include "hexfield/base/error.hpp"

namespace hexfield {
namespace {

std::int64_t multiply_add(std::int64_t a, std::int64_t factor, std::int64_t b) {
  std::int64_t product = 0;
  std::int64_t sum = 0;
  const bool overflow = __builtin_mul_overflow(factor, b, &product) || __builtin_add_overflow(a, product, &sum);
  require(!overflow, "A coefficient of the conforming space left the 64-bit integers.");
  return sum;
}

std::int64_t floor_divide(std::int64_t a, std::int64_t b) {
  const std::int64_t q = a / b;
  return (a % b != 0 && ((a < 0) != (b < 0))) ? q - 1 : q;
}

}  // namespace

LinearForm add(const LinearForm& a, std::int64_t factor, const LinearForm& b) {
  LinearForm sum;
  sum.reserve(a.size() + b.size());
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() || j < b.size()) {
    if (j == b.size() || (i < a.size() && a[i].first < b[j].first)) {
      sum.push_back(a[i++]);
    } else if (i == a.size() || b[j].first < a[i].first) {
      const std::int64_t c = multiply_add(0, factor, b[j].second);
      if (c != 0) sum.emplace_back(b[j].first, c);
      ++j;
    } else {
      const std::int64_t c = multiply_add(a[i].second, factor, b[j].second);
      if (c != 0) sum.emplace_back(a[i].first, c);
      ++i, ++j;
    }
  }
  return sum;
}

LinearForm scaled(const LinearForm& a, std::int64_t factor) { return add({}, factor, a); }

std::int32_t IntegerLattice::new_variable(int keep, LinearForm definition) {
  const auto v = static_cast<std::int32_t>(expressions_.size());
  if (definition.empty()) definition = {{v, 1}};
  expressions_.push_back({{v, 1}});
  definitions_.push_back(std::move(definition));
  basis_.push_back(1);
  keep_.push_back(keep);
  users_.emplace_back();
  return v;
}

std::int32_t IntegerLattice::add_variable(int keep) { return new_variable(keep, {}); }

LinearForm IntegerLattice::reduce(const LinearForm& form) const {
  LinearForm reduced;
  for (const auto& [v, c] : form) reduced = add(reduced, c, expression(v));
  return reduced;
}

void IntegerLattice::substitute(std::int32_t v, const LinearForm& by) {
  const auto index = static_cast<std::size_t>(v);
  auto replace = [&](std::int32_t user) {
    LinearForm& form = expressions_[static_cast<std::size_t>(user)];
    for (const auto& [w, c] : form)
      if (w == v) {
        const std::int64_t factor = c;
        form = add(add(form, -factor, {{v, 1}}), factor, by);
        for (const auto& entry : by) users_[static_cast<std::size_t>(entry.first)].push_back(user);
        return;
      }
  };
  const std::vector<std::int32_t> users = std::move(users_[index]);
  users_[index].clear();
  basis_[index] = 0;
  replace(v);
  for (std::int32_t user : users) replace(user);
}

void IntegerLattice::add_relation(const LinearForm& relation) {
  LinearForm form = reduce(relation);
  while (!form.empty()) {
    std::int64_t divisor = 0;
    for (const auto& entry : form) divisor = std::gcd(divisor, entry.second);
    for (auto& entry : form) entry.second /= divisor;
    // Smallest coefficient first; among equals the variable that the caller cares for least.
    auto pivot = form[0];
    for (const auto& entry : form) {
      const auto size = std::abs(entry.second);
      const auto best = std::abs(pivot.second);
      const int keep = keep_[static_cast<std::size_t>(entry.first)];
      if (size < best || (size == best && keep < keep_[static_cast<std::size_t>(pivot.first)])) pivot = entry;
    }
    const auto [v, c] = pivot;
    LinearForm by;
    if (c == 1 || c == -1) {
      substitute(v, scaled(add(form, -c, {{v, 1}}), -c));
      return;
    }
    // v = q - sum floor(c_j / c) z_j leaves c q + sum (c_j mod c) z_j = 0 with smaller coefficients.
    LinearForm definition = definitions_[static_cast<std::size_t>(v)];
    for (const auto& [w, d] : form)
      if (w != v && floor_divide(d, c) != 0) {
        by.emplace_back(w, -floor_divide(d, c));
        definition = add(definition, floor_divide(d, c), definitions_[static_cast<std::size_t>(w)]);
      }
    const std::int32_t q = new_variable(keep_[static_cast<std::size_t>(v)], definition);
    by.emplace_back(q, 1);
    substitute(v, by);
    form = add(add(form, -c, {{v, 1}}), c, by);
  }
}

}  // namespace hexfield
