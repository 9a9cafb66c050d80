#include "sheet_state.hpp"

#include <algorithm>

#include "hexfield/hex/sheet.hpp"
#include "sheet_program.hpp"

namespace hexfield::hex {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

constexpr int most_edges = 14;  // of a vertex all of whose cycles are tried
constexpr int longest_cycle = 8;
constexpr std::size_t most_seeds = 400;   // per vertex
constexpr std::size_t most_sheets = 400;  // per seed
constexpr int most_bent_seeds = 24;       // per vertex, tried only where no straight sheet is found

std::uint64_t mix(std::uint64_t x) {
  x ^= x >> 33U;
  x *= 0xff51afd7ed558ccdULL;
  x ^= x >> 33U;
  x *= 0xc4ceb9fe1a85ec53ULL;
  return x ^ (x >> 33U);
}

// All sheets through the quads, or the one that the paper's propagation makes of them. False when there may be more.
bool follow(SheetSearch& search, const std::vector<int>& quads, bool exact, std::vector<SheetCandidate>& out) {
  if (exact) return search.find(quads, out);
  SheetCandidate sheet{search.propagate_greedily(quads), 0};
  if (!sheet.quads.empty() && search.evaluate(sheet.quads, sheet.change)) out.push_back(std::move(sheet));
  return false;
}

}  // namespace

SheetState::SheetState(HexMesh mesh, std::vector<DecomposeStep> steps, NodeMeasure& measure)
    : mesh_(std::move(mesh)), steps_(std::move(steps)), complex_(build_hex_complex(mesh_)) {
  spheres_.resize(mesh_.points.size());
  measures_.assign(mesh_.points.size(), 0);
  for (std::size_t e = 0; e < complex_.edges.size(); ++e) {
    const int id = static_cast<int>(e);
    if (!complex_.is_singular(id)) continue;
    max_valence_ = std::max(max_valence_, complex_.valence(id));
    for (int v : complex_.edges[e]) {
      if (complex_.is_boundary_vertex(v) || !spheres_[at(v)].edges.empty()) continue;
      spheres_[at(v)] = vertex_sphere(mesh_, complex_, v);
      measures_[at(v)] = measure(spheres_[at(v)].sphere);
      total_ += measures_[at(v)];
    }
  }
}

std::uint64_t SheetState::hash() const {
  const std::size_t n = mesh_.points.size();
  std::vector<std::uint64_t> colour(n);
  for (std::size_t v = 0; v < n; ++v)
    colour[v] = mix(2 * complex_.vertex_corners[static_cast<int>(v)].size() +
                    (complex_.is_boundary_vertex(static_cast<int>(v)) ? 1 : 0));
  for (int round = 0; round < 8; ++round) {
    std::vector<std::uint64_t> next(n);
    for (std::size_t v = 0; v < n; ++v) next[v] = mix(colour[v]);
    for (const auto& hex : mesh_.hexes) {
      std::uint64_t sum = 0;
      for (int v : hex) sum += mix(colour[at(v)] + 1);
      for (std::size_t k = 0; k < 8; ++k) next[at(hex[k])] += mix(sum);
    }
    for (std::size_t e = 0; e < complex_.edges.size(); ++e) {
      const auto [a, b] = complex_.edges[e];
      const auto k = static_cast<std::uint64_t>(complex_.valence(static_cast<int>(e)));
      next[at(a)] += mix(colour[at(b)] * 31 + k);
      next[at(b)] += mix(colour[at(a)] * 31 + k);
    }
    colour = std::move(next);
  }
  std::uint64_t sum = mesh_.hexes.size();
  for (std::uint64_t c : colour) sum += mix(c);
  return sum;
}

std::vector<SheetState::Seed> SheetState::seeds_at(int v, int max_valence, int most, NodeMeasure& measure,
                                                   std::set<std::string>& limits) const {
  const VertexSphere& star = spheres_[at(v)];
  std::vector<Seed> seeds;
  const auto consider = [&](const std::vector<int>& cycle) {
    const SphereSplit halves = split(star.sphere, cycle);
    if (halves.left.max_degree() > max_valence || halves.right.max_degree() > max_valence) return;
    const int after = measure(halves.left) + measure(halves.right);
    if (after - measures_[at(v)] <= std::min(most, -1)) seeds.push_back({after, cycle});
  };
  // Vertices with very many edges have too many cycles to try; their general cut alone always helps.
  const bool few = star.sphere.size() <= most_edges;
  if (!few || max_valence > longest_cycle) limits.insert("edges at a vertex");
  if (few)
    for (const auto& cycle : simple_cycles(star.sphere, std::min(max_valence, longest_cycle))) consider(cycle);
  if (seeds.empty() && star.sphere.max_degree() >= 6) consider(general_cut(star.sphere));
  std::stable_sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) {
    return a.measure_after != b.measure_after ? a.measure_after < b.measure_after : a.cycle.size() < b.cycle.size();
  });
  if (seeds.size() > most_seeds) {
    limits.insert("cycles at a vertex");
    seeds.resize(most_seeds);
  }
  return seeds;
}

std::vector<int> SheetState::quads_of(int v, const std::vector<int>& cycle) const {
  const auto& edges = spheres_[at(v)].edges;
  std::vector<int> quads;
  for (std::size_t k = 0; k < cycle.size(); ++k)
    quads.push_back(complex_.quad_between(edges[at(cycle[k])], edges[at(cycle[(k + 1) % cycle.size()])]));
  return quads;
}

std::vector<int> SheetState::bends_of(int v, const std::vector<int>& cycle) const {
  const VertexSphere& star = spheres_[at(v)];
  std::vector<int> out;
  for (std::size_t k = 0; k < cycle.size(); ++k) {
    const auto& ring = star.sphere.rings[at(cycle[k])];
    if (ring.size() != 4) continue;
    const int before = cycle[(k + cycle.size() - 1) % cycle.size()];
    const int after = cycle[(k + 1) % cycle.size()];
    const auto i = std::find(ring.begin(), ring.end(), before) - ring.begin();
    if (ring[at((static_cast<int>(i) + 2) % 4)] == after) continue;
    int vertex = v;
    for (int e = star.edges[at(cycle[k])]; e >= 0;) {
      out.push_back(e);
      vertex = complex_.other_end(e, vertex);
      int next = -1;
      if (!complex_.is_boundary_vertex(vertex) && spheres_[at(vertex)].edges.empty())
        for (int f : complex_.vertex_edges[vertex])
          if (f != e && complex_.quad_between(e, f) < 0) next = f;
      e = next;
    }
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::vector<int> SheetState::vertices_by_measure() const {
  std::vector<int> vertices;
  for (std::size_t v = 0; v < measures_.size(); ++v)
    if (measures_[v] > 0) vertices.push_back(static_cast<int>(v));
  std::stable_sort(vertices.begin(), vertices.end(), [&](int a, int b) {
    const bool node_a = vertex_type(spheres_[at(a)].sphere) == VertexType::node;
    const bool node_b = vertex_type(spheres_[at(b)].sphere) == VertexType::node;
    return node_a != node_b ? node_a : measures_[at(a)] > measures_[at(b)];
  });
  return vertices;
}

void SheetState::keep_possible(std::vector<SheetCandidate>& sheets, int most, std::size_t keep) const {
  std::sort(sheets.begin(), sheets.end());
  std::vector<SheetCandidate> good;
  for (SheetCandidate& sheet : sheets) {
    if (sheet.change > most || good.size() >= keep) break;
    if (!good.empty() && good.back().quads == sheet.quads) continue;
    try {
      inflate_sheet(mesh_, complex_, sheet.quads);
      good.push_back(std::move(sheet));
    } catch (const Error& error) {
      if (error.code() != ExitCode::bad_input) throw;  // one-sided, or features in its way
    }
  }
  sheets = std::move(good);
}

void SheetState::add_seeded_sheets(const DecomposeOptions& options, const QuadClasses& classes, int most, int targets,
                                   std::size_t keep, NodeMeasure& measure, const Control& control, Found& found) const {
  const int max_valence = std::max(options.max_valence, max_valence_);
  const bool exact = options.search == DecomposeOptions::Search::exact;
  SheetSearch search(mesh_, complex_, classes, spheres_, measure, {max_valence, options.seed_budget, most_sheets},
                     control);
  if (!exact) found.limits.insert("the greedy search");
  for (int v : vertices_by_measure()) {
    std::vector<SheetCandidate> here;
    for (const Seed& seed : seeds_at(v, max_valence, most, measure, found.limits)) {
      if (!bends_of(v, seed.cycle).empty()) continue;
      if (!follow(search, quads_of(v, seed.cycle), exact, here) && exact)
        found.limits.insert("patches tried from one seed");
    }
    keep_possible(here, most, keep);
    found.sheets.insert(found.sheets.end(), here.begin(), here.end());
    const bool spent = search.steps_taken() > options.budget / 5;
    if (spent) found.limits.insert("patches tried");
    if (spent || (!here.empty() && --targets == 0)) break;
  }
  found.steps += search.steps_taken();
}

SheetState::Found SheetState::sheets(const DecomposeOptions& options, int most, int targets, std::size_t keep,
                                     NodeMeasure& measure, const Control& control) const {
  const QuadClasses classes = build_quad_classes(complex_, feature_quads_of(mesh_, complex_));
  const int max_valence = std::max(options.max_valence, max_valence_);
  const bool lowers = options.search == DecomposeOptions::Search::exact && most < 0;
  Found found;
  const auto solve_for_all = [&] {
    SheetProgram program(mesh_, complex_, classes, spheres_, measure, max_valence);
    SheetProgram::Result all = program.solve({options.branches, options.work}, control);
    found.sheets = std::move(all.sheets);
    found.complete = all.complete;
    if (all.complete) found.limits.clear();
    if (!all.limit.empty()) found.limits.insert(all.limit);
  };
  const bool program_first = lowers && has_many_nodes();
  if (program_first) solve_for_all();
  if (!program_first || (found.sheets.empty() && !found.complete)) {
    found.limits.clear();
    add_seeded_sheets(options, classes, most, targets, keep, measure, control, found);
    found.complete = found.limits.empty();
  }
  if (lowers && !program_first && found.sheets.empty() && !found.complete) solve_for_all();
  if (found.sheets.empty()) add_bent_sheets(options, most, keep, measure, control, found);
  std::sort(found.sheets.begin(), found.sheets.end());
  found.sheets.erase(std::unique(found.sheets.begin(), found.sheets.end(),
                                 [](const SheetCandidate& a, const SheetCandidate& b) { return a.quads == b.quads; }),
                     found.sheets.end());
  if (found.sheets.size() > keep) found.sheets.resize(keep);
  return found;
}

void SheetState::add_bent_sheets(const DecomposeOptions& options, int most, std::size_t keep, NodeMeasure& measure,
                                 const Control& control, Found& found) const {
  const std::vector<int> features = feature_quads_of(mesh_, complex_);
  const int max_valence = std::max(options.max_valence, max_valence_);
  const SearchLimits limits{max_valence, options.seed_budget, most_sheets};
  std::set<std::string> of_seeds;
  for (int v : vertices_by_measure()) {
    int bent = 0;
    for (const Seed& seed : seeds_at(v, max_valence, most, measure, of_seeds)) {
      const std::vector<int> bends = bends_of(v, seed.cycle);
      if (bends.empty()) continue;
      if (++bent > most_bent_seeds || found.steps > options.budget) break;
      const QuadClasses classes = build_quad_classes(complex_, features, bends);
      SheetSearch search(mesh_, complex_, classes, spheres_, measure, limits, control);
      std::vector<SheetCandidate> here;
      follow(search, quads_of(v, seed.cycle), options.search == DecomposeOptions::Search::exact, here);
      keep_possible(here, most, keep);
      found.steps += search.steps_taken();
      found.sheets.insert(found.sheets.end(), here.begin(), here.end());
      if (!here.empty()) break;
    }
    if (!found.sheets.empty()) return;
  }
}

}  // namespace hexfield::hex
