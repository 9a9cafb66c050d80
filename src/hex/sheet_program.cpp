#include "sheet_program.hpp"

#include <coin/Cbc_C_Interface.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>

#include "hex_topology.hpp"
#include "hexfield/hex/sheet.hpp"

namespace hexfield::hex {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

constexpr double infinity = std::numeric_limits<double>::max();
constexpr int most_edges = 14;  // of a vertex whose cycles are listed
constexpr int most_rounds = 30;

struct CbcDeleter {
  void operator()(Cbc_Model* model) const { Cbc_deleteModel(model); }
};

}  // namespace

SheetProgram::SheetProgram(const HexMesh& mesh, const HexComplex& complex, const QuadClasses& classes,
                           const std::vector<VertexSphere>& spheres, NodeMeasure& measure, int max_valence)
    : mesh_(mesh),
      complex_(complex),
      classes_(classes),
      spheres_(spheres),
      measure_(measure),
      max_valence_(max_valence) {
  // Of two sheets that do the same the smaller one; all of these costs together are less than one step of the measure.
  const double small = 0.5 / static_cast<double>(complex.quads.size() + 1);
  for (std::size_t c = 0; c < classes.usable.size(); ++c)
    add_column(small * static_cast<double>(classes.quads[static_cast<int>(c)].size()), classes.usable[c] != 0 ? 1 : 0);
  for (std::size_t c = 0; c < classes.usable.size(); ++c)
    for (int other : classes.conflicts[static_cast<int>(c)])
      if (at(other) > c && classes.usable[c] != 0 && classes.usable[at(other)] != 0)
        rows_.push_back({{{static_cast<int>(c), 1}, {other, 1}}, -infinity, 1});
  gather_vertices();
  add_free_edges();
}

int SheetProgram::add_column(double cost, double upper) {
  cost_.push_back(cost);
  upper_.push_back(upper);
  return static_cast<int>(cost_.size()) - 1;
}

bool SheetProgram::straight(const SphereTriangulation& sphere, const std::vector<int>& cycle) const {
  for (std::size_t k = 0; k < cycle.size(); ++k) {
    const auto& ring = sphere.rings[at(cycle[k])];
    if (ring.size() != 4) continue;
    const auto i = std::find(ring.begin(), ring.end(), cycle[(k + cycle.size() - 1) % cycle.size()]) - ring.begin();
    if (ring[(static_cast<std::size_t>(i) + 2) % 4] != cycle[(k + 1) % cycle.size()]) return false;
  }
  return true;
}

std::vector<SheetProgram::Pass> SheetProgram::passes_of(const VertexSphere& star) {
  const auto [known, added] = cycles_.try_emplace(star.sphere.rings);
  if (added) {
    const int before = measure_(star.sphere);
    for (auto& cycle : simple_cycles(star.sphere, max_valence_)) {
      if (!straight(star.sphere, cycle)) continue;
      const SphereSplit halves = split(star.sphere, cycle);
      if (std::max(halves.left.max_degree(), halves.right.max_degree()) > max_valence_) continue;
      const int change = measure_(halves.left) + measure_(halves.right) - before;
      known->second.emplace_back(std::move(cycle), change);
    }
  }
  std::map<int, int> quads;  // class -> number of its quads at v
  for (int e : star.edges)
    for (int q : complex_.edge_quads[e]) ++quads[classes_.class_of[at(q)]];
  std::vector<Pass> out;
  for (const auto& [cycle, change] : known->second) {
    std::map<int, int> here;
    bool good = true;
    for (std::size_t k = 0; k < cycle.size(); ++k) {
      const int q = complex_.quad_between(star.edges[at(cycle[k])], star.edges[at(cycle[(k + 1) % cycle.size()])]);
      const int c = classes_.class_of[at(q)];
      good = good && c >= 0 && classes_.usable[at(c)] != 0;
      here[c] += 2;  // each quad is counted at two edges above
    }
    Pass pass{{}, change};
    for (const auto& [c, n] : here) {
      good = good && n == quads.at(c);  // all of a class or nothing
      pass.classes.push_back(c);
    }
    if (good) out.push_back(std::move(pass));
  }
  std::sort(out.begin(), out.end());
  return out;
}

// Vertices along a curve can be passed in the same ways: one set of variables for all of them.
void SheetProgram::gather_vertices() {
  std::map<std::vector<Pass>, int> groups;
  for (std::size_t v = 0; v < spheres_.size(); ++v) {
    const VertexSphere& star = spheres_[v];
    if (star.edges.empty()) continue;
    if (star.sphere.size() > most_edges) {
      complete_ = false;
      continue;
    }
    const std::vector<Pass> passes = passes_of(star);
    std::set<int> passed;
    for (const Pass& pass : passes) passed.insert(pass.classes.begin(), pass.classes.end());
    for (int e : star.edges)
      for (int q : complex_.edge_quads[e])
        if (const int c = classes_.class_of[at(q)]; c >= 0 && !passed.contains(c)) upper_[at(c)] = 0;
    ++groups[passes];
  }
  for (const auto& [passes, vertices] : groups) add_passes(passes, vertices);
}

void SheetProgram::add_passes(const std::vector<Pass>& passes, int vertices) {
  Row one{{}, -infinity, 1};
  std::map<int, Row> rows;  // per class: it is chosen exactly when one of its passes is
  for (const Pass& pass : passes) {
    const int z = add_column(static_cast<double>(pass.change) * vertices, 1);
    one.terms.emplace_back(z, 1);
    for (int c : pass.classes) {
      Row& row = rows[c];
      if (row.terms.empty()) row = {{{c, -1}}, 0, 0};
      row.terms.emplace_back(z, 1);
    }
  }
  if (!one.terms.empty()) rows_.push_back(std::move(one));
  for (auto& [c, row] : rows) rows_.push_back(std::move(row));
}

// Singular edges without a vertex whose passes are listed: none of their quads or two.
void SheetProgram::add_free_edges() {
  for (std::size_t e = 0; e < complex_.edges.size(); ++e) {
    const int id = static_cast<int>(e);
    if (!complex_.is_singular(id)) continue;
    bool listed = false;
    for (int v : complex_.edges[e])
      listed = listed || (!spheres_[at(v)].edges.empty() && spheres_[at(v)].sphere.size() <= most_edges);
    if (listed) continue;
    std::map<int, double> count;
    for (int q : complex_.edge_quads[id])
      if (const int c = classes_.class_of[at(q)]; c >= 0) count[c] += 1;
    Row row{{count.begin(), count.end()}, 0, 0};
    row.terms.emplace_back(add_column(0, 1), -2);
    rows_.push_back(std::move(row));
  }
}

SheetProgram::Solution SheetProgram::optimise(int most_branches) const {
  std::vector<std::vector<std::pair<int, double>>> columns(cost_.size());
  std::vector<double> low, high;
  for (const Row& row : rows_) {
    for (const auto& [c, a] : row.terms) columns[at(c)].emplace_back(static_cast<int>(low.size()), a);
    low.push_back(row.low);
    high.push_back(row.high);
  }
  std::vector<CoinBigIndex> start{0};
  std::vector<int> index;
  std::vector<double> value;
  for (const auto& column : columns) {
    for (const auto& [row, a] : column) {
      index.push_back(row);
      value.push_back(a);
    }
    start.push_back(static_cast<CoinBigIndex>(index.size()));
  }
  const std::vector<double> lower(cost_.size(), 0);
  const std::unique_ptr<Cbc_Model, CbcDeleter> model(Cbc_newModel());
  Cbc_setLogLevel(model.get(), 0);
  Cbc_setParameter(model.get(), "log", "0");
  Cbc_loadProblem(model.get(), static_cast<int>(cost_.size()), static_cast<int>(low.size()), start.data(), index.data(),
                  value.data(), lower.data(), upper_.data(), cost_.data(), low.data(), high.data());
  for (std::size_t c = 0; c < cost_.size(); ++c) Cbc_setInteger(model.get(), static_cast<int>(c));
  Cbc_setMaximumNodes(model.get(), most_branches);
  // The measure is whole: once nothing can be better by one, the sizes of the sheets need no proof.
  Cbc_setAllowableGap(model.get(), 0.49);
  Cbc_solve(model.get());
  Solution out;
  const double* solution = Cbc_bestSolution(model.get());
  out.optimal = Cbc_isProvenOptimal(model.get()) != 0;
  if (solution == nullptr) return out;
  for (std::size_t c = 0; c < classes_.usable.size(); ++c)
    if (solution[c] > 0.5) out.classes.push_back(static_cast<int>(c));
  return out;
}

// Classes that hang together over singular edges, as lists of classes.
std::vector<std::vector<int>> SheetProgram::components(const std::vector<int>& chosen) const {
  DisjointSets sets(chosen.size());
  std::map<int, std::size_t> first;  // edge -> a class there
  for (std::size_t k = 0; k < chosen.size(); ++k)
    for (int e : classes_.rims[chosen[k]]) {
      const auto [place, added] = first.try_emplace(e, k);
      if (!added) sets.join(place->second, k);
    }
  std::map<std::size_t, std::vector<int>> parts;
  for (std::size_t k = 0; k < chosen.size(); ++k) parts[sets.find(k)].push_back(chosen[k]);
  std::vector<std::vector<int>> out;
  for (auto& [root, part] : parts) out.push_back(std::move(part));
  return out;
}

SheetProgram::Result SheetProgram::solve(int most_branches) {
  SheetSearch search(mesh_, complex_, classes_, spheres_, measure_, {max_valence_, 0, 0});
  Result out;
  for (int round = 0; round < most_rounds; ++round) {
    const Solution solution = optimise(most_branches);
    bool refused = false;
    for (const std::vector<int>& part : components(solution.classes)) {
      SheetCandidate sheet;
      for (int c : part) sheet.quads.insert(sheet.quads.end(), classes_.quads[c].begin(), classes_.quads[c].end());
      std::sort(sheet.quads.begin(), sheet.quads.end());
      bool good = search.evaluate(sheet.quads, sheet.change);
      try {
        if (good) inflate_sheet(mesh_, complex_, sheet.quads);
      } catch (const Error& error) {
        if (error.code() != ExitCode::bad_input)
          throw;  // one-sided, twice at a boundary vertex, or features in its way
        good = false;
      }
      if (good && sheet.change < 0) out.sheets.push_back(std::move(sheet));
      if (good) continue;
      refused = true;
      Row not_again{{}, -infinity, static_cast<double>(part.size()) - 1};
      for (int c : part) not_again.terms.emplace_back(c, 1);
      rows_.push_back(std::move(not_again));
    }
    if (!out.sheets.empty() || !refused) {
      out.complete = complete_ && solution.optimal && !refused;
      break;
    }
  }
  std::sort(out.sheets.begin(), out.sheets.end());
  return out;
}

}  // namespace hexfield::hex
