#include "sheet_program.hpp"

#include <algorithm>
#include <limits>

#include "boundary_passes.hpp"
#include "hex_topology.hpp"
#include "hexfield/hex/sheet.hpp"

namespace hexfield::hex {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

constexpr double infinity = std::numeric_limits<double>::max();
constexpr int most_edges = 14;  // of a vertex whose cycles are listed
constexpr int most_rounds = 60;
// The measure is whole, and the sizes of the sheets cost less than half a step of it: once nothing can be better by
// one, they need no proof.
constexpr double better = -0.5;
constexpr double whole_gap = 0.49;

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
  for (std::size_t c = 0; c < classes.usable.size(); ++c) {
    const int id = static_cast<int>(c);
    // What meets no singular edge is a sheet of its own that changes nothing.
    const bool useful = classes.usable[c] != 0 && !classes.rims[id].empty();
    program_.add(small * static_cast<double>(classes.quads[id].size()), useful ? 1 : 0);
  }
  add_conflicts();
  gather_vertices();
  add_free_edges();
}

// Three classes cross at each regular vertex, at most one of them is chosen; pairs elsewhere.
void SheetProgram::add_conflicts() {
  const auto live = [&](int c) { return c >= 0 && program_.upper[at(c)] > 0; };
  std::set<std::vector<int>> cliques;
  std::vector<char> special(spheres_.size(), 0);
  for (std::size_t c = 0; c < classes_.usable.size(); ++c)
    for (int v : classes_.special[static_cast<int>(c)]) special[at(v)] = 1;
  for (std::size_t v = 0; v < spheres_.size(); ++v) {
    const int id = static_cast<int>(v);
    if (special[v] != 0 || complex_.is_boundary_vertex(id)) continue;
    std::set<int> here;
    for (int e : complex_.vertex_edges[id])
      for (int q : complex_.edge_quads[e])
        if (live(classes_.class_of[at(q)])) here.insert(classes_.class_of[at(q)]);
    if (here.size() > 1) cliques.insert({here.begin(), here.end()});
  }
  std::set<std::pair<int, int>> covered;
  for (const auto& clique : cliques)
    for (int a : clique)
      for (int b : clique) covered.emplace(a, b);
  for (std::size_t c = 0; c < classes_.usable.size(); ++c)
    for (int other : classes_.conflicts[static_cast<int>(c)]) {
      const int id = static_cast<int>(c);
      if (other > id && live(id) && live(other) && !covered.contains({id, other})) cliques.insert({id, other});
    }
  for (const auto& clique : cliques) {
    Row row{{}, -infinity, 1};
    for (int c : clique) row.terms.emplace_back(c, 1);
    program_.rows.push_back(std::move(row));
  }
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
      limit_ = "edges at a vertex";
      continue;
    }
    const std::vector<Pass> passes = passes_of(star);
    fix_unpassed(static_cast<int>(v), passes);
    ++groups[passes];
  }
  gather_boundary(groups);
  for (const auto& [passes, vertices] : groups) add_passes(passes, vertices);
}

// The arcs at boundary vertices where more than one curve of quads can pass.
void SheetProgram::gather_boundary(std::map<std::vector<Pass>, int>& groups) {
  std::set<int> vertices;
  for (std::size_t c = 0; c < classes_.usable.size(); ++c)
    for (int v : classes_.special[static_cast<int>(c)])
      if (complex_.is_boundary_vertex(v)) vertices.insert(v);
  for (int v : vertices) {
    const auto arcs = boundary_passes(complex_, classes_, v);
    if (!arcs) continue;  // too many; sheet_sides() judges solutions there
    std::vector<Pass> passes;
    for (const std::vector<int>& arc : *arcs) passes.push_back({arc, 0});
    fix_unpassed(v, passes);
    ++groups[passes];
  }
}

void SheetProgram::fix_unpassed(int vertex, const std::vector<Pass>& passes) {
  std::set<int> passed;
  for (const Pass& pass : passes) passed.insert(pass.classes.begin(), pass.classes.end());
  for (int e : complex_.vertex_edges[vertex])
    for (int q : complex_.edge_quads[e])
      if (const int c = classes_.class_of[at(q)]; c >= 0 && !passed.contains(c)) program_.upper[at(c)] = 0;
}

void SheetProgram::add_passes(const std::vector<Pass>& passes, int vertices) {
  Row one{{}, -infinity, 1};
  std::map<int, Row> rows;  // per class: it is chosen exactly when one of its passes is
  for (const Pass& pass : passes) {
    const int z = program_.add(static_cast<double>(pass.change) * vertices, 1);
    one.terms.emplace_back(z, 1);
    for (int c : pass.classes) {
      Row& row = rows[c];
      if (row.terms.empty()) row = {{{c, -1}}, 0, 0};
      row.terms.emplace_back(z, 1);
    }
  }
  if (!one.terms.empty()) program_.rows.push_back(std::move(one));
  for (auto& [c, row] : rows) program_.rows.push_back(std::move(row));
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
    row.terms.emplace_back(program_.add(0, 1), -2);
    program_.rows.push_back(std::move(row));
  }
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

SheetCandidate SheetProgram::sheet_of(const std::vector<int>& part) const {
  SheetCandidate sheet;
  for (int c : part) sheet.quads.insert(sheet.quads.end(), classes_.quads[c].begin(), classes_.quads[c].end());
  std::sort(sheet.quads.begin(), sheet.quads.end());
  return sheet;
}

// More classes at a vertex that a sheet passes twice, or where it tears features apart, mend nothing.
void SheetProgram::forbid(const std::vector<int>& part, const Error& error) {
  std::set<int> here;
  if (!error.ids().empty())
    for (int e : complex_.vertex_edges[static_cast<int>(error.ids()[0])])
      for (int q : complex_.edge_quads[e]) here.insert(classes_.class_of[at(q)]);
  Row row{{}, -infinity, -1};
  for (int c : part)
    if (here.empty() || here.contains(c)) row.terms.emplace_back(c, 1);
  row.high += static_cast<double>(row.terms.size());
  program_.rows.push_back(std::move(row));
}

SheetProgram::Result SheetProgram::solve(const BinaryLimits& limits, const Control& control) {
  SheetSearch search(mesh_, complex_, classes_, spheres_, measure_, {max_valence_, 0, 0}, control);
  Result out;
  out.limit = limit_;
  for (int round = 0; round < most_rounds; ++round) {
    const BinarySolution solution = minimise(program_, better, whole_gap, limits, control);
    if (!solution.limit.empty()) out.limit = solution.limit;
    std::vector<int> chosen;
    for (std::size_t c = 0; c < classes_.usable.size() && !solution.values.empty(); ++c)
      if (solution.values[c] != 0) chosen.push_back(static_cast<int>(c));
    bool refused = false;
    for (const std::vector<int>& part : components(chosen)) {
      SheetCandidate sheet = sheet_of(part);
      try {
        inflate_sheet(mesh_, complex_, sheet.quads);
        if (!search.evaluate(sheet.quads, sheet.change))
          throw Error(ExitCode::bad_input, "The sheet would leave valences that are not allowed.");
        if (sheet.change < 0) out.sheets.push_back(std::move(sheet));
      } catch (const Error& error) {
        if (error.code() != ExitCode::bad_input) throw;  // one-sided, or features in its way
        refused = true;
        forbid(part, error);
      }
    }
    if (!out.sheets.empty() || !refused) {
      out.complete = out.sheets.empty() && chosen.empty() && solution.proven && limit_.empty();
      break;
    }
    if (round + 1 == most_rounds) out.limit = "rounds of the integer program";
  }
  std::sort(out.sheets.begin(), out.sheets.end());
  return out;
}

}  // namespace hexfield::hex
