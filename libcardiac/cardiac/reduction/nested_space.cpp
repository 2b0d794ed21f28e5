#include "cardiac/reduction/nested_space.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <cardiac/reduction/biventricular_frames.hpp>

namespace cardiac {

using polyaffine::LagrangeBasis;
using polyaffine::Matrix;
using polyaffine::Vector;

namespace {

// Columns that are no combination of those before them, by elimination: what is left of a column must be more
// than this share of it.
constexpr double kIndependent = 1e-8;
std::vector<char> independent_columns(const Matrix& gram) {
  std::vector<char> out(gram.rows(), 0);
  Matrix L = Matrix::Zero(gram.rows(), gram.rows());
  for (Eigen::Index j = 0; j < gram.cols(); ++j) {
    Vector row = Vector::Zero(gram.rows());
    double rest = gram(j, j);
    for (Eigen::Index i = 0; i < j; ++i) {
      if (!out[i]) continue;
      row[i] = (gram(j, i) - row.head(i).dot(L.row(i).head(i))) / L(i, i);
      rest -= row[i] * row[i];
    }
    if (rest <= kIndependent * gram(j, j)) continue;
    out[j] = 1;
    row[j] = std::sqrt(rest);
    L.row(j) = row;
  }
  return out;
}

// Functions with a factor l alone vanish on the base, where u = 1 is met to rounding; they hold it exactly.
void clear_rows(const std::vector<int>& nodes, polyaffine::NodalFunctions& values) {
  for (const int node : nodes)
    for (polyaffine::NodalFunctions::InnerIterator entry(values, node); entry; ++entry) entry.valueRef() = 0;
  values.prune(0.0);
}

polyaffine::NodalFunctions at_nodes(const Anatomy& anatomy, const polyaffine::FrameBasis& basis) {
  const LagrangeBasis& elements = anatomy.coordinates->space();
  polyaffine::NodalFunctions out = polyaffine::nodal_functions(basis, elements);
  clear_rows(elements.surface_nodes(anatomy.mesh, {anatomy.labels.base}), out);
  return out;
}

}  // namespace

NestedSpace affine_space(const Anatomy& anatomy, const Scene& scene) {
  const FrameLayout layout = frame_layout_of(anatomy, scene);
  const auto field = tent_frames(anatomy.coordinates, layout, true);
  const Eigen::Index nodes = anatomy.coordinates->space().num_functions();
  std::vector<polyaffine::FrameFunctions> functions(field->num_frames());
  NestedSpace out;
  out.modes = Matrix(3 * nodes, 0);
  if (!scene.reduction.affine_frames) {
    out.frame_basis = std::make_shared<polyaffine::FrameBasis>(field, functions);
    out.frames = polyaffine::NodalFunctions(nodes, 0);
    out.pressures = Matrix::Ones(1, anatomy.mesh.num_tets());
    return out;
  }
  for (int i = 0; i < field->num_frames(); ++i)
    functions[i].monomials = i < layout.num_nodes() ? polyaffine::affine_monomials()
                                                    : std::vector<polyaffine::Monomial>{{1, 0, 0}};
  const polyaffine::NodalFunctions values = at_nodes(anatomy, polyaffine::FrameBasis(field, functions));
  const std::vector<char> keep = independent_columns(Matrix(values.transpose() * values));
  int f = 0;
  for (auto& frame : functions)
    std::erase_if(frame.monomials, [&](const polyaffine::Monomial&) { return !keep[f++]; });
  out.frame_basis = std::make_shared<polyaffine::FrameBasis>(field, functions);
  out.frames = at_nodes(anatomy, *out.frame_basis);
  const std::vector<int> region = region_tets(anatomy.mesh, *anatomy.coordinates, layout);
  out.pressures = Matrix::Zero(layout.num_nodes(), std::ssize(region));
  for (std::size_t t = 0; t < region.size(); ++t) out.pressures(region[t], static_cast<Eigen::Index>(t)) = 1;
  return out;
}

Discretisation nested_discretisation(const Anatomy& anatomy, const Scene& scene, const NestedSpace& space,
                                     const Discretisation& full) {
  Discretisation out = full;
  const std::shared_ptr<const LagrangeBasis> elements(anatomy.coordinates, &anatomy.coordinates->space());
  out.basis = std::make_shared<polyaffine::NestedBasis>(elements, space.frames, space.modes);
  out.frame_basis = space.frame_basis;
  out.layout = frame_layout_of(anatomy, scene);
  out.region = region_tets(anatomy.mesh, *anatomy.coordinates, out.layout);
  out.element_pressures = std::make_shared<const Matrix>(space.pressures);
  Vector volume = Vector::Zero(space.pressures.cols());
  for (std::size_t q = 0; q < full.points.tet.size(); ++q)
    volume[full.points.tet[q]] += full.points.weights[static_cast<Eigen::Index>(q)];
  out.pressure_mass = space.pressures * volume.asDiagonal() * space.pressures.transpose();
  const int unknowns = 3 * out.basis->num_functions(),
            padding = static_cast<int>(space.modes.cols()) - space.num_modes;
  out.num_unknowns = unknowns - padding;
  out.fixed.assign(unknowns, 0);
  std::fill(out.fixed.end() - padding, out.fixed.end(), 1);
  out.sparse = false;
  return out;
}

polyaffine::PressureSpace element_pressure_space(const Discretisation& discretisation,
                                                 const polyaffine::FieldTable& table,
                                                 double bulk_modulus_kPa) {
  const Matrix values = (*discretisation.element_pressures)(Eigen::all, discretisation.points.tet);
  polyaffine::PressureSpace out = polyaffine::dense_pressure(table, values, bulk_modulus_kPa);
  out.mass = discretisation.pressure_mass;
  return out;
}

namespace {

// A block may see this many times the functions of its points.
constexpr double kSlack = 1.3;
// Points of a block: what is computed point by point grows with the square.
constexpr std::ptrdiff_t kMostPoints = 32;

// Which points stand together in a block: greedily, the largest sets of functions first.
std::vector<std::vector<int>> blocks_of(const polyaffine::Basis& basis, const std::vector<int>& tet,
                                        const Eigen::Matrix4Xd& barycentric) {
  std::map<std::vector<int>, std::vector<int>> points_of;
  for (std::size_t q = 0; q < tet.size(); ++q)
    points_of[basis.sample(tet[q], barycentric.col(static_cast<Eigen::Index>(q))).functions].push_back(
        static_cast<int>(q));
  std::vector<const std::pair<const std::vector<int>, std::vector<int>>*> sets;
  for (const auto& set : points_of) sets.push_back(&set);
  std::ranges::stable_sort(sets, std::greater<>(), [](const auto* set) { return set->first.size(); });
  struct Block {
    std::vector<int> functions, points;
  };
  std::vector<Block> blocks;
  for (const auto* set : sets) {
    const auto holds = [&](const Block& block) {
      return static_cast<double>(block.functions.size()) <= kSlack * static_cast<double>(set->first.size()) &&
             std::ranges::includes(block.functions, set->first);
    };
    const auto block = std::ranges::find_if(blocks, holds);
    if (block == blocks.end())
      blocks.push_back({set->first, set->second});
    else
      block->points.insert(block->points.end(), set->second.begin(), set->second.end());
  }
  std::vector<std::vector<int>> out;
  for (Block& block : blocks) {
    std::ranges::sort(block.points);
    for (auto first = block.points.begin(); first != block.points.end();) {
      const auto last = first + std::min(kMostPoints, block.points.end() - first);
      out.emplace_back(first, last);
      first = last;
    }
  }
  return out;
}

template <class Places>
void keep(const Places& all, const KeptPoints& which, Places& out) {
  for (const int p : which.points) out.tet.push_back(all.tet[p]);
  out.barycentric = all.barycentric(Eigen::all, which.points);
  out.weights = which.weights;
  out.starts = which.starts;
}

}  // namespace

KeptPoints in_blocks(const polyaffine::Basis& basis, const std::vector<int>& tet,
                     const Eigen::Matrix4Xd& barycentric, const std::vector<int>& points,
                     const Vector& weights) {
  std::vector<int> own;
  for (const int p : points) own.push_back(tet[p]);
  std::vector<int> order;
  KeptPoints out{{}, {}, {0}};
  for (const auto& block : blocks_of(basis, own, barycentric(Eigen::all, points))) {
    order.insert(order.end(), block.begin(), block.end());
    out.starts.push_back(static_cast<int>(order.size()));
  }
  for (const int k : order) out.points.push_back(points[k]);
  out.weights = weights(order);
  return out;
}

polyaffine::WallPoints kept(const polyaffine::WallPoints& all, const KeptPoints& which) {
  polyaffine::WallPoints out;
  keep(all, which, out);
  return out;
}

polyaffine::SurfacePoints kept(const polyaffine::SurfacePoints& all, const KeptPoints& which) {
  polyaffine::SurfacePoints out;
  keep(all, which, out);
  out.X = all.X(Eigen::all, which.points);
  out.X_xi = all.X_xi(Eigen::all, which.points);
  out.X_eta = all.X_eta(Eigen::all, which.points);
  return out;
}

}  // namespace cardiac
