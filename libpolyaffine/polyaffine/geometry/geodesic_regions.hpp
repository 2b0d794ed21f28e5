#pragma once

#include <random>
#include <vector>

#include <polyaffine/core/types.hpp>
#include <polyaffine/geometry/eikonal.hpp>

namespace polyaffine {

/// Regions of a mesh: one label a tet (−1: in none) and a seed for each label.
struct GeodesicRegions {
  std::vector<int> label;
  std::vector<MeshPoint> seeds;
  int iterations = 0;  ///< Lloyd steps taken
};

/// `count` different tets drawn with probability proportional to volume among those with allowed[t] (all when
/// empty); each seed is a tet's centroid. Throws InputError when there are fewer tets than seeds.
std::vector<MeshPoint> random_seeds(const TetMesh& mesh, int count, std::mt19937_64& random,
                                    const std::vector<char>& allowed = {});

/// Geodesic Voronoi labels: each tet gets the seed that reaches its centroid first; a seed always keeps its
/// own tet. Tets that are not allowed or cannot be reached get −1. The solver's metric measures the distance.
std::vector<int> voronoi_labels(const EikonalSolver& solver, const std::vector<MeshPoint>& seeds,
                                const std::vector<char>& allowed = {});

/// Voronoi labels after Lloyd relaxation: every seed moves to the tet of its region whose centroid is nearest
/// the region's centre of volume, until none moves or `max_iterations` is reached; the regions are connected.
GeodesicRegions lloyd_regions(const EikonalSolver& solver, std::vector<MeshPoint> seeds,
                              int max_iterations = 20, const std::vector<char>& allowed = {});

/// Labels in which every label ≥ 0 is connected through faces: the largest part (by volume) stays, the others
/// go to the neighbour with which they share the largest area; parts without such a neighbour keep theirs.
std::vector<int> connect_regions(const TetMesh& mesh, std::vector<int> label);

/// Volume (mm³) of each of `count` labels.
Vector region_volumes(const TetMesh& mesh, const std::vector<int>& label, int count);

/// For every label the centroid of the tet nearest to the centre of volume of the region.
/// Throws InputError when a label 0 … count − 1 has no tet.
std::vector<MeshPoint> region_centres(const TetMesh& mesh, const std::vector<int>& label, int count);

/// Signed geodesic distance of all vertices to the border between a region and its surroundings, negative
/// inside, divided by the largest depth, so that its minimum is −1 (at the node of the region). Constant −1
/// when the region is the whole mesh. Throws InputError when the region has no tet or no vertex in its
/// interior.
Vector normalised_border_distance(const EikonalSolver& solver, const std::vector<int>& label, int region);

/// Those of regions 0 … count − 1, a row each (count × vertices).
Matrix normalised_border_distances(const EikonalSolver& solver, const std::vector<int>& label, int count);

}  // namespace polyaffine
