#include "cardiac/fibres/moved_anatomy.hpp"

#include <memory>
#include <utility>

#include <cardiac/fibres/file_fibres.hpp>

namespace cardiac {

using polyaffine::Points;
using polyaffine::TetMesh;
using polyaffine::Vec3;

Vec3 way_of_nearest(const TetMesh& mesh, const Points& points, const Vec3& place) {
  Eigen::Index nearest = 0;
  (mesh.points().colwise() - place).colwise().squaredNorm().minCoeff(&nearest);
  return points.col(nearest) - mesh.points().col(nearest);
}

Anatomy moved_anatomy(const Anatomy& anatomy, const Points& points) {
  const TetMesh& mesh = anatomy.mesh;
  AnatomyOptions options = anatomy.options;
  for (auto* landmark : {&options.septum_point, &options.rv_insertion_point, &options.mitral_point})
    if (*landmark) **landmark += way_of_nearest(mesh, points, **landmark);
  options.midpoints.reset();
  FibreFunction fibres = anatomy.fibres;
  if (const auto* of_file = anatomy.fibres.target<FileFibreFunction>())
    fibres = FileFibreFunction{std::make_shared<const FileFibres>(of_file->fibres->moved(mesh, points))};
  Anatomy out =
      make_anatomy(TetMesh(points, mesh.tets(), mesh.regions(), {mesh.boundary(), mesh.boundary_labels()}),
                   options, std::move(fibres));
  out.epicardial_weight = anatomy.epicardial_weight;
  return out;
}

}  // namespace cardiac
