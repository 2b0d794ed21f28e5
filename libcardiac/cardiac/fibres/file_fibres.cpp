#include "cardiac/fibres/file_fibres.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <sstream>

#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/tet_gradients.hpp>

namespace cardiac {

using polyaffine::InputError;
using polyaffine::Mat3;
using polyaffine::Matrix;
using polyaffine::MeshFile;
using polyaffine::Vec3;

namespace {

constexpr double kOneDegree = 0.01745;  // its sine

struct Found {
  const Matrix* vectors = nullptr;
  bool of_tets = false;
  const char* place() const { return of_tets ? " of tets" : " of points"; }
};

Found find(const MeshFile& file, const std::string& name) {
  for (const bool of_tets : {true, false}) {
    const auto& fields = of_tets ? file.cell_fields : file.point_fields;
    if (const auto at = fields.find(name); at != fields.end() && at->second.rows() == 3)
      return {&at->second, of_tets};
  }
  return {};
}

std::string fields_of(const MeshFile& file) {
  std::string out;
  for (const auto* fields : {&file.point_fields, &file.cell_fields})
    for (const auto& [name, field] : *fields)
      out += (out.empty() ? "" : ", ") + ('"' + name) + "\" (" + std::to_string(field.rows()) +
             (field.rows() == 1 ? " component" : " components") +
             (fields == &file.point_fields ? " of points)" : " of tets)");
  return out.empty() ? "no field at all" : "the fields " + out;
}

// Of one kind of place, so that both can be compared.
void check_across(const MeshFile& file, const std::string& source, const Found& fibre, const Found& other,
                  const std::string& name) {
  if (fibre.of_tets != other.of_tets) return;
  for (Eigen::Index i = 0; i < fibre.vectors->cols(); ++i) {
    const Vec3 f = fibre.vectors->col(i).normalized(), v = other.vectors->col(i).normalized();
    if (f.cross(v).norm() > kOneDegree) continue;
    const Vec3 x = fibre.of_tets ? file.mesh.tet_centroid(static_cast<int>(i)) : file.mesh.points().col(i);
    std::ostringstream text;
    text << source << ": field \"" << name << "\": found it along the fibre at "
         << (fibre.of_tets ? "tet " : "point ") << i << " (counted from 0) near (" << x.x() << ", " << x.y()
         << ", " << x.z() << ") mm, expected a direction across the fibre";
    throw InputError(text.str());
  }
}

// The part across f, of unit length; none where it is along f.
std::optional<Vec3> part_across(const Vec3& f, const Vec3& v) {
  const Vec3 s = v - v.dot(f) * f;
  if (s.norm() < kOneDegree) return std::nullopt;
  return s.normalized();
}

// The first of the local axes, radial first, that is not along f.
Vec3 axis_across(const Vec3& f, const Mat3& axes) {
  for (const int k : {2, 1})
    if (const auto s = part_across(f, axes.col(k))) return *s;
  return f.unitOrthogonal();
}

}  // namespace

bool has_fibres(const MeshFile& file) {
  return find(file, "fibre").vectors != nullptr;
}

FileFibres::FileFibres(const MeshFile& file, const std::string& source) {
  const Found fibre = find(file, "fibre");
  if (!fibre.vectors)
    throw InputError(source + ": found no fibres: " + fields_of(file) +
                     ", expected fibre directions: a field of 3 components, of points or of tets, named "
                     "fibre, fiber, f0, … or by fibres.fibre_array");
  fibre_.emplace(file.mesh, *fibre.vectors, fibre.of_tets);
  ambiguous_share_ = fibre_->ambiguous_share();
  description_ = std::string("fibre") + fibre.place();
  for (const auto& [name, field] : {std::pair{"sheet", &sheet_}, {"sheet_normal", &normal_}}) {
    const Found found = find(file, name);
    if (!found.vectors) continue;
    check_across(file, source, fibre, found, name);
    field->emplace(file.mesh, *found.vectors, found.of_tets);
    description_ += std::string(", ") + name + found.place();
    return;
  }
  description_ += ", sheet across the wall";
}

bool FileFibres::is_whole() const {
  const auto fits = [&](const std::optional<DirectionField>& field) {
    return !field || field->num_tets() == fibre_->num_tets();
  };
  return fibre_ && fits(sheet_) && fits(normal_);
}

FileFibres FileFibres::moved(const polyaffine::TetMesh& mesh, const polyaffine::Points& points) const {
  const polyaffine::TetMesh there(points, mesh.tets());
  FileFibres out = *this;
  const auto move = [&](const std::optional<DirectionField>& from, bool normals,
                        std::optional<DirectionField>& to) {
    if (!from) return;
    const std::vector<Mat3> F = from->of_tets() ? polyaffine::tet_gradients(mesh, points)
                                                : polyaffine::vertex_gradients(mesh, points);
    polyaffine::Matrix vectors = from->vectors();
    for (Eigen::Index i = 0; i < vectors.cols(); ++i) {
      Mat3 by = F[static_cast<std::size_t>(i)];
      if (normals) by = by.inverse().transpose().eval();
      const Vec3 v = vectors.col(i);
      vectors.col(i) = by.lazyProduct(v);
    }
    to.emplace(there, vectors, from->of_tets());
  };
  move(fibre_, false, out.fibre_);
  move(sheet_, false, out.sheet_);
  move(normal_, true, out.normal_);
  return out;
}

std::map<std::string, const DirectionField*> FileFibres::fields() const {
  std::map<std::string, const DirectionField*> out;
  for (const auto& [name, field] :
       {std::pair{"fibre", &fibre_}, {"sheet", &sheet_}, {"sheet_normal", &normal_}})
    if (*field) out[name] = &**field;
  return out;
}

FibreAxes FileFibres::at(const VentricularCoordinates& coordinates, const std::vector<int>& tet,
                         const Eigen::Matrix4Xd& barycentric) const {
  FibreAxes out(9, barycentric.cols());
  for (Eigen::Index q = 0; q < out.cols(); ++q) {
    const polyaffine::Vec4 at = barycentric.col(q);
    const Mat3 local = coordinates.wall_sample(tet[q], at).Q;
    const Vec3 f = fibre_->at(tet[q], at, local.col(1));
    const auto& field = sheet_ ? sheet_ : normal_;
    std::optional<Vec3> given =
        field ? part_across(f, field->at(tet[q], at, local.col(sheet_ ? 2 : 0))) : std::nullopt;
    if (given && normal_) given = given->cross(f);
    const Vec3 s = given ? *given : axis_across(f, local);
    Mat3 axes;
    axes << f, s, f.cross(s);
    out.col(q) = axes.reshaped();
  }
  return out;
}

}  // namespace cardiac
